"""Mitral stenosis: a valve that opens too little and hinders filling."""

from dataclasses import dataclass

from heartfit.core.parameter import redeclared
from heartfit.roles import Stenosis, mechanism


@mechanism
@dataclass(frozen=True)
class MitralStenosis(Stenosis):
    """Loss in series with the mitral valve, stated at the mean flow of a normal filling; equations in ``Stenosis``.

    An effective orifice of A = 2 cm^2 (mild) has G = 0.5 kPa, one of 1.5 cm^2 (moderate from here) 0.94 kPa, one of
    1 cm^2 (severe from here) 2.1 kPa: two scales are moderate. The atrium keeps its pressure, so a ventricle
    that relaxes fast sucks; in a patient the atrial pressure rises instead.
    Source: Baumgartner et al., JASE 2009, 22:1.
    """

    valve = "mitral"
    reference_flow = 2e-4
    gradient: float = redeclared(
        Stenosis,
        "gradient",
        250.0,
        symbol="G_{mi}",
        meaning="pressure that the narrowing takes at 200 mL/s",
        scale=500.0,
    )
