"""Aortic regurgitation: a leak of the closed aortic valve in diastole."""

from dataclasses import dataclass

from heartfit.core.arrays import Floats
from heartfit.core.parameter import parameter, require_admissible
from heartfit.roles import Flow, mechanism
from heartfit.roles.laws import Branch


@mechanism
@dataclass(frozen=True)
class AorticRegurgitation(Flow):
    r"""Backward flow through an effective regurgitant orifice of area A.

    .. math:: q = A \sqrt{2 \Delta p / \rho}, \qquad \Delta p = p_{ao} - p_{LV} > 0,

    with blood density 1060 kg/m^3. The drop lasts for all of diastole, so areas are smaller than those of the mitral
    valve: regurgitation is mild below 0.1 cm^2 and severe from 0.3 cm^2; two scales are the middle of moderate.
    Source: the orifice equation of clinical echocardiography (Zoghbi et al., JASE 2017, 30:303).
    """

    upstream = "aorta"
    downstream = "lv"
    area: float = parameter(
        0.1e-4,
        unit="m^2",
        symbol="A",
        meaning="effective regurgitant orifice",
        sd=0.5,
        off=0.0,
        scale=0.1e-4,
    )

    def __post_init__(self) -> None:
        require_admissible(self)

    def law(self, time: Floats) -> Branch:  # noqa: ARG002
        return Branch(area=self.area)
