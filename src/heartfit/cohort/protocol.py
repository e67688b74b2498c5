"""How virtual volunteers are made; apart from the making, which needs the mesher."""

from dataclasses import dataclass

from heartfit.simulation import Numerics


@dataclass(frozen=True)
class Protocol:
    """How volunteers are made: mesh size, tolerance and noise, m; numerics; pressures (lv, rv), Pa; frames."""

    edge_length: float
    tolerance: float
    numerics: Numerics
    noise: float
    end_diastolic_pressure: tuple[float, float]
    frames: int = 25
