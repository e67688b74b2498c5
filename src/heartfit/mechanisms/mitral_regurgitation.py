"""Mitral regurgitation: a leak of the closed mitral valve in systole."""

from dataclasses import dataclass

from heartfit.circulation.valves import orifice_flow
from heartfit.mechanism import Flow, mechanism
from heartfit.parameter import parameter, require_admissible


@mechanism
@dataclass(frozen=True)
class MitralRegurgitation(Flow):
    r"""Backward flow through an effective regurgitant orifice of area A.

    .. math:: q = A \sqrt{2 \Delta p / \rho}, \qquad \Delta p = p_{LV} - p_{LA} > 0,

    with blood density 1060 kg/m^3. Severe regurgitation starts at A = 0.4 cm^2.
    Source: the orifice equation of clinical echocardiography (Zoghbi et al., JASE 2017).
    """

    upstream = "lv"
    downstream = "left_atrium"
    area: float = parameter(
        0.2e-4, unit="m^2", symbol="A", meaning="effective regurgitant orifice", sd=0.5, off=0.0
    )

    def __post_init__(self) -> None:
        require_admissible(self)

    def flow(self, time: float, drop: float) -> tuple[float, float]:  # noqa: ARG002
        return orifice_flow(self.area, drop) if drop > 0.0 else (0.0, 0.0)
