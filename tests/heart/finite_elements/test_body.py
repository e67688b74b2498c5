"""The wall's forces: consistent with their tangent, objective, exact under homogeneous deformation."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from heartfit.core.errors import InputError
from heartfit.heart.finite_elements.body import FiniteElementBody, Step, StepFailed, Tissue
from heartfit.heart.muscle.passive import MooneyRivlin
from heartfit.heart.muscle.tissue import Support
from heartfit.heart.time_step import TimeStep
from tests.shrinking import assert_derivative

FREE = Support(k_b=0.0, c_b=0.0, k_p=0.0, annulus=1.0)
DEPOLARISED, PERIOD = 0.19, 0.8
EDGE = 0.04
elements = pytest.mark.parametrize("element", ["p1", "mixed"])
Matrix = Callable[[Step, np.ndarray], np.ndarray]


def contracting(body: FiniteElementBody, seed: int) -> tuple[Step, np.ndarray]:
    """A viscous step with tense fibres between two random states, and the unknowns at its end."""
    rng = np.random.default_rng(seed)
    rest = body.rest()

    def perturb(x: np.ndarray, size: float) -> np.ndarray:
        jump = size * rng.standard_normal(x.shape)
        jump[:, 3:] *= 1e6
        return x + jump

    first = perturb(rest.x, 5e-4)
    relaxed = body.static_step(rest)
    relaxed.forces(first)
    state = relaxed.commit(first)
    k_c = rng.uniform(1e4, 1e5, len(body.tets))
    fibres = np.array([state.fibres[0], k_c, rng.uniform(0.0, 200.0, len(body.tets)), 0.0 * k_c])
    stress = rng.uniform(0.0, 5e3, len(body.tets))
    state = replace(state, fibres=fibres, stress=stress, x_before=perturb(first, 1e-5))
    step = body.step(state, TimeStep(DEPOLARISED, 5e-3, PERIOD, last=4e-3))
    return step, perturb(first, 5e-5)


@elements
@pytest.mark.parametrize("seed", range(1, 4))  # clear of the kink where a fibre stands still
def test_tangent_is_the_symmetric_derivative_of_the_forces(
    block: Callable, tangent_matrix: Matrix, element: str, seed: int
) -> None:
    body = FiniteElementBody(block((2, 2, 2), seed), Tissue(element=element))
    step, x = contracting(body, seed)
    K = tangent_matrix(step, x)
    assert pytest.approx(K.T, abs=1e-11 * abs(K).max()) == K
    direction = 1e-7 * np.random.default_rng(seed).standard_normal(x.shape)
    direction[:, 3:] *= 1e8
    assert_derivative(step.forces, K @ direction.ravel(), x, direction)


@elements
def test_turned_tissue_has_turned_forces(block: Callable, element: str) -> None:
    """Active, passive and viscous forces; after a rigid rotation and shift at rest they vanish."""
    body = FiniteElementBody(block(), Tissue(support=FREE, element=element))
    R, shift = Rotation.from_rotvec([0.4, -0.9, 1.3]).as_matrix(), np.array([0.01, 0.02, -0.03])
    points = body.reference.points

    def turned(x: np.ndarray) -> np.ndarray:
        return np.column_stack([(points + x[:, :3]) @ R.T + shift - points, x[:, 3:]])

    step, x = contracting(body, 4)
    forces, again = step.forces(x).reshape(x.shape), step.forces(turned(x)).reshape(x.shape)
    assert again[:, :3] == pytest.approx(forces[:, :3] @ R.T, abs=1e-9 * abs(forces).max())
    rest = body.rest()
    assert body.static_step(rest).forces(turned(rest.x)) == pytest.approx(0.0, abs=1e-10)


@elements
def test_forces_sum_to_zero(block: Callable, element: str) -> None:
    """Newton's third law: internal forces have neither sum nor moment."""
    body = FiniteElementBody(block(), Tissue(support=FREE, element=element))
    step, x = contracting(body, 5)
    forces = step.forces(x).reshape(x.shape)[:, :3]
    assert forces.sum(axis=0) == pytest.approx(0.0, abs=1e-10 * abs(forces).sum())
    moment = np.cross(body.positions(x), forces).sum(axis=0)
    assert moment == pytest.approx(0.0, abs=1e-10 * abs(forces).sum())


@elements
def test_homogeneous_deformation_is_in_balance_inside(block: Callable, element: str) -> None:
    """The patch test; the faces are loaded, so the block is not simply without forces."""
    tissue = Tissue(support=FREE, element=element, passive=MooneyRivlin(K=1e5))
    body = FiniteElementBody(block(), tissue)
    X, rest = body.reference.points, body.rest()
    F = np.eye(3) + 0.2 * np.random.default_rng(1).standard_normal((3, 3))
    x = np.column_stack([X @ (F - np.eye(3)).T, np.full(len(X), 1e5 * (np.linalg.det(F) - 1.0))])
    x = x[:, : rest.x.shape[1]]
    forces = body.static_step(rest).forces(x).reshape(x.shape)
    inner = np.setdiff1d(np.arange(len(X)), np.concatenate([*body.reference.surfaces.values()]).ravel())
    assert len(inner) == 8
    assert forces[inner, :3] == pytest.approx(0.0, abs=1e-10 * abs(forces).max())
    assert forces[:, 3:] == pytest.approx(0.0, abs=1e-15)
    assert abs(forces[:, :3]).max() > 1e-2
    assert body.wall_volume(x) == pytest.approx(np.linalg.det(F) * body.reference.wall_volume())


@elements
def test_the_faces_carry_the_first_piola_stress(block: Callable, element: str) -> None:
    """The virial of the nodal forces is the volume times dW/dF, here term by term."""
    passive = MooneyRivlin(K=1e5)
    body = FiniteElementBody(block(), Tissue(support=FREE, element=element, passive=passive))
    F = np.eye(3) + 0.2 * np.random.default_rng(8).standard_normal((3, 3))
    C, J, cofactor = F.T @ F, np.linalg.det(F), np.linalg.det(F) * np.linalg.inv(F).T
    I1, I2 = np.trace(C), 0.5 * (np.trace(C) ** 2 - np.trace(C @ C))
    first = 2.0 * passive.c_1 * J ** (-2 / 3) * (F - I1 / 3.0 * cofactor / J)
    second = 2.0 * passive.c_2 * J ** (-4 / 3) * (I1 * F - F @ C - 2.0 * I2 / 3.0 * cofactor / J)
    piola = first + second + 1e5 * (J - 1.0) * cofactor
    X, rest = body.reference.points, body.rest()
    x = np.column_stack([X @ (F - np.eye(3)).T, np.full(len(X), 1e5 * (J - 1.0))])[:, : rest.x.shape[1]]
    forces = body.static_step(rest).forces(x).reshape(x.shape)[:, :3]
    assert forces.T @ X / body.reference.wall_volume() == pytest.approx(piola)


@pytest.mark.parametrize("last", [None, 4e-3], ids=["first", "later"])
def test_dampers_resist_a_steady_motion_with_their_coefficient(block: Callable, last: float | None) -> None:
    """A body with dampers is compared to one without; both drift at constant velocity."""
    velocity, dt = np.array([0.01, -0.02, 0.03]), 5e-3
    forces, mesh = [], block()
    for c_b in (5e3, 0.0):
        body = FiniteElementBody(mesh, Tissue(element="p1", support=replace(FREE, c_b=c_b)))
        before = body.rest().x - velocity * (last or 0.0)
        state = replace(body.rest(), x_before=before)
        step = body.step(state, TimeStep(0.0, dt, PERIOD, last=last))
        forces.append(step.forces(body.rest().x + velocity * dt).reshape(-1, 3))
    area = (mesh.surfaces["base"].size / 6) * (EDGE / 3.0) ** 2
    assert (forces[0] - forces[1]).sum(axis=0) == pytest.approx(5e3 * area * velocity)


def test_volume_gradients_are_the_derivatives_of_the_volumes(block: Callable) -> None:
    body = FiniteElementBody(block(), Tissue())
    rng = np.random.default_rng(2)
    x = 2e-3 * rng.standard_normal(body.rest().x.shape)
    direction = 1e-3 * rng.standard_normal(x.shape)
    assert_derivative(body.volumes, direction.ravel() @ body.volume_gradients(x), x, direction)


def test_a_collapsed_element_fails_the_step(block: Callable) -> None:
    body = FiniteElementBody(block(), Tissue())
    x = body.rest().x
    x[:, 0] = -0.97 * body.reference.points[:, 0]
    with pytest.raises(StepFailed, match=r"collapse.*0\.03\b"):
        body.static_step(body.rest()).forces(x)


def test_a_mesh_without_fibres_is_refused(block: Callable) -> None:
    bare = replace(block(), fibres=None, activation=None)
    with pytest.raises(InputError, match="fibres, activation"):
        FiniteElementBody(bare, Tissue())
