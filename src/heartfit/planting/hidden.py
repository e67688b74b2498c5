r"""The heart in which an effect is hidden: a sphere that is not the diagnoser's, as a patient's heart is no model.

Steps of 1 ms of first order, orifice valves with inertance, a wall with mass, its own length dependence, amount of wall
and spread of the activation: none of them is the diagnoser's. What it may fit is drawn from the priors,

.. math:: \theta = \bar\theta\, e^{s z}, \qquad \theta = \bar\theta + s z \text{ for times}, \qquad z \sim N(0, 1),

size and heart rate scatter besides: at equal pressures flows and volumes go with the size, and the action potential
lasts as the root of the period (Bazett 1920).
"""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace

import numpy as np

from heartfit.beat import Beat
from heartfit.cohort.hidden_heart import OTHER_MODEL, VALVES
from heartfit.geometry.arrays import Floats
from heartfit.heart import Heart
from heartfit.mechanics.sphere import ACTIVATION, Sphere
from heartfit.mechanism import Flow, Mechanism
from heartfit.planting.outsiders import joined
from heartfit.simulation import Numerics
from heartfit.sphere.heart import Inertia
from heartfit.sphere.simulation import simulate_spheres

NUMERICS = Numerics(time_step=1e-3, second_order=False, max_beats=20, drift=1e-3)

CENTRE = {"sigma_0": 190e3, "R_p": 1.15e8, "circulation.left_atrium": 900.0, "slope": OTHER_MODEL["slope"]}
"""Where it is not the declared value, SI: every fibre of a sphere lies in its plane."""
CAVITY, WALL = 1.2e-4, 1.2e-4
"""Volumes, m^3, of the stress-free cavity and of the wall."""
RIGHT_CAVITY, RIGHT_WALL = 1.2, 0.35
"""Volumes of the right ventricle over those of the left one."""

RELATIVE = {
    "sigma_0": 0.20, "mu": 0.30, "c_1": 0.30, "R_p": 0.20, "k_RS": 0.20, "k_ATP": 0.20, "tau": 0.20, "Z_c": 0.20,
    "L": 0.30, "k_0": 0.30, "alpha": 0.30, "eta": 0.30, "circulation.left_atrium": 0.15, "slope": 0.25,
}  # fmt: skip
"""Standard deviations of logarithms; the slope of the length dependence is no parameter of the diagnoser."""
TIMES = {"onset": 8e-3, "duration": 15e-3, "trigger_delay": 5e-3}
"""Standard deviations, s."""
FILLED, RESISTANCE = 0.15, 0.25
"""Standard deviations of the logarithms of stress-free cavity and mitral resistance, which goes as 1 / area^2."""

SIZE, PERIOD = 0.15, (0.86, 0.06)
AREA, INERTANCE, MASS, SPREAD, AMOUNT = 0.08, 0.40, 0.08, 0.20, 0.05
"""Standard deviations of the logarithms of what the diagnoser does not know of: valves, inertia, activation, wall."""
DENSITY = 1060.0
INERTANCES = {"mitral": 3e4, "aortic": 4e4}
"""Pa s^2/m^3: blood of some 15 mm length in each valve."""
FURTHEST = 2.5
"""Standard deviations at which a draw is cut off."""


@dataclass(frozen=True, eq=False)
class HiddenHeart:
    """A heart, its left ventricle, activation times (k,), s, inertia, and the standard deviates of its parameters."""

    heart: Heart
    sphere: Sphere
    activation: Floats
    inertia: Inertia
    deviates: Mapping[str, float]

    def with_effects(self, effects: Iterable[Mechanism]) -> "HiddenHeart":
        """The same heart with these mechanisms."""
        heart = self.heart
        for effect in effects:
            heart = joined(heart, effect)
        return replace(self, heart=heart)

    def loaded(self, factor: float) -> "HiddenHeart":
        """The same heart under another resting pressure of the left atrium."""
        pressure = factor * self.heart.circulation.left_atrium
        return replace(self, heart=self.heart.with_parameters({"circulation.left_atrium": pressure}))

    def beat(self) -> Beat:
        """Its beat on the limit cycle, with a right ventricle where one of its leaks leads there."""
        leaks = [m for m in self.heart.mechanisms if isinstance(m, Flow)]
        right = any("rv" in (leak.upstream, leak.downstream) for leak in leaks)
        spheres = [self.sphere, _right_of(self.sphere)] if right else [self.sphere]
        return simulate_spheres(self.heart, spheres, NUMERICS, self.activation, self.inertia)


def draw_hidden(rng: np.random.Generator) -> HiddenHeart:
    """A heart without any effect."""
    normal = Normal(rng)
    deviates = {name: normal() for name in (*RELATIVE, *TIMES, "cavity", "mitral resistance")}
    size, period = normal.factor(SIZE), PERIOD[0] + PERIOD[1] * normal()
    heart = deviating(_average(size, period), deviates, normal)
    cavity = size * CAVITY * np.exp(FILLED * deviates["cavity"])
    sphere = Sphere.of(cavity, size * WALL * normal.factor(AMOUNT))
    inertances = tuple((name, each / size * normal.factor(INERTANCE)) for name, each in INERTANCES.items())
    inertia = Inertia(DENSITY * normal.factor(MASS), inertances)
    return HiddenHeart(heart, sphere, ACTIVATION * normal.factor(SPREAD), inertia, deviates)


class Normal:
    """Standard normal numbers, cut off."""

    def __init__(self, rng: np.random.Generator) -> None:
        self._rng = rng

    def __call__(self) -> float:
        return float(np.clip(self._rng.standard_normal(), -FURTHEST, FURTHEST))

    def factor(self, sd: float) -> float:
        """A log-normal one about 1."""
        return float(np.exp(sd * self()))


def _average(size: float, period: float) -> Heart:
    """The heart about which those of this size and period, s, scatter."""
    heart = Heart(circulation=VALVES, period=period).with_parameters(CENTRE)
    smaller = dict.fromkeys((f"circulation.systemic.{name}" for name in ("R_p", "Z_c", "L")), 1.0 / size)
    larger = dict.fromkeys(
        (f"circulation.{name}" for name in ("mitral.area", "aortic.area", "first_stroke")), size
    )
    return _scaled(heart, smaller | larger | {"tissue.control.duration": np.sqrt(period / PERIOD[0])})


def deviating(heart: Heart, deviates: Mapping[str, float], normal: Normal) -> Heart:
    """The heart with its parameters at these deviates, and valves that scatter besides."""
    heart = _scaled(heart, {name: np.exp(sd * deviates[name]) for name, sd in RELATIVE.items()})
    values = heart.parameters()
    times = {name: values[heart.path_of(name)] + sd * deviates[name] for name, sd in TIMES.items()}
    mitral = normal.factor(AREA) * np.exp(-0.5 * RESISTANCE * deviates["mitral resistance"])
    areas = {"circulation.mitral.area": mitral, "circulation.aortic.area": normal.factor(AREA)}
    return _scaled(heart.with_parameters(times), areas)


def _scaled(heart: Heart, factors: Mapping[str, float]) -> Heart:
    values = heart.parameters()
    return heart.with_parameters({name: values[heart.path_of(name)] * each for name, each in factors.items()})


def _right_of(left: Sphere) -> Sphere:
    inner = left.radius - 0.5 * left.thickness
    return Sphere.of(RIGHT_CAVITY * 4.0 / 3.0 * np.pi * inner**3, RIGHT_WALL * left.wall)
