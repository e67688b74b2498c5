"""What jobs took, what the next ones should be given, and what many of them come to."""
