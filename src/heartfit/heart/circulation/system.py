"""Columns of the equations of a circuit, and the units of their residuals."""

ONE_MILLILITRE, ONE_KILOPASCAL = 1e-6, 1e3
"""Units of the residual: volume [m^3] of a ventricle or of an atrium, pressure [Pa] of an artery."""

CONSTANT, WEIGHT, REFERENCE, STORAGE = range(4)
"""Columns of a system, whose rows are the compartments:
residual = constant + weight * net outflow + storage (p - reference); the storage fills the last columns."""
