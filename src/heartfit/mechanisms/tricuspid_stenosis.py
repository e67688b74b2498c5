"""Tricuspid stenosis: a valve that opens too little and hinders filling."""

from dataclasses import dataclass

from heartfit.core.parameter import redeclared
from heartfit.roles import Stenosis, mechanism


@mechanism
@dataclass(frozen=True)
class TricuspidStenosis(Stenosis):
    """Loss in series with the tricuspid valve, stated at the mean flow of a normal filling; equations in ``Stenosis``.

    A mean gradient of 0.67 kPa (5 mmHg) is significant. The atrium keeps its pressure, so a ventricle that relaxes fast
    sucks; in a patient the atrial pressure rises instead.
    Source: Baumgartner et al., JASE 2009, 22:1.
    """

    valve = "tricuspid"
    reference_flow = 2e-4
    gradient: float = redeclared(
        Stenosis,
        "gradient",
        250.0,
        symbol="G_{tri}",
        meaning="pressure that the narrowing takes at 200 mL/s",
        scale=250.0,
    )
