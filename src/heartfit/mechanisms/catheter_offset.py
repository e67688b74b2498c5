"""Catheter offset: a pressure transducer that is not at the height of the heart, or not zeroed."""

from dataclasses import dataclass

from heartfit.core.arrays import Floats
from heartfit.core.parameter import parameter, require_admissible
from heartfit.roles import Sensor, mechanism


@mechanism
@dataclass(frozen=True)
class CatheterOffset(Sensor):
    r"""Left ventricular pressure plus a constant.

    .. math:: p'(t) = p(t) + p_0,

    :math:`p_0` is 98 Pa for every centimetre that the transducer of a fluid-filled catheter lies below the heart.
    Source: hydrostatics; levelling and zeroing in Gardner, Anesthesiology 1981, 54:227.
    """

    measures = ("lv_pressure",)
    offset: float = parameter(
        400.0,
        unit="Pa",
        symbol="p_0",
        meaning="pressure shown at no pressure",
        off=0.0,
        low=-5e3,
        scale=600.0,
    )

    def __post_init__(self) -> None:
        require_admissible(self)

    def distort(self, times: Floats, values: Floats, period: float) -> Floats:  # noqa: ARG002
        return values + self.offset
