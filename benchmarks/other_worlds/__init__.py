"""Hearts of simulators that others wrote, as a bank of beats in resources/other_worlds."""
