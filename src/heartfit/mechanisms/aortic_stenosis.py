"""Aortic stenosis: a valve that opens too little and loses pressure."""

from dataclasses import dataclass

from heartfit.core.parameter import redeclared
from heartfit.roles import Stenosis, mechanism


@mechanism
@dataclass(frozen=True)
class AorticStenosis(Stenosis):
    """Loss in series with the aortic valve, stated at the peak flow of a normal ejection; equations in ``Stenosis``.

    An effective orifice of A = 1.5 cm^2 (mild from here) has G = 3.8 kPa, one of 1 cm^2 (severe from here) 8.5 kPa.
    Source: Baumgartner et al., JASE 2017, 30:372.
    """

    valve = "aortic"
    reference_flow = 4e-4
    gradient: float = redeclared(
        Stenosis,
        "gradient",
        4000.0,
        symbol="G_{ao}",
        meaning="pressure that the narrowing takes at 400 mL/s",
        scale=4000.0,
    )
