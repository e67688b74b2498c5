"""Comparison of registrations: SimpleITK's and ours on synthetic images of a known motion."""
