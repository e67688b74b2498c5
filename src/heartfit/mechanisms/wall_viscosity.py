"""Wall viscosity: a matrix that resists fast filling and fast ejection alike."""

from dataclasses import dataclass

from heartfit.core.parameter import parameter, require_admissible
from heartfit.roles import Amendment, mechanism


@mechanism
@dataclass(frozen=True)
class WallViscosity(Amendment):
    r"""Viscosity in addition to that of the passive law.

    .. math:: S_v = (\eta + a)\, \dot E

    An oedematous or fibrotic wall takes more pressure to fill fast: the difference between the diastolic pressures of
    a fast and of a slow filling at the same volume.
    Sources: Templeton et al., Am J Physiol 1972, 223:555; Rankin et al., Circ Res 1977, 41:37.
    """

    amends = "passive.eta"
    thickening: float = parameter(
        200.0, unit="Pa.s", symbol="a", meaning="viscosity added to that of the matrix", off=0.0, scale=200.0
    )

    def __post_init__(self) -> None:
        require_admissible(self)

    def amend(self, value: float, period: float) -> float:  # noqa: ARG002
        return value + self.thickening
