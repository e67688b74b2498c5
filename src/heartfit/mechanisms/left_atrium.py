"""Left atrium: a chamber with a volume, filled by the pulmonary veins."""

from dataclasses import dataclass

from heartfit.core.parameter import redeclared
from heartfit.roles import ElasticAtrium, mechanism


@mechanism
@dataclass(frozen=True)
class LeftAtrium(ElasticAtrium):
    r"""Volume of the left atrium, filled by the pulmonary veins; equations in ``ElasticAtrium``.

    With an elastance :math:`E_{pv} > 0` the pulmonary arteries fill the veins. The passive elastance is ours: the
    standard heart fills 32 to 59 mL.
    """

    compartment = "left_atrium"
    resistance: float = redeclared(ElasticAtrium, "resistance", 4e6, symbol="R_{pv}")
    reservoir: float = redeclared(ElasticAtrium, "reservoir", 1350.0, symbol="P_{pv}")
    unstressed: float = redeclared(ElasticAtrium, "unstressed", 20e-6, symbol="V_{0,la}")
    passive: float = redeclared(ElasticAtrium, "passive", 2.4e7, symbol="E_{0,la}")
    scale: float = redeclared(ElasticAtrium, "scale", 60e-6, symbol="V_{s,la}")
    active: float = redeclared(ElasticAtrium, "active", 2.5e7, symbol="E_{act,la}")
    descent: float = redeclared(ElasticAtrium, "descent", 0.0, symbol=r"\kappa_{la}")
    ventricle: float = redeclared(ElasticAtrium, "ventricle", 1e-4, symbol="V_{ref,lv}")
    veins: float = redeclared(ElasticAtrium, "veins", 0.0, symbol="E_{pv}")
