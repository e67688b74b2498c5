"""Comparison of registrations: the library's and ours on synthetic images of a known motion."""
