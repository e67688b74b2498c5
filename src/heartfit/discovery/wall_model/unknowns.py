r"""Unknowns of a heart in three dimensions that every hypothesis leaves free, and their priors.

The parameters of muscle, circulation and right ventricle are those of the search on the sphere. The wall adds its own:
no ventricle contracts evenly, and a segment held at the mean leaves a misfit of its strain that some scar or late wall
explains. With N(0, 1) coordinates z

.. math:: n_{0,s} \to n_{0,s}\, e^{0.15 z_s}, \qquad T_s \to T_s + 8\,\mathrm{ms}\; z'_s

in every AHA segment s, both helix angles, of the endocardium and of the epicardium, by 10 degrees, the pressures that
load the measured end-diastolic wall by 20 %, and the orifices of the valves by 20 %: a valve without any Bernoulli loss
leaves a misfit that some stenosis explains.
"""

from dataclasses import dataclass, field, replace

import numpy as np

from heartfit.core.arrays import Floats
from heartfit.discovery.inference.hypothesis import Coordinate
from heartfit.discovery.sphere_model.free_parameters import (
    HEART_PARAMETERS,
    RIGHT_HEART_PARAMETERS,
    FreeParameter,
    values_at,
)
from heartfit.geometry.territory import APEX, REGIONS
from heartfit.heart.circulation.elements import SeriesValve
from heartfit.heart.heart import Heart
from heartfit.roles import Availability, Delay

CONTRACTILITY_SD, ACTIVATION_SD = 0.15, 0.008
"""Natural variation of the contractility [logarithm] and of the activation [s] of a segment."""
HELIX_SD, LOAD_SD = np.deg2rad(10.0), 0.20
"""Standard deviations of a helix angle [rad] and of an end-diastolic pressure [logarithm]."""
LATE_RIGHT = "tissue.right.delay"
"""Left out: the conduction of the mesh already gives the delay of the right wall, which cannot be negative."""
ORIFICES = {"mitral": 4.5e-4, "aortic": 3.5e-4, "tricuspid": 7e-4, "pulmonary": 3.5e-4}
"""Effective orifices of normal valves [m^2]. Sources: 4 to 6 cm^2 (mitral), Baumgartner et al., JASE 2009, 22:1; 3 to
4 cm^2 (aortic, assumed for the pulmonary valve), JASE 2017, 30:372; tricuspid 7 to 9 cm^2, JASE 2009."""
ORIFICE_SD = 0.20
PARAMETERS: tuple[FreeParameter, ...] = (
    *HEART_PARAMETERS,
    *(parameter for parameter in RIGHT_HEART_PARAMETERS if parameter.name != LATE_RIGHT),
    *(FreeParameter((f"circulation.{valve}.area",), ORIFICE_SD) for valve in ORIFICES),
)
LOADS = ("load.lv", "load.rv")
HELIX = ("helix.endo", "helix.epi")
SEGMENTS = [f"{segment:02d}" for segment in range(1, APEX + 1)]
CONTRACTILITY, ACTIVATION = ([f"{kind}.{segment}" for segment in SEGMENTS] for kind in ("segment", "delay"))


@dataclass(frozen=True, eq=False)
class WallVariation(Availability, Delay):
    """Natural variation of the left ventricular wall: coordinates (17,) of its contractility and of its activation."""

    contractility: Floats = field(default_factory=lambda: np.zeros(APEX))
    activation: Floats = field(default_factory=lambda: np.zeros(APEX))

    def lost_share(self) -> Floats:
        lost = np.zeros(REGIONS)
        lost[1:] = 1.0 - np.exp(CONTRACTILITY_SD * self.contractility)
        return lost

    def delay(self) -> Floats:
        late = np.zeros(REGIONS)
        late[1:] = ACTIVATION_SD * self.activation
        return late


@dataclass(frozen=True, eq=False)
class HeartInWall:
    """A heart, the pressures (2,) [Pa] that load its measured wall, and the changes (2,) of its helix angles [rad]."""

    heart: Heart
    loads: Floats
    helix: Floats = field(default_factory=lambda: np.zeros(2))

    @classmethod
    def loaded(cls, heart: Heart, left: float, right: float) -> "HeartInWall":
        """The heart in a wall with these end-diastolic pressures [Pa], its linear valves with normal orifices."""
        valves = {
            name: SeriesValve(getattr(heart.circulation, name).open, area=area)
            for name, area in ORIFICES.items()
        }
        circulation = replace(heart.circulation, **valves)  # type: ignore[arg-type]
        return cls(replace(heart, circulation=circulation), np.array([left, right]))


NAMES = tuple([*(parameter.name for parameter in PARAMETERS), *LOADS, *HELIX, *CONTRACTILITY, *ACTIVATION])
COORDINATES = tuple(map(Coordinate, NAMES))


def heart_at(nominal: HeartInWall, x: Floats) -> HeartInWall:
    """The heart in its wall at the coordinates x (b,); raises ValueError outside the range of a parameter."""
    counts = np.cumsum([len(PARAMETERS), len(LOADS), len(HELIX), APEX])
    own, loads, helix, contractility, activation = np.split(x[: len(NAMES)], counts)
    values = nominal.heart.parameters()
    heart = nominal.heart.with_parameters(values_at(PARAMETERS, values, own)) + WallVariation(
        contractility, activation
    )
    return replace(
        nominal, heart=heart, loads=nominal.loads * np.exp(LOAD_SD * loads), helix=HELIX_SD * helix
    )
