"""Form that the leaks of the four closed valves share: an orifice, whatever drives the blood back."""

from dataclasses import dataclass

from heartfit.core.arrays import Floats
from heartfit.core.parameter import parameter, require_admissible
from heartfit.roles.interfaces import Flow
from heartfit.roles.laws import Branch


@dataclass(frozen=True)
class Regurgitation(Flow):
    r"""Backward flow through an effective regurgitant orifice of area A.

    .. math:: q = A \sqrt{2 \Delta p / \rho}, \qquad \Delta p = p_{upstream} - p_{downstream} > 0,

    with blood density 1060 kg/m^3. A subclass names both compartments and declares the scale of its area.
    Source: the orifice equation of clinical echocardiography (Zoghbi et al., JASE 2017, 30:303).
    """

    area: float = parameter(
        0.2e-4,
        unit="m^2",
        symbol="A",
        meaning="effective regurgitant orifice",
        sd=0.5,
        off=0.0,
        scale=0.2e-4,
    )

    def __post_init__(self) -> None:
        require_admissible(self)

    def law(self, time: Floats) -> Branch:  # noqa: ARG002
        return Branch(area=self.area)
