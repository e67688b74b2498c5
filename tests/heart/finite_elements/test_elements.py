"""Locking: effect of the bulk modulus on a cantilever that can bend at constant volume."""

from collections.abc import Callable

import numpy as np
import pytest

from heartfit.heart.finite_elements.body import FiniteElementBody, Tissue
from heartfit.heart.muscle.passive import MooneyRivlin
from heartfit.heart.muscle.tissue import Support

CLAMPED = Support(k_b=1e10, k_p=0.0, annulus=1.0)
SHEAR = MooneyRivlin().shear_modulus


@pytest.fixture
def deflection(block: Callable, tangent_matrix: Callable) -> Callable[[str, float], float]:
    """Mean deflection of the free end under a small transverse force, m, for an element and K over G."""
    mesh = block((9, 3, 3))

    def bend(element: str, ratio: float) -> float:
        tissue = Tissue(element=element, support=CLAMPED, passive=MooneyRivlin(K=ratio * SHEAR))
        body = FiniteElementBody(mesh, tissue)
        rest = body.rest()
        load = np.zeros_like(rest.x)
        load[mesh.points[:, 0] > mesh.points[:, 0].max() - 1e-9, 2] = 1e-6
        matrix = tangent_matrix(body.static_step(rest), rest.x)
        return float(np.linalg.solve(matrix, load.ravel()) @ load.ravel() / load.sum())

    return bend


def test_the_displacement_element_locks(deflection: Callable[[str, float], float]) -> None:
    """A real beam's stiffness E = 9KG/(3K+G) gains 3 % from K = 10 G on; here it more than doubles."""
    soft, stiff = (deflection("p1", ratio) for ratio in (10.0, 1e3))
    assert soft > 2.5 * stiff


def test_the_mixed_element_does_not_lock(deflection: Callable[[str, float], float]) -> None:
    """The change allowed is that of E and of the clamp, whose end cannot widen; then K has no more effect."""
    soft, stiff, stiffer = (deflection("mixed", ratio) for ratio in (10.0, 1e3, 1e4))
    assert stiff == pytest.approx(soft, rel=0.08)
    assert stiffer == pytest.approx(stiff, rel=0.005)


def test_both_elements_agree_for_compressible_tissue(deflection: Callable[[str, float], float]) -> None:
    assert deflection("mixed", 1.0) == pytest.approx(deflection("p1", 1.0), rel=0.1)
