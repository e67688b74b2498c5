"""Names and units as the tables print them."""

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


def printed(value: float, unit: str) -> float:
    """The value, given in `unit`, in the unit its column prints."""
    return value / DISPLAY.get(unit, (unit, 1.0))[1]


def printed_unit(unit: str) -> str:
    """The unit in which a quantity given in `unit` is printed."""
    return DISPLAY.get(unit, (unit, 1.0))[0]


def heading(name: str, unit: str) -> str:
    """Column heading of a quantity given in `unit`, such as "sigma_0 (kPa)"."""
    return f"{name} ({printed_unit(unit)})"
