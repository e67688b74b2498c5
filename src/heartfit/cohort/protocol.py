"""How the hearts of virtual volunteers beat; apart from the making, which needs scipy's solvers."""

from dataclasses import dataclass

from heartfit.simulation import Numerics


@dataclass(frozen=True)
class Protocol:
    """Numerics of the beat; pressures (lv, rv) at end diastole, Pa."""

    numerics: Numerics
    end_diastolic_pressure: tuple[float, float]
