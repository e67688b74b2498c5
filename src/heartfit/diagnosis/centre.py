"""Where the search begins: a heart whose left ventricle is a sphere, about which everything unknown scatters."""

from dataclasses import dataclass, field, replace
from functools import cached_property
from math import sqrt

from heartfit.diagnosis.recording import Recording
from heartfit.heart import Heart
from heartfit.sphere.heart import Inertia

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

    filled: its end-diastolic volume, m^3; inertia: of wall and valves, which the heart itself leaves out.
    """

    heart: Heart
    cavity: float
    wall: float
    filled: float
    inertia: Inertia = field(default_factory=Inertia)

    @cached_property
    def values(self) -> dict[str, float]:
        """The parameters of the heart by path, SI."""
        return self.heart.parameters()

    def of_the_size_of(self, recording: Recording) -> "Centre":
        r"""The centre for a heart of another size and rate.

        At equal pressures volumes and flows grow as the size of the heart; the action potential lasts as the root of
        the period (Bazett 1920). Neither is a mechanism.
        """
        ratio = recording.end_diastolic_volume() / self.filled
        changed = {path: self.values[path] / ratio for path in PER_VOLUME}
        changed |= {path: self.values[path] * ratio for path in BY_VOLUME}
        valves = tuple((name, value / ratio) for name, value in self.inertia.valves)
        grown = Centre(
            self.heart.with_parameters(changed),
            ratio * self.cavity,
            ratio * self.wall,
            ratio * self.filled,
            replace(self.inertia, valves=valves),
        )
        return grown.beating(recording.period)

    def beating(self, period: float) -> "Centre":
        """The centre at another rate, its action potential as long as the root of the period, s."""
        duration = self.heart.tissue.control.duration * sqrt(period / self.heart.period)
        heart = replace(self.heart, period=period).with_parameters({"tissue.control.duration": duration})
        return replace(self, heart=heart)


HUMAN = Centre(
    Heart(period=0.86).with_parameters(
        {"sigma_0": 145e3, "starling.slope": 0.15, "circulation.aortic.open": 6e-7}
    ),
    cavity=1.3e-4,
    wall=2.55e-4,
    filled=1.48e-4,
    inertia=Inertia(density=1060.0, valves=(("mitral", 3.5e4), ("aortic", 3.5e4))),
)
"""An adult at rest: EDV 148, ESV 46 mL, peak pressure 15.6 kPa; all fibres of a sphere pull in its plane, hence the
contractility below that of a mesh. Blood of some 15 mm length moves in each valve, and the aortic one takes 0.8 kPa at
peak flow, 6 mmHg; bridges depend on length half as much as the cohort's."""
