"""Parametric ventricles have the requested sizes."""

import numpy as np
import pytest

from heartfit.core.errors import InputError
from heartfit.geometry.carry import nearest_on_surface
from heartfit.geometry.cavity import Cavity
from heartfit.geometry.parametric import ParametricVentricles
from heartfit.geometry.surface import LabelledSurface

HUMAN = {
    "edv": 150e-6,
    "wall_thickness": 9e-3,
    "sphericity": 1.8,
    "rv_edv": 150e-6,
    "rv_wall_thickness": 3.5e-3,
}


def distance_to_epi(surface: LabelledSurface, points: np.ndarray) -> np.ndarray:
    triangles = surface.surfaces["epi"]
    nearest, weights = nearest_on_surface(points, surface.points, triangles)
    foot = np.einsum("qc,qcd->qd", weights, surface.points[triangles[nearest]])
    return np.linalg.norm(foot - points, axis=1)


@pytest.mark.parametrize("seed", range(4))
def test_cavities_and_walls_have_the_requested_sizes(seed: int) -> None:
    rng = np.random.default_rng(seed)
    shape = ParametricVentricles(
        edv=rng.uniform(120e-6, 180e-6),
        wall_thickness=rng.uniform(8e-3, 10e-3),
        sphericity=rng.uniform(1.5, 2.0),
        rv_edv=rng.uniform(120e-6, 180e-6),
        rv_wall_thickness=rng.uniform(3e-3, 4e-3),
    )
    surface = shape.surface()
    assert Cavity.from_endocardium(surface, "lv_endo").volume(surface.points) == pytest.approx(
        shape.edv, rel=0.01
    )
    assert Cavity.from_endocardium(surface, "rv_endo").volume(surface.points) == pytest.approx(
        shape.rv_edv, rel=1e-3
    )
    left, right = (surface.points[np.unique(surface.surfaces[name])] for name in ("lv_endo", "rv_endo"))
    away_from_right = left[left[:, 0] < 0.0]
    assert distance_to_epi(surface, away_from_right).mean() == pytest.approx(shape.wall_thickness, rel=0.05)
    outermost = right[right[:, 0] > np.quantile(right[:, 0], 0.7)]
    assert distance_to_epi(surface, outermost).mean() == pytest.approx(shape.rv_wall_thickness, rel=0.15)
    length, radius = -left[:, 2].min(), np.hypot(left[:, 0], left[:, 1]).max()
    assert length / (2.0 * radius) == pytest.approx(shape.sphericity, rel=0.01)


@pytest.mark.parametrize(
    ("name", "value"),
    [
        ("edv", 150.0),
        ("wall_thickness", 9.0),
        ("sphericity", 0.1),
        ("rv_edv", float("nan")),
        ("rv_wall_thickness", -1),
    ],
)
def test_a_size_in_another_unit_is_refused_by_name(name: str, value: float) -> None:
    with pytest.raises(InputError, match=name):
        ParametricVentricles(**(HUMAN | {name: value}))


def test_a_right_ventricle_that_does_not_fit_is_refused() -> None:
    with pytest.raises(InputError, match="rv_"):
        ParametricVentricles(**(HUMAN | {"edv": 20e-6, "rv_edv": 600e-6})).surface()


def test_node_numbers_do_not_depend_on_the_shape() -> None:
    """Nodes have the same numbers at the same places in all hearts, such as the apex."""
    small, large = (ParametricVentricles(**(HUMAN | {"edv": edv})).surface() for edv in (90e-6, 260e-6))
    assert np.array_equal(small.triangles, large.triangles)
    assert small.labels.tolist() == large.labels.tolist()
    for name in ("lv_endo", "epi"):
        nodes = np.unique(small.surfaces[name])
        depth = [heart.points[nodes, 2].argmin() for heart in (small, large)]
        assert depth[0] == depth[1]
