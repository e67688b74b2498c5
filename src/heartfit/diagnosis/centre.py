"""Where the search begins: a heart whose left ventricle is a sphere, about which everything unknown scatters."""

from dataclasses import dataclass, field, replace
from functools import cached_property
from math import sqrt

from heartfit.beat import Beat
from heartfit.diagnosis.recording import Recording
from heartfit.heart import Heart
from heartfit.mechanics.sphere import ACTIVATION, Sphere
from heartfit.simulation import Numerics
from heartfit.sphere.heart import Inertia
from heartfit.sphere.simulation import simulate_spheres

PER_VOLUME = (
    "circulation.systemic.R_p",
    "circulation.systemic.Z_c",
    "circulation.systemic.L",
)
"""What falls as 1/size at equal pressures and times."""

BY_VOLUME = (
    "circulation.mitral.open",
    "circulation.aortic.open",
    "circulation.first_stroke",
)
"""What grows as size."""


@dataclass(frozen=True)
class Centre:
    """A heart and the volumes, m^3, of the stress-free cavity and of the wall of its left ventricle, a sphere.

    filled: its end-diastolic volume, m^3; inertia: of wall and valves, which the heart itself leaves out;
    spread: how long the activation takes over that of a healthy sphere.
    """

    heart: Heart
    cavity: float
    wall: float
    filled: float
    inertia: Inertia = field(default_factory=Inertia)
    spread: float = 1.0

    @cached_property
    def values(self) -> dict[str, float]:
        """The parameters of the heart by path, SI."""
        return self.heart.parameters()

    def beat(self, numerics: Numerics) -> Beat:
        """The beat of its sphere."""
        sphere = Sphere.of(self.cavity, self.wall)
        return simulate_spheres(self.heart, [sphere], numerics, self.spread * ACTIVATION, self.inertia)

    def of_the_size_of(self, recording: Recording) -> "Centre":
        r"""The centre for a heart of another size and rate.

        At equal pressures volumes and flows grow as the size of the heart; the action potential lasts as the root of
        the period (Bazett 1920). Neither is a mechanism.
        """
        ratio = recording.end_diastolic_volume() / self.filled
        changed = {path: self.values[path] / ratio for path in PER_VOLUME}
        changed |= {path: self.values[path] * ratio for path in BY_VOLUME}
        valves = tuple((name, value / ratio) for name, value in self.inertia.valves)
        grown = replace(
            self,
            heart=self.heart.with_parameters(changed),
            cavity=ratio * self.cavity,
            wall=ratio * self.wall,
            filled=ratio * self.filled,
            inertia=replace(self.inertia, valves=valves),
        )
        return grown.beating(recording.period)

    def beating(self, period: float) -> "Centre":
        """The centre at another rate, its action potential as long as the root of the period, s."""
        duration = self.heart.tissue.control.duration * sqrt(period / self.heart.period)
        heart = replace(self.heart, period=period).with_parameters({"tissue.control.duration": duration})
        return replace(self, heart=heart)


HUMAN = Centre(
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
"""An adult at rest: EDV 151, ESV 58 mL, peak pressure 15.4 kPa; all fibres of a sphere pull in its plane, hence the
contractility below that of a mesh. Blood of some 15 mm length moves in each valve; at a peak flow of 500 mL/s the
mitral valve takes 0.25 kPa, the aortic one 0.8 kPa, as Doppler velocities of 0.7 and 1.2 m/s say."""
