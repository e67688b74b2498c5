"""Pulmonary regurgitation: a leak of the closed pulmonary valve in diastole."""

from dataclasses import dataclass

from heartfit.core.arrays import Floats
from heartfit.core.parameter import parameter, require_admissible
from heartfit.roles import Flow, mechanism
from heartfit.roles.laws import Branch


@mechanism
@dataclass(frozen=True)
class PulmonaryRegurgitation(Flow):
    r"""Backward flow through an effective regurgitant orifice of area A.

    .. math:: q = A \sqrt{2 \Delta p / \rho}, \qquad \Delta p = p_{PA} - p_{RV} > 0,

    with blood density 1060 kg/m^3. In the adult of the search two scales return 20 mL of a beat, a fifth of the stroke,
    and four scales 35 mL.
    Source: the orifice equation of clinical echocardiography (Zoghbi et al., JASE 2017, 30:303).
    """

    upstream = "pulmonary_artery"
    downstream = "rv"
    area: float = parameter(
        0.15e-4,
        unit="m^2",
        symbol="A",
        meaning="effective regurgitant orifice",
        sd=0.5,
        off=0.0,
        scale=0.15e-4,
    )

    def __post_init__(self) -> None:
        require_admissible(self)

    def law(self, time: Floats) -> Branch:  # noqa: ARG002
        return Branch(area=self.area)
