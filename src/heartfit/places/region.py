"""The region of a mechanism: where its role acts."""

from heartfit.places.place import Region
from heartfit.roles import (
    Amendment,
    Attachment,
    Availability,
    Chamber,
    Delay,
    External,
    Flow,
    Mechanism,
    Narrowing,
    Pressure,
    Relaxation,
    Sensor,
    Stress,
)
from heartfit.roles.sides import changes_right_wall

MUSCLE = (Amendment, Attachment, Availability, Delay, Relaxation)
WALL = (External, Stress)
MEASURED: dict[str, Region] = {"lv_volume": "images", "lv_pressure": "catheter"}


def regions_of(kind: type[Mechanism]) -> frozenset[Region]:
    """Return the regions on which a mechanism acts: two for a sensor of two curves, none for the right heart."""
    if changes_right_wall(kind):
        return frozenset()
    if issubclass(kind, Amendment) and kind.amends.startswith("passive"):
        return frozenset({"wall"})
    if issubclass(kind, MUSCLE):
        return frozenset({"muscle"})
    if issubclass(kind, WALL):
        return frozenset({"wall"})
    if issubclass(kind, Sensor):
        return frozenset(MEASURED[curve] for curve in kind.measures if curve in MEASURED)
    return _in_circuit(kind)


def _in_circuit(kind: type[Mechanism]) -> frozenset[Region]:
    if issubclass(kind, Flow):
        ends = {kind.upstream, kind.downstream}
        if "lv" not in ends:
            return frozenset()
        return frozenset({"backflow" if "aorta" in ends else "leak"})
    touched: tuple[str, ...] = ()
    if issubclass(kind, Narrowing):
        touched = (kind.valve,)
    elif issubclass(kind, Pressure):
        touched = kind.compartments
    elif issubclass(kind, Chamber):
        touched = (kind.compartment,)
    parts: dict[str, Region] = {
        "mitral": "filling",
        "left_atrium": "filling",
        "aortic": "ejection",
        "aorta": "ejection",
    }
    return frozenset(parts[name] for name in touched if name in parts)
