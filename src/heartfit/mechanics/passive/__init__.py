"""Passive laws, one per file: isochoric stress and tangent of many points at once."""
