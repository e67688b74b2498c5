"""How virtual volunteers are made; apart from the making, which needs the mesher."""

from dataclasses import dataclass

from heartfit.simulation import Numerics


@dataclass(frozen=True)
class Protocol:
    """How volunteers are made: mesh size and tolerance, m; numerics; pressures (lv, rv) at end diastole, Pa."""

    edge_length: float
    tolerance: float
    numerics: Numerics
    end_diastolic_pressure: tuple[float, float]
