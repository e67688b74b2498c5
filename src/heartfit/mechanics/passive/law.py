r"""The passive slot: what the body asks of a passive law, and what the spheres ask beyond that.

A law gives the part of the stress that belongs to the tissue, the volumetric part of bulk modulus K belongs to the
element. Directions come as the dyads :math:`f \otimes f` of unit fibres; an isotropic law does not look at them.
"""

from typing import Protocol, runtime_checkable

from heartfit.errors import InputError
from heartfit.geometry.arrays import Floats


class Passive(Protocol):
    """A passive law of bulk modulus ``K`` (Pa) and viscosity ``eta`` (Pa.s).

    Arrays run over m elements: ``C`` (m, 6), ``J`` (m,), ``dyads`` (m, 6); ``scale`` (m,) multiplies the moduli.
    """

    def __hash__(self) -> int:
        """Laws are values: what is tabulated of one serves every equal one."""

    @property
    def K(self) -> float: ...
    @property
    def eta(self) -> float: ...
    @property
    def shear_modulus(self) -> float:
        """A shear modulus at small strains, Pa; weighs equations and stabilises the wall pressure."""

    def stress(self, C: Floats, J: Floats, scale: Floats, dyads: Floats, S: Floats) -> None:
        """Fill ``S`` (m, 6) with the second Piola-Kirchhoff stress, Pa."""

    def tangent(self, C: Floats, J: Floats, scale: Floats, dyads: Floats, D: Floats) -> None:
        r"""Fill ``D`` (m, 6, 6) with :math:`2\,\partial S/\partial C`, Pa."""


@runtime_checkable
class Isotropic(Protocol):
    """What the wall of a sphere asks: a law that is the same in all directions of its surface."""

    @property
    def eta(self) -> float: ...

    def in_plane_stress(self, stretch: Floats) -> Floats:
        r""":math:`dW/d\Lambda` of the incompressible stretch :math:`(\Lambda, \Lambda, \Lambda^{-2})`, Pa."""

    def in_plane_stiffness(self, stretch: Floats) -> Floats:
        """Derivative of :meth:`in_plane_stress`, Pa."""


def isotropic(law: Passive) -> Isotropic:
    """The law, if it is isotropic; raises InputError otherwise."""
    if not isinstance(law, Isotropic):
        raise InputError(
            f"the element sphere has fibres of all directions: expected an isotropic law, not {type(law).__name__}"
        )
    return law
