"""What the console can be asked for, a subject to each file.

``COMMANDS`` of a file says its commands: the function that carries one out and returns the exit code, the function that
adds its arguments, and its line of help. What only one command needs is imported by it: others start a second sooner.
"""
