"""Delayed activation: a part of the left ventricle that the wave reaches late, as in left bundle branch block."""

from dataclasses import dataclass

from heartfit.errors import InputError
from heartfit.geometry.arrays import Floats
from heartfit.geometry.territory import territory
from heartfit.mechanism import Delay, mechanism
from heartfit.parameter import parameter, require_admissible


@mechanism
@dataclass(frozen=True)
class DelayedActivation(Delay):
    r"""A share s of the left ventricle that is activated later by d than in health.

    .. math:: T_d(x) \to T_d(x) + d\, w(x; \varphi, s)

    with the weight w, 1 in the core of the :func:`~heartfit.geometry.territory.territory` about the angle
    :math:`\varphi` and fading at its border, as the wave gets there gradually. In left bundle branch block the lateral
    half follows the septum by some 60 to 100 ms.
    Sources: Auricchio et al., Circulation 2004, 109:1133; Strik et al., J Cardiovasc Transl Res 2012, 5:117.
    """

    lateness: float = parameter(
        0.06,
        unit="s",
        symbol="d",
        meaning="by how much the late side is activated later",
        off=0.0,
        scale=0.05,
    )
    angle: float = parameter(
        3.5,
        unit="rad",
        symbol=r"\varphi",
        meaning="middle of the late side, from the middle of the septum towards anterior: 3.5 posterolateral",
        low=-10.0,
        scale=0.7,
    )
    share: float = parameter(
        0.5, unit="1", symbol="s", meaning="late share of the left ventricle", scale=0.12
    )

    def __post_init__(self) -> None:
        require_admissible(self)
        if self.share > 1.0:
            raise InputError(f"DelayedActivation.share = {self.share:g}: expected a share, at most 1")

    def delay(self) -> Floats:
        return self.lateness * territory(self.angle, self.share)
