"""Delayed activation: a part of the left ventricle that the wave reaches late, as in left bundle branch block."""

from dataclasses import dataclass

from heartfit.core.arrays import Floats
from heartfit.core.errors import InputError
from heartfit.core.parameter import parameter, require_admissible
from heartfit.geometry.territory import territory_weights
from heartfit.roles import Delay, mechanism


@mechanism
@dataclass(frozen=True)
class DelayedActivation(Delay):
    r"""Activation of a share s of the left ventricle that is later by d than in health.

    .. math:: T_d(x) \to T_d(x) + d\, w(x; \varphi, s)

    with the weight w, 1 in the core of the :func:`~heartfit.geometry.territory.territory_weights` about the angle
    :math:`\varphi` and fading at its border, which the wave reaches gradually. In left bundle branch block the lateral
    half follows the septum by some 60 to 100 ms.
    Sources: Auricchio et al., Circulation 2004, 109:1133; Strik et al., J Cardiovasc Transl Res 2012, 5:117.
    """

    lateness: float = parameter(
        0.06,
        unit="s",
        symbol="d",
        meaning="delay of the activation of the late side",
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
        return self.lateness * territory_weights(self.angle, self.share)
