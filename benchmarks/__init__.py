"""Cost of a beat, here and in other codes: a command, `python3 study.py benchmark`, not a test."""
