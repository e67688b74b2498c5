"""Drawn adults, in the terms that every simulator has, and the published ranges that a healthy beat keeps.

A simulator starts from its own published parameters and multiplies them by the factors of an adult. Volumes scale
exactly: compliances grow with the size, resistances and elastances fall with it, and pressures stay.
"""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from itertools import count

import numpy as np

RATE = (50.0, 90.0)
"""Heart rates [1/min]."""
SPREADS = {
    "size": 0.22,
    "contractility": 0.2,
    "stiffness": 0.25,
    "resistance": 0.15,
    "compliance": 0.2,
    "filling": 0.12,
    "valve": 0.2,
    "systole": 0.06,
}
"""Standard deviations of the logarithms of the factors; systole is the duration of contraction."""
HEALTHY = {
    "EDV": (80.0, 250.0),
    "EF": (0.45, 0.70),
    "P_max": (90.0, 160.0),
    "P_filling": (2.0, 16.0),
}
"""Ranges of end-diastolic volume [mL], ejection fraction, largest pressure and its mean in filling [mmHg]."""
FILLS = 0.1
"""Rate of the volume over its largest one from which the ventricle fills."""


@dataclass(frozen=True)
class Adult:
    """Factors on the parameters of a simulator; period of the beat [s].

    mitral, aortic: factors on the resistance of the open valve; mitral_leak, aortic_leak: regurgitant fraction aimed
    at, 0 without a leak.
    """

    period: float
    size: float = 1.0
    contractility: float = 1.0
    stiffness: float = 1.0
    resistance: float = 1.0
    compliance: float = 1.0
    filling: float = 1.0
    valve: float = 1.0
    systole: float = 1.0
    mitral: float = 1.0
    aortic: float = 1.0
    mitral_leak: float = 0.0
    aortic_leak: float = 0.0


@dataclass(frozen=True)
class Beat:
    """Left ventricular volume [mL] and pressure [mmHg] at equidistant phases of a period [s]."""

    period: float
    volume: np.ndarray
    pressure: np.ndarray

    def indices(self) -> dict[str, float]:
        """Return the indices of HEALTHY."""
        largest, rate = float(self.volume.max()), np.roll(self.volume, -1) - np.roll(self.volume, 1)
        return {
            "EDV": largest,
            "EF": float(np.ptp(self.volume)) / largest,
            "P_max": float(self.pressure.max()),
            "P_filling": float(self.pressure[rate > FILLS * rate.max()].mean()),
        }

    def healthy(self) -> bool:
        """Return whether all indices lie in their ranges."""
        indices = self.indices()
        return all(low <= indices[name] <= high for name, (low, high) in HEALTHY.items())


def adults(first_seed: int, centre: Mapping[str, float]) -> Iterator[tuple[int, Adult]]:
    """Yield seeds and adults without end; centre: factors by which a published heart becomes that of an adult."""
    for seed in count(first_seed):
        rng = np.random.default_rng(seed)
        factors = {
            name: centre.get(name, 1.0) * float(np.exp(sd * rng.standard_normal()))
            for name, sd in SPREADS.items()
        }
        yield seed, Adult(period=60.0 / float(rng.uniform(*RATE)), **factors)


ILLNESSES: dict[str, dict[str, tuple[float, float]]] = {
    "mitral regurgitation": {"mitral_leak": (0.3, 0.5), "filling": (1.15, 1.3)},
    "aortic regurgitation": {"aortic_leak": (0.3, 0.5), "filling": (1.15, 1.3)},
    "mitral stenosis": {"mitral": (8.0, 15.0), "filling": (1.15, 1.3)},
    "aortic stenosis": {"aortic": (12.0, 25.0), "contractility": (1.2, 1.4)},
    "weak ventricle": {"contractility": (0.6, 0.45), "filling": (1.15, 1.3)},
    "stiff ventricle": {"stiffness": (1.8, 2.5), "filling": (1.15, 1.3)},
    "high afterload": {"resistance": (1.4, 1.7), "compliance": (0.7, 0.5)},
}
"""Factors on a healthy adult by illness, moderate and severe; a leak is set and not multiplied."""
SEVERITIES = ("moderate", "severe")


def ill(adult: Adult, illness: str, severity: str) -> Adult:
    """Return the adult with an illness."""
    place = SEVERITIES.index(severity)
    changes = {
        name: pair[place] if name.endswith("_leak") else getattr(adult, name) * pair[place]
        for name, pair in ILLNESSES[illness].items()
    }
    return replace(adult, **changes)
