"""Commands of the console command ``heartfit``, one file per subject.

``COMMANDS`` of a file lists its commands: the function that runs the command and returns the exit code, the function
that adds its arguments, and its line of help. Imports that only one command needs are in its function, so that other
commands start a second faster.
"""
