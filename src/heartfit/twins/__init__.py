"""Spherical hearts of known truth, on which methods of calibration are compared and intervals are counted."""
