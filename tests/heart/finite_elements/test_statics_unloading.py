"""Loading and unloading are inverse to each other; a missing equilibrium is reported with a reason."""

from collections.abc import Callable

import numpy as np
import pytest

from heartfit.geometry.mesh import VentricularMesh
from heartfit.heart.finite_elements import unloading
from heartfit.heart.finite_elements.body import FiniteElementBody, StepFailed, Tissue
from heartfit.heart.finite_elements.kinematics import push_forward
from heartfit.heart.finite_elements.solver import Elimination
from heartfit.heart.finite_elements.unloading import inflate, unload
from heartfit.heart.muscle.passive import MooneyRivlin
from heartfit.heart.muscle.tissue import Support
from tests.conftest import END_DIASTOLIC_PRESSURE
from tests.heart.conftest import assembled
from tests.shrinking import assert_derivative

SOFT = Tissue(passive=MooneyRivlin(c_1=300.0, c_2=30.0))


def test_inflating_the_unloaded_ventricles_gives_the_measured_ones(
    ventricle: VentricularMesh, coarse_body: FiniteElementBody
) -> None:
    state = inflate(coarse_body, END_DIASTOLIC_PRESSURE)
    away = np.linalg.norm(coarse_body.positions(state.x) - ventricle.points, axis=1)
    assert away.max() < 1e-6
    distances = np.linalg.norm(coarse_body.reference.points - ventricle.points, axis=1)
    assert distances.max() > 2e-3


def test_unloading_empties_both_cavities_and_keeps_the_wall(
    ventricle: VentricularMesh, coarse_body: FiniteElementBody
) -> None:
    rest = coarse_body.rest().x
    loaded = [cavity.volume(ventricle.points) for cavity in coarse_body.cavities]
    assert (coarse_body.volumes(rest) < 0.95 * np.array(loaded)).all()
    assert coarse_body.wall_volume(rest) == pytest.approx(ventricle.wall_volume(), rel=0.02)


def test_inflated_fibres_are_those_that_were_measured(
    ventricle: VentricularMesh, coarse_body: FiniteElementBody
) -> None:
    state = inflate(coarse_body, END_DIASTOLIC_PRESSURE)
    edges = coarse_body.positions(state.x)[coarse_body.tets]
    deformed = np.einsum("eai,eaj->eij", edges, coarse_body.gradients)
    fibres = np.einsum("eij,ej->ei", deformed, np.asarray(coarse_body.reference.fibres))
    fibres /= np.linalg.norm(fibres, axis=1, keepdims=True)
    assert abs((fibres * np.asarray(ventricle.fibres)).sum(axis=1)).min() > 0.999


@pytest.mark.parametrize("c_1", [2.8e3, 12.7e3], ids="c_1={:g}".format)
@pytest.mark.parametrize("K", [2.5e5, 1.29e7], ids="K={:g}".format)
@pytest.mark.parametrize("element", ["p1", "mixed"])
def test_every_prior_and_the_paper_s_bulk_modulus_unload(
    ventricle: VentricularMesh, element: str, K: float, c_1: float
) -> None:
    """c_1 at -3 and +3 prior standard deviations; linear tetrahedra of K = 12.9 MPa lock, and unload all the same."""
    tissue = Tissue(element=element, passive=MooneyRivlin(c_1=c_1, c_2=0.1 * c_1, K=K))
    body = FiniteElementBody(unload(ventricle, tissue, END_DIASTOLIC_PRESSURE), tissue)
    state = inflate(body, END_DIASTOLIC_PRESSURE)
    assert np.linalg.norm(body.positions(state.x) - ventricle.points, axis=1).max() < 2e-4


def test_the_tangent_at_fixed_loaded_positions_is_exact_but_for_the_supports(
    block: Callable[[], VentricularMesh], monkeypatch: pytest.MonkeyPatch
) -> None:
    """Linear tetrahedra in strong shear, without supports, whose stiffness would follow X."""
    loaded = block()
    monkeypatch.setattr(
        Elimination, "factorise", lambda _, elements, nodes, **__: assembled(loaded.tets, elements, nodes)
    )
    tissue = Tissue(element="p1", support=Support(k_b=0.0, k_p=0.0, annulus=1.0))
    search = unloading._ReferenceSearch(loaded, tissue)
    x = np.random.default_rng(5).normal(0.0, 4e-4, loaded.points.shape)
    x[:, 0] += 0.3 * loaded.points[:, 1]
    tangent = unloading._tangent(search._residual(x, np.zeros(2))[0], x)

    def residual(u: np.ndarray) -> np.ndarray:
        return search._residual(u.reshape(x.shape), np.zeros(2))[1]

    direction = 1e-3 * np.random.default_rng(6).standard_normal(x.size)
    assert_derivative(residual, tangent @ direction, x.ravel(), direction)


def test_a_residual_that_overflows_is_infinite(coarse_body: FiniteElementBody) -> None:
    """A stiff wall at a long step throws iterates this far; they end in a failed step, not in a warning."""
    step, x = coarse_body.static_step(coarse_body.rest()), coarse_body.rest().x
    assert step.size(np.full(x.size, 1e200)) == np.inf
    assert step.size(np.zeros(x.size)) == 0.0


def test_without_pressure_unloading_changes_no_node(ventricle: VentricularMesh) -> None:
    assert unload(ventricle, Tissue(), np.zeros(2)).points == pytest.approx(ventricle.points, abs=1e-9)


def test_a_reference_near_by_is_a_start_and_does_not_change_the_reference(
    ventricle: VentricularMesh, coarse_body: FiniteElementBody
) -> None:
    stiffer = Tissue(passive=MooneyRivlin(c_1=8e3, c_2=0.8e3))
    alone = unload(ventricle, stiffer, END_DIASTOLIC_PRESSURE)
    near = unload(ventricle, stiffer, END_DIASTOLIC_PRESSURE, near=coarse_body.reference)
    assert near.points == pytest.approx(alone.points, abs=1e-7)
    assert np.abs(near.points - coarse_body.reference.points).max() > 5e-4


def test_a_start_too_far_away_is_left(ventricle: VentricularMesh) -> None:
    alone = unload(ventricle, Tissue(), END_DIASTOLIC_PRESSURE)
    turned = ventricle.with_points(ventricle.points @ np.diag([-1.0, 1.0, 1.0]))
    assert unload(ventricle, Tissue(), END_DIASTOLIC_PRESSURE, near=turned).points == pytest.approx(
        alone.points
    )


def test_a_wall_too_soft_for_its_pressure_is_named(ventricle: VentricularMesh) -> None:
    with pytest.raises(StepFailed, match=r"too soft for this pressure|collapse"):
        unload(ventricle, SOFT, np.array([20e3, 10e3]))
    with pytest.raises(StepFailed, match=r"too soft for this pressure|collapse"):
        inflate(FiniteElementBody(ventricle, SOFT), np.array([20e3, 10e3]))


def test_inflated_orientations_are_those_that_were_measured(
    ventricle: VentricularMesh, coarse_body: FiniteElementBody
) -> None:
    state = inflate(coarse_body, END_DIASTOLIC_PRESSURE)
    edges = coarse_body.positions(state.x)[coarse_body.tets]
    deformed = np.einsum("eai,eaj->eij", edges, coarse_body.gradients)
    orientation = push_forward(coarse_body.dyads, deformed)
    assert orientation == pytest.approx(np.asarray(ventricle.orientation), abs=2e-3)
    assert abs(coarse_body.dyads - np.asarray(ventricle.orientation)).max() > 0.03
