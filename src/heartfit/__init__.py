"""Personalise a 3-D electromechanical heart model with the unscented transform."""
