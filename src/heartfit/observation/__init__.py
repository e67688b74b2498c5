"""Observation operator: from periodic curves to the numbers that a calibration compares, measured or simulated."""
