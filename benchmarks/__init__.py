"""Cost of a beat in this and in other codes; `python3 study.py benchmark` runs it, the tests do not."""
