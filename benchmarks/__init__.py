"""What a beat costs, and what others take for the same: a command, `python3 study.py benchmark`, not a test."""
