"""What the user can mend is an InputError; what the numbers did is a status, not an exception."""


class InputError(ValueError):
    """Bad input: the message says what, where, what was expected and what to do."""
