r"""The nominal heart of the search, and its free parameters.

The search leaves twenty-three unknowns of every heart free, each about its nominal value theta_0:

.. math:: \theta = \theta_0 e^{s x} \quad\text{or}\quad \theta = \theta_0 + s x, \qquad x \sim N(0, 1) ,

the latter for times, and for the length dependence, which a nominal heart in 3-D may not have at all.

The calibrated parameters are among them, and the others are free too: a parameter held at a wrong value leaves a misfit
that some mechanism explains, in every heart (docs/discovery.md). Size is free through the volume of the stress-free
cavity.
"""

from dataclasses import dataclass, field, replace
from functools import cached_property
from math import exp, sqrt
from typing import Literal

from heartfit.core.arrays import Floats
from heartfit.discovery.sphere_model.recording import Recording
from heartfit.heart.beat import Beat
from heartfit.heart.heart import Heart
from heartfit.heart.simulation import Numerics
from heartfit.heart.sphere.body import HEALTHY_ACTIVATION, Sphere
from heartfit.heart.sphere.heart import Inertia
from heartfit.heart.sphere.simulation import simulate_spheres

INVERSE_TO_SIZE = (
    "circulation.systemic.R_p",
    "circulation.systemic.Z_c",
    "circulation.systemic.L",
)
"""Parameters that fall as 1/size at equal pressures and times."""

PROPORTIONAL_TO_SIZE = (
    "circulation.mitral.open",
    "circulation.aortic.open",
    "circulation.first_stroke",
)
"""Parameters that grow as size."""


Standing = Literal["person", "people", "change"]
"""Whom the priors about a nominal heart describe: a person to whom it was fitted by other means, all people, or the
same person at another time, whose valves, wall and vessels stay while load, rhythm and contractility may change."""


@dataclass(frozen=True)
class NominalHeart:
    """A heart whose left ventricle is a sphere: volumes of its stress-free cavity and of its wall [m^3].

    filled: end-diastolic volume [m^3]; inertia: of wall and valves, which the heart itself leaves out; spread: duration
    of the activation over that of a healthy sphere; stands_for: whom the priors of the free parameters describe.
    """

    heart: Heart
    cavity: float
    wall: float
    filled: float
    inertia: Inertia = field(default_factory=Inertia)
    spread: float = 1.0
    stands_for: Standing = "person"

    @cached_property
    def values(self) -> dict[str, float]:
        """Parameters of the heart by path [SI]."""
        return self.heart.parameters()

    def beat(self, numerics: Numerics) -> Beat:
        """Simulate the beat of the sphere."""
        sphere = Sphere.from_volumes(self.cavity, self.wall)
        return simulate_spheres(
            self.heart, [sphere], numerics, self.spread * HEALTHY_ACTIVATION, self.inertia
        )

    def scaled_to(self, recording: Recording) -> "NominalHeart":
        """Scale the heart to the size and rate of a recorded one.

        At equal pressures volumes and flows grow as the size of the heart; the action potential lasts as the root of
        the period (Bazett 1920). Neither is a mechanism.
        """
        ratio = recording.end_diastolic_volume() / self.filled
        changed = {path: self.values[path] / ratio for path in INVERSE_TO_SIZE}
        changed |= {path: self.values[path] * ratio for path in PROPORTIONAL_TO_SIZE}
        valves = tuple((name, value / ratio) for name, value in self.inertia.valves)
        grown = replace(
            self,
            heart=self.heart.with_parameters(changed),
            cavity=ratio * self.cavity,
            wall=ratio * self.wall,
            filled=ratio * self.filled,
            inertia=replace(self.inertia, valves=valves),
        )
        return grown.at_period(recording.period)

    def at_period(self, period: float) -> "NominalHeart":
        """The heart at another period [s], its action potential scaled by the root of the period (Bazett 1920)."""
        duration = self.heart.tissue.control.duration * sqrt(period / self.heart.period)
        heart = replace(self.heart, period=period).with_parameters({"tissue.control.duration": duration})
        return replace(self, heart=heart)


ADULT = NominalHeart(
    Heart(period=0.86).with_parameters(
        {
            "sigma_0": 190e3,
            "R_p": 1.15e8,
            "starling.slope": 0.2,
            "circulation.left_atrium": 900.0,
            "circulation.mitral.open": 2e-6,
            "circulation.aortic.open": 6e-7,
        }
    ),
    cavity=1.2e-4,
    wall=1.2e-4,
    filled=1.5e-4,
    inertia=Inertia(density=1060.0, valves=(("mitral", 3.5e4), ("aortic", 3.5e4))),
)
"""An adult at rest: EDV 151 mL, ESV 58 mL, peak pressure 15.4 kPa. All fibres of a sphere pull in the plane of
its wall,
hence a contractility below that of a mesh. A column of blood of some 15 mm moves in each valve; at a peak flow of
500 mL/s the pressure drops by 0.25 kPa over the mitral and by 0.8 kPa over the aortic valve, in agreement with Doppler
velocities of 0.7 and 1.2 m/s."""
PEOPLE = replace(ADULT, heart=ADULT.heart.with_parameters({"trigger_delay": 0.015}), stands_for="people")
"""The middle of all people: the pressure rises most steeply some 60 ms after the R wave (in people 50 to 70 ms), in the
ADULT, about whom the hidden hearts of the benchmark are drawn, 30 ms after it."""


@dataclass(frozen=True)
class FreeParameter:
    """Parameters by their paths below the heart, which vary as one, and standard deviations by what a heart stands for.

    person, people, change: see ``Standing``; of the logarithms or, if additive, of the values [SI]; if None, that of
    a person. source: of the spread between people.
    """

    paths: tuple[str, ...]
    person: float
    people: float | None = None
    change: float | None = None
    additive: bool = False
    source: str = "assumed"

    @property
    def name(self) -> str:
        """The first path."""
        return self.paths[0]

    @property
    def change_unit(self) -> Literal["ratio", "s", "1"]:
        """Unit of a change: a ratio, or the difference of a time [s] or of a number."""
        if not self.additive:
            return "ratio"
        return "s" if self.name.startswith("tissue.control.") else "1"

    def at(self, nominal: float, x: float, standing: Standing = "person") -> float:
        """Value [SI] at x standard deviations from the nominal one."""
        sd: float | None = getattr(self, standing)
        difference = (self.person if sd is None else sd) * x
        return nominal + difference if self.additive else nominal * exp(difference)


SPHERE_PARAMETERS = (
    FreeParameter(("cavity",), 0.15, 0.20, 0.15),
    FreeParameter(("spread",), 0.20, 0.30, 0.10),
    FreeParameter(("mitral_inertance",), 0.40, 0.40, 0.10),
    FreeParameter(("aortic_inertance",), 0.40, 0.40, 0.10),
)
"""Unknowns of the sphere: cavity volume, duration of the activation, and inertance of the blood in the valves."""
HEART_PARAMETERS = (
    FreeParameter(("tissue.active.sigma_0",), 0.20, 0.25, 0.25),
    FreeParameter(("tissue.active.mu",), 0.30, 0.30, 0.10),
    FreeParameter(("tissue.passive.c_1",), 0.30, 0.40, 0.30),
    FreeParameter(("circulation.systemic.R_p",), 0.20, 0.25, 0.30),
    FreeParameter(
        ("tissue.control.k_RS",), 0.20, 0.35, 0.20, source="assumed; tau of human relaxation 30 to 60 ms"
    ),
    FreeParameter(("tissue.control.k_ATP",), 0.20, 0.30, 0.20),
    FreeParameter(("circulation.systemic.tau",), 0.20, 0.30, 0.20),
    FreeParameter(
        ("circulation.systemic.Z_c",),
        0.20,
        0.35,
        0.10,
        source="assumed; about aortic input impedance of normal men, Murgo et al. 1980",
    ),
    FreeParameter(("circulation.systemic.L",), 0.30, 0.40, 0.10),
    FreeParameter(("tissue.active.k_0",), 0.30, 0.30, 0.10),
    FreeParameter(("tissue.active.alpha",), 0.30, 0.30, 0.10),
    FreeParameter(("tissue.active.starling.slope",), 0.10, 0.20, 0.05, additive=True),
    FreeParameter(
        ("circulation.left_atrium",),
        0.15,
        0.30,
        0.40,
        source="wedge pressure at rest 8.0 (sd 2.9) mmHg, Kovacs et al. 2009",
    ),
    FreeParameter(("circulation.mitral.open",), 0.40, 0.40, 0.10),
    FreeParameter(("circulation.aortic.open",), 0.40, 0.40, 0.10),
    FreeParameter(("tissue.passive.eta",), 0.30, 0.30, 0.10),
    FreeParameter(
        ("tissue.control.duration",),
        0.015,
        0.025,
        0.025,
        additive=True,
        source="assumed; QT at one rate varies by some 20 ms",
    ),
    FreeParameter(
        ("tissue.control.onset",), 0.008, 0.020, 0.010, additive=True, source="PR interval 160 (sd 20) ms"
    ),
    FreeParameter(
        ("tissue.control.trigger_delay",),
        0.020,
        0.025,
        0.020,
        additive=True,
        source="R wave 50 to 70 ms before the steepest upstroke; leads and detection",
    ),
)
"""The trigger, which the leads and the detection of the R wave decide, varies by tens of milliseconds between
recordings; it shifts both curves and is no disease."""
FREE_PARAMETERS = (*SPHERE_PARAMETERS, *HEART_PARAMETERS)
TIME_SHIFT_INDEX = FREE_PARAMETERS.index(HEART_PARAMETERS[-1])
"""The coordinate that does not change the beat but shifts the time zero of the recording."""


def perturb(nominal: NominalHeart, x: Floats) -> NominalHeart:
    """The nominal heart at the coordinates x (d,), d up to the number of free parameters."""
    cavity, spread, *inertances = (
        parameter.at(1.0, float(z), nominal.stands_for)
        for parameter, z in zip(SPHERE_PARAMETERS, x, strict=False)
    )
    factors = dict(zip(("mitral", "aortic"), inertances, strict=True))
    valves = tuple((name, value * factors.get(name, 1.0)) for name, value in nominal.inertia.valves)
    return replace(
        nominal,
        heart=nominal.heart.with_parameters(_parameters(nominal, x[len(SPHERE_PARAMETERS) :])),
        cavity=cavity * nominal.cavity,
        spread=spread * nominal.spread,
        inertia=replace(nominal.inertia, valves=valves),
    )


def _parameters(nominal: NominalHeart, x: Floats) -> dict[str, float]:
    """Parameters of the heart by path, SI."""
    return {
        path: parameter.at(nominal.values[path], float(z), nominal.stands_for)
        for parameter, z in zip(HEART_PARAMETERS, x, strict=False)
        for path in parameter.paths
    }
