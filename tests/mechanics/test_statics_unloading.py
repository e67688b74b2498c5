"""Loading and unloading are inverse to each other, and say why when there is no equilibrium."""

import numpy as np
import pytest
from tests.conftest import END_DIASTOLIC_PRESSURE

from heartfit.geometry.mesh import VentricularMesh
from heartfit.mechanics.body import FiniteElementBody, StepFailed, Tissue
from heartfit.mechanics.passive.mooney_rivlin import MooneyRivlin
from heartfit.mechanics.statics import inflate
from heartfit.mechanics.unloading import unload

SOFT = Tissue(passive=MooneyRivlin(c_1=300.0, c_2=30.0))


def test_inflating_the_unloaded_ventricles_gives_the_measured_ones(
    ventricle: VentricularMesh, coarse_body: FiniteElementBody
) -> None:
    state = inflate(coarse_body, END_DIASTOLIC_PRESSURE)
    away = np.linalg.norm(coarse_body.positions(state.x) - ventricle.points, axis=1)
    assert away.max() < 1e-4
    moved = np.linalg.norm(coarse_body.reference.points - ventricle.points, axis=1)
    assert moved.max() > 2e-3


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


def test_no_pressure_unloads_nothing(ventricle: VentricularMesh) -> None:
    assert unload(ventricle, Tissue(), np.zeros(2)).points == pytest.approx(ventricle.points, abs=1e-9)


def test_a_wall_too_soft_for_its_pressure_is_named(ventricle: VentricularMesh) -> None:
    with pytest.raises(StepFailed, match=r"too soft for this pressure|collapse"):
        unload(ventricle, SOFT, np.array([20e3, 10e3]))
    with pytest.raises(StepFailed, match=r"too soft for this pressure|collapse"):
        inflate(FiniteElementBody(ventricle, SOFT), np.array([20e3, 10e3]))
