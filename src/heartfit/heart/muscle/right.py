r"""Free wall of the right ventricle: its muscle relative to that of the left ventricle and the septum.

With the share :math:`\kappa` of the cross-bridges, the delay d and the share :math:`\beta` of the passive moduli,

.. math:: n_0 \to \kappa\, n_0, \qquad T_d \to T_d + d, \qquad W \to \beta\, W

in region 0 of the wall. :math:`n_0` multiplies :math:`k_0` and :math:`\sigma_0` alike, so that :math:`\kappa` scales
stress and stiffness of its contraction. The viscosity, the bulk modulus and energies added by mechanisms are those of
the left ventricle, as in the annuli.
"""

from dataclasses import dataclass

from heartfit.core.parameter import parameter, require_admissible


@dataclass(frozen=True)
class RightVentricle:
    """Muscle of the right free wall over that of the left ventricle; the defaults are the same muscle.

    The deviations are choices of this project. Maximal force per area of human strips differs little between both
    ventricles (Blair et al., JACC Basic Transl Sci 2020, 5:786), which supports the mean of one. The right ventricle is
    activated 5 to 10 ms after the left one (Durrer et al., Circulation 1970, 41:899); ``delay`` is in addition to the
    activation of the mesh or of the fibre classes. Its prior is log-normal and needs a positive median: the study uses
    20 ms, which the deviation spreads to 6 to 65 ms (95 %).
    """

    contractility: float = parameter(
        1.0, unit="1", symbol=r"\kappa", meaning="bridges of the right wall over the left one's", sd=0.25
    )
    delay: float = parameter(
        0.0, unit="s", symbol="d", meaning="delay of the activation of the right wall", sd=0.6
    )
    stiffness: float = parameter(
        1.0, unit="1", symbol=r"\beta", meaning="passive moduli of the right wall over the left one's", sd=0.3
    )

    def __post_init__(self) -> None:
        require_admissible(self)


SAME_MUSCLE = RightVentricle()
