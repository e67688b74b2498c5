"""Units of tables and figures; the computation itself is in SI."""

DISPLAY = {  # SI unit: printed unit, SI value of one printed unit
    "Pa": ("kPa", 1e3),
    "Pa.s": ("kPa.s", 1e3),
    "Pa.s/m^3": ("MPa.s/m^3", 1e6),
    "MPa.s/m^3": ("MPa.s/m^3", 1.0),
    "MPa": ("kPa", 1e-3),
    "MPa.s": ("kPa.s", 1e-3),  # as the paper gives them
    "m^3": ("mL", 1e-6),
    "m^3/s": ("mL/s", 1e-6),
    "Pa/s": ("kPa/s", 1e3),
}


def to_printed_unit(value: float, unit: str) -> float:
    """Convert a value from `unit` to its printed unit."""
    return value / DISPLAY.get(unit, (unit, 1.0))[1]


def printed_unit(unit: str) -> str:
    """Return the unit in which a quantity given in `unit` is printed."""
    return DISPLAY.get(unit, (unit, 1.0))[0]


def column_heading(name: str, unit: str) -> str:
    """Return the column heading of a quantity given in `unit`, such as "sigma_0 (kPa)"."""
    return f"{name} ({printed_unit(unit)})"
