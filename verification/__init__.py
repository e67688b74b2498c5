"""Checks of the simulator against closed forms and published results, outside the package."""
