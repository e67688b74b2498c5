"""Pulmonary stenosis: a valve that opens too little and loses pressure."""

from dataclasses import dataclass

from heartfit.core.parameter import redeclared
from heartfit.roles import Stenosis, mechanism


@mechanism
@dataclass(frozen=True)
class PulmonaryStenosis(Stenosis):
    """Loss in series with the pulmonary valve, stated at the peak flow of a normal ejection; equations in ``Stenosis``.

    Mild below a peak gradient of 4.8 kPa (36 mmHg), severe from 8.5 kPa (64 mmHg): two scales are mild, four moderate.
    Source: Baumgartner et al., JASE 2009, 22:1.
    """

    valve = "pulmonary"
    reference_flow = 4e-4
    gradient: float = redeclared(
        Stenosis,
        "gradient",
        2000.0,
        symbol="G_{pu}",
        meaning="pressure that the narrowing takes at 400 mL/s",
        scale=2000.0,
    )
