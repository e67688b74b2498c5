"""Tricuspid regurgitation: a leak of the closed tricuspid valve in systole."""

from dataclasses import dataclass

from heartfit.core.arrays import Floats
from heartfit.core.parameter import parameter, require_admissible
from heartfit.roles import Flow, mechanism
from heartfit.roles.laws import Branch


@mechanism
@dataclass(frozen=True)
class TricuspidRegurgitation(Flow):
    r"""Backward flow through an effective regurgitant orifice of area A.

    .. math:: q = A \sqrt{2 \Delta p / \rho}, \qquad \Delta p = p_{RV} - p_{RA} > 0,

    with blood density 1060 kg/m^3. The right ventricle drives it with a fifth of the left one's pressure, so areas are
    larger than those of the mitral valve: severe regurgitation starts at A = 0.4 cm^2, two scales.
    Source: the orifice equation of clinical echocardiography (Zoghbi et al., JASE 2017, 30:303).
    """

    upstream = "rv"
    downstream = "right_atrium"
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
