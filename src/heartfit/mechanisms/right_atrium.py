"""Right atrium: a chamber with a volume, filled by the systemic veins."""

from dataclasses import dataclass

from heartfit.core.parameter import redeclared
from heartfit.roles import ElasticAtrium, mechanism


@mechanism
@dataclass(frozen=True)
class RightAtrium(ElasticAtrium):
    r"""Volume of the right atrium, softer and filled by the systemic veins; equations in ``ElasticAtrium``.

    With an elastance :math:`E_{sv} > 0` the systemic arteries fill the veins. The circuit is closed if the veins of
    both atria have an elastance.
    Source: Maceira et al., J Cardiovasc Magn Reson 2013, 15:29, for volumes. The values are ours: the standard heart
    has a mean pressure of 510 Pa (3.8 mmHg) and 35 to 60 mL.
    """

    compartment = "right_atrium"
    resistance: float = redeclared(ElasticAtrium, "resistance", 2e6, symbol="R_{sv}")
    reservoir: float = redeclared(ElasticAtrium, "reservoir", 700.0, symbol="P_{sv}")
    unstressed: float = redeclared(ElasticAtrium, "unstressed", 20e-6, symbol="V_{0,ra}")
    passive: float = redeclared(ElasticAtrium, "passive", 1.2e7, symbol="E_{0,ra}")
    scale: float = redeclared(ElasticAtrium, "scale", 60e-6, symbol="V_{s,ra}")
    active: float = redeclared(ElasticAtrium, "active", 1.2e7, symbol="E_{act,ra}")
    descent: float = redeclared(ElasticAtrium, "descent", 0.0, symbol=r"\kappa_{ra}")
    ventricle: float = redeclared(ElasticAtrium, "ventricle", 1e-4, symbol="V_{ref,rv}")
    veins: float = redeclared(ElasticAtrium, "veins", 0.0, symbol="E_{sv}")
