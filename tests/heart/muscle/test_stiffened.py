"""Energies of one invariant beside a passive law: derivatives, objectivity, and agreement with the spheres."""

import numpy as np
import pytest

from heartfit.core.errors import InputError
from heartfit.heart.finite_elements.kinematics import fibre_dyads
from heartfit.heart.muscle.guccione import Guccione
from heartfit.heart.muscle.passive import MooneyRivlin, require_isotropic
from heartfit.heart.muscle.stiffened import Stiffened
from heartfit.roles import Stress, registered
from tests.shrinking import assert_derivative

STRESSES = {name: kind for name, kind in registered().items() if issubclass(kind, Stress)}
all_stresses = pytest.mark.parametrize("kind", STRESSES.values(), ids=STRESSES.keys())
NOTHING = MooneyRivlin(c_1=0.0, c_2=0.0)
POINTS = 12
RANDOM = np.random.default_rng(11)
F = np.eye(3) + 0.15 * RANDOM.standard_normal((POINTS, 3, 3))
DYADS = fibre_dyads(np.tile([0.6, 0.0, 0.8], (POINTS, 1)))
DIRECTION = 0.02 * RANDOM.standard_normal((POINTS, 6))


def six(tensors: np.ndarray) -> np.ndarray:
    return tensors[:, [0, 1, 2, 0, 0, 1], [0, 1, 2, 1, 2, 2]]


def full(vectors: np.ndarray) -> np.ndarray:
    return vectors[:, [[0, 3, 4], [3, 1, 5], [4, 5, 2]]]


CAUCHY = six(np.einsum("mki,mkj->mij", F, F))


def stress(law: Stiffened, C: np.ndarray, dyads: np.ndarray = DYADS) -> np.ndarray:
    S = np.empty_like(C)
    law.stress(C, np.sqrt(np.linalg.det(full(C))), np.ones(len(C)), dyads, S)
    return S


def strained(kind: type[Stress]) -> Stiffened:
    return Stiffened(NOTHING, (kind(),))


@all_stresses
def test_the_slopes_are_derivatives_of_one_energy(kind: type[Stress]) -> None:
    """Arguments cover compression and extension."""
    for x in (-0.3, 0.07, 0.6):
        step = np.array([0.01])
        second = kind().slopes(np.array([x]))[1] * step
        if second.any():
            assert_derivative(lambda y: kind().slopes(y)[0], second, np.array([x]), step)


@all_stresses
def test_the_tangent_is_the_derivative_of_the_stress(kind: type[Stress]) -> None:
    D = np.empty((POINTS, 6, 6))
    strained(kind).tangent(CAUCHY, np.sqrt(np.linalg.det(full(CAUCHY))), np.ones(POINTS), DYADS, D)
    engineering = 0.5 * DIRECTION * np.array([1.0, 1.0, 1.0, 2.0, 2.0, 2.0])
    assert_derivative(
        lambda C: stress(strained(kind), C), np.einsum("mij,mj->mi", D, engineering), CAUCHY, DIRECTION
    )


@all_stresses
def test_turning_the_body_turns_the_stress(kind: type[Stress]) -> None:
    """C is the same in any frame of the observer; turned with its fibres, the stress turns along."""
    Q = np.linalg.qr(np.random.default_rng(2).standard_normal((3, 3)))[0]
    turned = [six(Q @ full(tensors) @ Q.T) for tensors in (CAUCHY, DYADS, stress(strained(kind), CAUCHY))]
    assert stress(strained(kind), *turned[:2]) == pytest.approx(turned[2], abs=1e-9 * abs(turned[2]).max())


@all_stresses
def test_there_is_no_stress_at_rest(kind: type[Stress]) -> None:
    assert abs(stress(strained(kind), np.tile([1.0, 1, 1, 0, 0, 0], (POINTS, 1)))).max() < 1e-9


@all_stresses
def test_a_sphere_feels_the_law_of_the_wall(kind: type[Stress]) -> None:
    """dW/dL = S : dC/dL / 2 of the wall stretched by L in its plane, and its own derivative."""
    stretch = np.array([0.8, 0.95, 1.06, 1.2])
    C, slope = np.zeros((2, 4, 6))
    C[:, :3] = np.stack([stretch**2, stretch**2, stretch**-4], axis=1)
    slope[:, :3] = np.stack([2.0 * stretch, 2.0 * stretch, -4.0 * stretch**-5], axis=1)
    in_plane = six(np.tile(np.diag([1.0, 0.0, 0.0]), (4, 1, 1)))
    work = 0.5 * (stress(strained(kind), C, in_plane) * slope).sum(axis=1)
    assert strained(kind).in_plane_stress(stretch) == pytest.approx(work, rel=1e-9, abs=1e-9)
    step = np.full(4, 0.01)
    stiffness = strained(kind).in_plane_stiffness(stretch) * step
    assert_derivative(strained(kind).in_plane_stress, stiffness, stretch, step)


@all_stresses
def test_the_stiffening_adds_to_the_base_law(kind: type[Stress]) -> None:
    base, stretch = MooneyRivlin(), np.array([0.9, 1.1])
    both, alone = Stiffened(base, (kind(),)), strained(kind)
    assert stress(both, CAUCHY) == pytest.approx(stress(Stiffened(base, ()), CAUCHY) + stress(alone, CAUCHY))
    assert both.in_plane_stress(stretch) == pytest.approx(
        base.in_plane_stress(stretch) + alone.in_plane_stress(stretch)
    )
    assert (both.K, both.eta, both.shear_modulus) == (base.K, base.eta, base.shear_modulus)


def test_a_sphere_refuses_stiffening_of_a_law_with_fibres() -> None:
    with pytest.raises(InputError, match=r"isotropic.*Guccione"):
        require_isotropic(Stiffened(Guccione(), ())).in_plane_stress(np.ones(1))
