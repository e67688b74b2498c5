"""Passive laws, one per file: stress and tangent of many points at once; see law.py for the slot."""
