"""Scar: muscle of one artery's territory that no longer contracts."""

from dataclasses import dataclass

from heartfit.core.arrays import Floats
from heartfit.core.errors import InputError
from heartfit.core.parameter import parameter, require_admissible
from heartfit.geometry.territory import territory_weights
from heartfit.roles import Availability, mechanism


@mechanism
@dataclass(frozen=True)
class Scar(Availability):
    r"""An infarcted share s of the left ventricle, in which the share l of the cross-bridges is lost.

    .. math:: n_0(x) \to (1 - l\, w(x; \varphi, s))\, n_0(x)

    with the weight w, 1 in the core of the :func:`~heartfit.geometry.territory.territory_weights` about the angle
    :math:`\varphi` and fading over its border zone; the mean of w over the left ventricle is s. The passive
    stiffness is unchanged. Large infarcts are 20 to 30 % of the ventricle.
    Sources: territories of Cerqueira et al., Circulation 2002, 105:539; infarct size as share of the ventricle in Stone
    et al., JACC 2016, 67:1674.
    """

    extent: float = parameter(
        0.2, unit="1", symbol="s", meaning="scarred share of the left ventricle", off=0.0, scale=0.12
    )
    angle: float = parameter(
        1.05,
        unit="rad",
        symbol=r"\varphi",
        meaning="middle of the scar, from the middle of the septum towards anterior: 1 LAD, 3.1 LCX, 5.2 RCA",
        low=-10.0,
        scale=1.5,
    )
    loss: float = parameter(0.9, unit="1", symbol="l", meaning="share of the bridges lost in the core")

    def __post_init__(self) -> None:
        require_admissible(self)
        for name in ("extent", "loss"):
            if getattr(self, name) > 1.0:
                raise InputError(f"Scar.{name} = {getattr(self, name):g}: expected a share, at most 1")

    def lost_share(self) -> Floats:
        return self.loss * territory_weights(self.angle, self.extent)
