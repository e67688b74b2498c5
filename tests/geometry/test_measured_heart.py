"""The measured heart: its volumes as published, and a coarse mesh carried through all of its phases."""

from pathlib import Path

import numpy as np
import pytest

from heartfit.geometry.carry import carry_mesh, count_inverted_elements
from heartfit.geometry.cavity import Cavity
from heartfit.geometry.mesh import VentricularMesh
from heartfit.geometry.mesher import fill_wall
from heartfit.geometry.segments import aha_segments
from heartfit.io.measured_heart import MeasuredHeart, read_measured_heart

MILLILITRE = 1e-6
CAVITIES = ("lv_endo", "rv_endo")


@pytest.fixture(scope="module")
def heart(measured_heart_folder: Path) -> MeasuredHeart:
    return read_measured_heart(measured_heart_folder)


@pytest.fixture(scope="module")
def mesh(heart: MeasuredHeart) -> VentricularMesh:
    return fill_wall(heart.surface, edge_length=0.018, tolerance=0.0005)


@pytest.fixture(scope="module")
def published(measured_heart_folder: Path) -> np.ndarray:
    """Time in s, left and right volume in m^3 of every phase."""
    table = np.loadtxt(measured_heart_folder / "volumes.csv", delimiter=",", skiprows=1)
    return table[:, 1:4] * [1.0, MILLILITRE, MILLILITRE]


def test_the_left_ventricle_has_the_published_mass(
    mesh: VentricularMesh, measured_heart_folder: Path
) -> None:
    """Mass at 1.05 g/mL. The published mass ends at the fit's own strip along the right ventricle's insertion; ours at
    a harmonic field further out, 4 to 6 % more; 4 % is the fit's own scatter over the beat.
    """
    published = np.loadtxt(measured_heart_folder / "volumes.csv", delimiter=",", skiprows=1)[0, 4]
    left = mesh.element_volumes()[aha_segments(mesh) > 0].sum()
    assert 1.05 * left / MILLILITRE == pytest.approx(published, rel=0.07)


def test_the_surfaces_enclose_the_published_volumes(heart: MeasuredHeart, published: np.ndarray) -> None:
    cavities = [Cavity.from_endocardium(heart.surface, name) for name in CAVITIES]
    volumes = [[cavity.volume(phase) for cavity in cavities] for phase in heart.positions]
    assert np.array(volumes) == pytest.approx(published[:, 1:], abs=0.02 * MILLILITRE)
    assert heart.times == pytest.approx(published[:, 0], abs=1e-5)
    assert heart.period == pytest.approx(0.829, abs=5e-4)
    assert heart.surface.volume() == pytest.approx(177.93 * MILLILITRE, rel=1e-4)


def test_the_carried_mesh_keeps_the_published_volumes(
    heart: MeasuredHeart, mesh: VentricularMesh, published: np.ndarray
) -> None:
    motion = carry_mesh(mesh, heart.surface, heart.positions, heart.times, heart.period)
    for column, name in enumerate(CAVITIES, start=1):
        cavity = Cavity.from_endocardium(mesh, name)
        volumes = [cavity.volume(phase) for phase in motion.positions]
        assert volumes == pytest.approx(published[:, column], rel=0.015)
    assert mesh.wall_volume() == pytest.approx(heart.surface.volume(), rel=0.02)
    assert count_inverted_elements(mesh, motion).max() <= 5
