"""Checks of the simulator against answers that nobody here produced, beside the package."""
