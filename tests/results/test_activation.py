"""Figure of the activation: it prints the times of the mesh and draws the faces towards the viewer."""

from dataclasses import replace

import numpy as np
import pytest
from matplotlib.figure import Figure

from heartfit.geometry.mesh import VentricularMesh
from heartfit.results.activation import ONSETS, nodal_means, plot_activation, segment_means
from heartfit.results.drawing import Viewpoint, cut_surface, draw_bullseye, paint, wall_polygons
from tests.printed import numbers_in

RED = np.array([1.0, 0.0, 0.0])
FRONT = Viewpoint(np.array([1.0, 0.0, 0.0]), np.array([0.0, 1.0, 0.0]), np.zeros(3))
SQUARE = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])


def square(depth: float, normal: float) -> np.ndarray:
    corners = np.column_stack([SQUARE, np.full(4, depth), np.zeros((4, 3)), np.full(4, normal)])
    return np.asarray(corners)


def texts(figure: Figure) -> list[str]:
    return [text.get_text() for text in figure.findobj(lambda artist: hasattr(artist, "get_text"))]


def test_uniform_times_stay_uniform(ventricle: VentricularMesh) -> None:
    at_once = replace(ventricle, activation=np.full(len(ventricle.tets), 0.03))
    assert nodal_means(at_once) == pytest.approx(0.03)
    assert list(segment_means(at_once).values()) == pytest.approx([30.0] * len(np.unique(ventricle.segments)))


def test_near_polygons_are_painted_last_and_those_that_face_away_not_at_all() -> None:
    axes = Figure().subplots()
    near, far, turned = square(2e-3, 1.0), square(1e-3, 1.0), square(3e-3, -1.0)
    far[:, :2] *= 2.0
    paint(axes, FRONT, [near, turned, far], np.array([RED, RED, RED]))
    first, last = (path.vertices for path in axes.collections[0].get_paths())
    assert np.ptp(first[:, 0]) == pytest.approx(2e3)
    assert np.ptp(last[:, 0]) == pytest.approx(1e3)


def test_a_half_lies_behind_its_cut_and_is_closed(ventricle: VentricularMesh) -> None:
    times, normal, origin = nodal_means(ventricle), np.array([0.0, 1.0, 0.0]), ventricle.points.mean(axis=0)
    polygons = cut_surface(ventricle, times, origin, normal)
    assert max(((polygon[:, :3] - origin) @ normal).max() for polygon in polygons) < 1e-12
    assert (
        np.abs(sum(area_vector(polygon[:, :3], polygon[:, 4:7].mean(axis=0)) for polygon in polygons)).max()
        < 1e-12
    )
    assert len(polygons) < len(wall_polygons(ventricle, times))


def area_vector(corners: np.ndarray, outward: np.ndarray) -> np.ndarray:
    vector = np.cross(corners[1:-1] - corners[0], corners[2:] - corners[0]).sum(axis=0) / 2.0
    return np.asarray(vector * np.sign(vector @ outward))


def test_the_bullseye_prints_the_values_that_there_are() -> None:
    figure = Figure()
    draw_bullseye(figure.subplots(), {1: (12.4, RED), 17: (61.0, RED), 0: (5.0, RED)})
    assert {"12", "61"} <= set(texts(figure))
    assert "5" not in texts(figure), "the right free wall is no segment of the left ventricle"


def test_the_anterior_wall_is_on_top_and_the_septum_on_the_left() -> None:
    axes = Figure().subplots()
    draw_bullseye(axes, {segment: (segment, RED) for segment in range(1, 18)})
    places = {text.get_text(): text.get_position() for text in axes.texts}
    assert places["1"][1] > 0.8
    assert places["8"][0] < 0.0 > places["9"][0]
    assert places["14"][0] < 0.0 < places["16"][0]
    assert places["17"] == (0.0, 0.0)


def test_the_title_gives_onset_and_duration(ventricle: VentricularMesh) -> None:
    figure = plot_activation(ventricle, "healthy", "volunteer1")
    total = 1e3 * np.max(np.asarray(ventricle.activation))
    assert ONSETS["healthy"] in figure.get_suptitle()
    assert numbers_in(figure.get_suptitle()) == [round(total)]
    assert ONSETS["lbbb"] in plot_activation(ventricle, "lbbb", "volunteer1").get_suptitle()
    assert f"{segment_means(ventricle)[8]:.0f}" in texts(figure)
