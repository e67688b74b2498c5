"""The benchmark's meshes against closed forms, its pressure against the cavity's volume, its beam against theory."""

import numpy as np
import pytest

from heartfit.geometry.cavity import Cavity
from heartfit.geometry.surface import boundary_faces, euler_characteristic
from verification.equilibrium import Balance, equilibrium, pressure_force
from verification.land import (
    bent_beam,
    contracting_ventricle,
    fibre_direction,
    half_beam,
    inflated_ventricle,
    ventricle,
)


def cut_ellipsoid(r_s: float, r_l: float, z: float = 5.0) -> float:
    """Volume of the part below z of an ellipsoid of revolution."""
    return np.pi * r_s**2 * (z - z**3 / (3.0 * r_l**2) + 2.0 / 3.0 * r_l)


@pytest.mark.parametrize("refined", [1.0, 1.5])
def test_wall_and_cavity_converge_to_those_of_the_ellipsoids(refined):
    inner, outer = cut_ellipsoid(7.0, 17.0), cut_ellipsoid(10.0, 20.0)
    errors = []
    for n in (1, 2):
        mesh = ventricle(8 * n, 4 * n, 2 * n, refined)
        cavity = 1e9 * Cavity.from_endocardium(mesh, "lv_endo").volume(mesh.points)
        errors.append([1.0 - cavity / inner, 1.0 - 1e9 * mesh.wall_volume() / (outer - inner)])
    assert (np.log2(np.array(errors[:-1]) / np.array(errors[1:])) > 1.8).all()


def test_the_ventricle_is_a_ball_whose_shell_is_named():
    mesh = ventricle(8, 4, 2)
    shell = boundary_faces(mesh.tets)
    assert euler_characteristic(shell) == 2
    assert sum(len(mesh.surfaces[name]) for name in ("lv_endo", "epi", "base")) == len(shell)
    assert mesh.points[mesh.surfaces["base"], 2] == pytest.approx(5e-3)
    assert (mesh.element_volumes() > 0.0).all()


def test_fibres_run_along_the_meridian_at_the_surfaces_and_around_at_mid_wall():
    points = np.array([[7e-3, 0.0, 0.0], [8.5e-3, 0.0, 0.0], [10e-3, 0.0, 0.0]])
    along, around = [0.0, 0.0, 1.0], [0.0, 1.0, 0.0]
    fibres = fibre_direction(points, np.array([0.0, 0.5, 1.0]))
    assert fibres == pytest.approx(np.array([along, around, np.negative(along)]), abs=1e-12)
    middle = fibre_direction(np.array([[0.0, -7.75e-3, 0.0]]), np.array([0.25]))
    assert middle == pytest.approx(np.array([[1.0, 0.0, 1.0]]) / np.sqrt(2.0))


def test_the_force_of_a_pressure_is_the_slope_of_the_volume_and_vanishes_on_a_closed_surface():
    mesh = ventricle(4, 2, 1)
    inside = mesh.points[:, 2] < 4.9e-3
    gradient = Cavity.from_endocardium(mesh, "lv_endo").gradient(mesh.points)
    assert pressure_force(mesh.points, mesh.surfaces["lv_endo"])[inside] == pytest.approx(gradient[inside])
    assert pressure_force(mesh.points, boundary_faces(mesh.tets)).sum(axis=0) == pytest.approx(0.0, abs=1e-18)


def test_the_change_removes_the_residual_to_first_order_with_the_pressure_s_own_tangent():
    loading = bent_beam((4, 1, 2))
    balance, rng = Balance(loading, loading.body().elimination), np.random.default_rng(0)
    x = 1e-5 * rng.standard_normal((len(loading.mesh.points), 4))
    x[:, :3][loading.held] = 0.0
    residual = balance.residual(x)
    balance.linearise(x)
    change = balance.change(x, residual)
    for share in (1e-2, 1e-3):
        left = balance.residual(x - share * change) - (1.0 - share) * residual
        assert np.linalg.norm(left) < 0.03 * share * np.linalg.norm(residual)


def test_a_small_load_bends_the_beam_as_in_slender_beam_theory():
    """q L^4 / 8 E I, with the modulus along the fibre of the incompressible law at rest, C (b_f + b_t / 2)."""
    loading = bent_beam((40, 2, 8)).share(1e-3)
    x = equilibrium(loading)
    tip = int(np.argmax(loading.mesh.points.sum(axis=1)))
    deflection = 4e-3 * 1e-3 * 0.01**4 / 8.0 / (2e3 * (8.0 + 1.0) * 1e-12 / 12.0)
    assert x[tip, 2] == pytest.approx(deflection, rel=0.06)


def test_the_pressure_alone_makes_the_ventricle_larger_and_the_tension_smaller():
    loads = [inflated_ventricle((4, 2, 1)), contracting_ventricle((4, 2, 1))]
    for loading, sign in zip(loads, (1.0, -1.0), strict=True):
        cavity = Cavity.from_endocardium(loading.mesh, "lv_endo")
        displaced = loading.mesh.points + equilibrium(loading)[:, :3]
        assert sign * (cavity.volume(displaced) - cavity.volume(loading.mesh.points)) > 0.0


def test_half_of_the_beam_has_half_its_volume():
    assert half_beam(4, 1, 2).wall_volume() == pytest.approx(5e-9)
