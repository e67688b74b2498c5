"""Forms of places: mechanisms that are a free function instead of a law, and their priors."""

from abc import abstractmethod
from collections.abc import Mapping
from dataclasses import dataclass
from typing import ClassVar, Literal, Self, get_args

import numpy as np

from heartfit.core.arrays import Floats
from heartfit.places.cosines import COSINES, CosineFunction, cosine_deviations
from heartfit.places.periodic import COEFFICIENTS, PeriodicFunction, wave_deviations, waves_at
from heartfit.roles import Mechanism

Region = Literal["filling", "ejection", "leak", "backflow", "wall", "muscle", "images", "catheter"]
"""Parts of a heart and of its measurement that volume and pressure tell apart.

leak: out of the left ventricle, to the atrium or the right one; backflow: between aorta and ventricle, past the valve.
"""
REGIONS: tuple[Region, ...] = get_args(Region)
AMPLITUDES = (0.3, 1.0, 3.0)
"""Standard deviations of a function over its ``amplitude``, equally likely."""


class Place(Mechanism):
    """A mechanism with a free function of standardised coefficients z, of which N(0, I) is the prior."""

    region: ClassVar[Region]
    slot: ClassVar[str]
    """Words for the slot of the equations, as "the pressure of the left atrium"."""
    unit: ClassVar[str]
    amplitude: ClassVar[float]
    """Standard deviation A of the function [unit]."""
    size: ClassVar[int]
    """Number of coefficients."""
    one_sided: ClassVar[bool] = False
    """True if no coefficient is negative."""

    @classmethod
    @abstractmethod
    def from_standardised(cls, z: Floats, period: float) -> Self:
        """Return the place with the function of the coefficients z (size,) in a heart of the period [s]."""

    def sizes(self) -> Mapping[str, float]:
        """Return the sizes [SI] of the laws, by name, that add up to its function; empty for a free function."""
        return {}

    @classmethod
    def deviations(cls, period: float) -> Floats:  # noqa: ARG003
        """Return the standard deviations (priors, size) of z under every prior of the function, equally likely."""
        return np.multiply.outer(AMPLITUDES, np.ones(cls.size))


@dataclass(frozen=True)
class FunctionOfTime(Place):
    """A place with a free periodic function of time.

    zero: what the time follows; LENGTHS: correlation lengths [s], the first that of N(0, I).
    """

    function: PeriodicFunction
    size = COEFFICIENTS
    zero: ClassVar[Literal["beat", "activation", "trigger"]] = "beat"
    LENGTHS: ClassVar[tuple[float, ...]] = (0.05, 0.1)

    @classmethod
    def from_standardised(cls, z: Floats, period: float) -> Self:
        return cls(PeriodicFunction(cls._units(period) * z, period))

    @classmethod
    def _units(cls, period: float) -> Floats:
        """Fourier coefficients (size,) of the function for z = 1."""
        return cls.amplitude * wave_deviations(period, cls.LENGTHS[0])

    @classmethod
    def basis(cls, time: Floats, period: float) -> Floats:
        """Return the values (..., size) at ``time`` (...) [s] for every coefficient alone at 1."""
        return waves_at(time, period) * cls._units(period)

    def standardised(self) -> Floats:
        """Return the coefficients z (size,) of the function."""
        return self.function.coefficients / self._units(self.function.period)

    @classmethod
    def deviations(cls, period: float) -> Floats:
        shapes = np.array([wave_deviations(period, length) for length in cls.LENGTHS])
        return np.multiply.outer(AMPLITUDES, shapes / shapes[0]).reshape(-1, cls.size)


@dataclass(frozen=True)
class FunctionOfState(Place):
    """A place with a free function of a state between bounds; LENGTHS: correlation lengths over their distance."""

    function: CosineFunction
    size = COSINES
    LENGTHS: ClassVar[tuple[float, ...]] = (0.25, 0.6)

    @classmethod
    def from_standardised(cls, z: Floats, period: float) -> Self:  # noqa: ARG003
        return cls(CosineFunction(cls.amplitude * cosine_deviations(cls.LENGTHS[0]) * z))

    @classmethod
    def deviations(cls, period: float) -> Floats:  # noqa: ARG003
        shapes = np.array([cosine_deviations(length) for length in cls.LENGTHS])
        return np.multiply.outer(AMPLITUDES, shapes / shapes[0]).reshape(-1, cls.size)
