"""Answers of the physics beside answers that nobody here produced."""
