"""Free parameters of the nominal heart, and their priors.

The calibrated parameters are among them, and the others are free too: a parameter held at a wrong value leaves a misfit
that some mechanism explains, in every heart (docs/how_a_mechanism_is_named.md). Those of the right heart are free where
its volume is searched.
"""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from math import exp
from typing import Literal

Standing = Literal["person", "people", "change"]
"""Whom the priors about a nominal heart describe: a person to whom it was fitted by other means, all people, or the
same person at another time, whose valves, wall and vessels stay while load, rhythm and contractility may change."""


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


def values_at(
    parameters: Sequence[FreeParameter],
    nominal: Mapping[str, float],
    x: Iterable[float],
    standing: Standing = "person",
) -> dict[str, float]:
    """Values [SI] of parameters of the heart, by path, at coordinates x (k,) about the ``nominal`` ones."""
    return {
        path: parameter.at(nominal[path], float(z), standing)
        for parameter, z in zip(parameters, x, strict=False)
        for path in parameter.paths
    }


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
RIGHT_SPHERE_PARAMETERS = (
    FreeParameter(("right_cavity",), 0.15, 0.20, 0.15),
    FreeParameter(("tricuspid_inertance",), 0.40, 0.40, 0.10),
    FreeParameter(("pulmonary_inertance",), 0.40, 0.40, 0.10),
    FreeParameter(("right_gain",), 0.10, source="gain of right volumes between readers and methods"),
)
"""Unknowns of the right sphere: cavity volume, inertance of the blood in its valves, and gain of the images, which
show the thin trabeculated wall less well than the left one."""
RIGHT_HEART_PARAMETERS = (
    FreeParameter(("tissue.right.contractility",), 0.25),
    FreeParameter(("tissue.right.delay",), 0.006, additive=True, source="5 to 10 ms, Durrer et al. 1970"),
    FreeParameter(("tissue.right.stiffness",), 0.30),
    FreeParameter(("circulation.pulmonary_tree.R_p",), 0.30),
    FreeParameter(("circulation.pulmonary_tree.tau",), 0.25),
    FreeParameter(("circulation.pulmonary_tree.Z_c",), 0.30),
    FreeParameter(("circulation.right_atrium",), 0.30),
    FreeParameter(("circulation.tricuspid.open",), 0.40),
    FreeParameter(("circulation.pulmonary.open",), 0.40),
)
FREE_PARAMETERS = (*SPHERE_PARAMETERS, *HEART_PARAMETERS)
RIGHT_FREE_PARAMETERS = (*RIGHT_SPHERE_PARAMETERS, *RIGHT_HEART_PARAMETERS)
TIME_SHIFT_INDEX = FREE_PARAMETERS.index(HEART_PARAMETERS[-1])
"""The coordinate that does not change the beat but shifts the time zero of the recording."""
