"""Arrival times against the exact ones of a point source, t = sqrt((x - x0)' D^-1 (x - x0)) / v, on a block."""

import numpy as np
import pytest
from skfem import MeshTet

from heartfit.heart.activation.eikonal import activation_times, slowness_metric

SIDE = 0.02
FIBRE = np.array([2.0, 1.0, 0.5]) / np.linalg.norm([2.0, 1.0, 0.5])


def block(n: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Points, tets and constant fibres of a cube with n elements along a side."""
    grid = MeshTet.init_tensor(*[np.linspace(0.0, SIDE, n + 1)] * 3)
    return grid.p.T.copy(), grid.t.T.astype(np.int64), np.tile(FIBRE, (grid.t.shape[1], 1))


def exact(points: np.ndarray, source: np.ndarray, ratio: float) -> np.ndarray:
    offset = points - source
    along = offset @ FIBRE
    across = (offset**2).sum(axis=1) - along**2
    return np.sqrt(along**2 + np.maximum(across, 0.0) / ratio**2) / 0.6


def mean_error(n: int, ratio: float, ball: float) -> float:
    """Mean error over the largest time, with the exact times given within a ball around the source."""
    points, tets, fibres = block(n)
    truth = exact(points, points[0], ratio)
    near = np.flatnonzero(np.linalg.norm(points - points[0], axis=1) <= ball + 1e-12)
    times = activation_times(points, tets, fibres, {int(i): truth[i] for i in near}, ratio=ratio)
    assert (times >= truth - 1e-9).all()  # the wave never outruns the exact one
    return float(np.abs(times - truth).mean() / truth.max())


@pytest.mark.parametrize("ratio", [1.0, 0.45])
def test_first_order_away_from_the_singular_source(ratio: float) -> None:
    errors = [mean_error(n, ratio, ball=SIDE / 3) for n in (6, 12, 24)]
    assert np.log2(np.array(errors[:-1]) / errors[1:]).min() > 0.95
    assert errors[-1] < 0.005


@pytest.mark.parametrize("ratio", [1.0, 0.45])
def test_a_point_source_converges_more_slowly_but_surely(ratio: float) -> None:
    errors = [mean_error(n, ratio, ball=0.0) for n in (6, 12, 24)]
    orders = np.log2(np.array(errors[:-1]) / errors[1:])  # h log(1/h): below one, and rising
    assert 0.4 < orders[0] < orders[1] < 1.0
    assert errors[-1] < 0.01


def test_along_an_edge_in_fibre_direction_the_time_is_exact() -> None:
    points, tets, fibres = block(4)
    times = activation_times(points, tets, np.tile([1.0, 0.0, 0.0], (len(fibres), 1)), {0: 0.003}, ratio=0.3)
    edge = np.flatnonzero((points[:, 1] == 0.0) & (points[:, 2] == 0.0))
    assert times[edge] == pytest.approx(0.003 + points[edge, 0] / 0.6)


def test_plane_waves_are_exact_in_a_skewed_mesh() -> None:
    points, tets, fibres = block(3)
    metric = slowness_metric(fibres[:1], 0.6, 0.45)[0]
    face = np.flatnonzero(points[:, 2] == 0.0)
    speed = np.sqrt(np.linalg.inv(metric)[2, 2])
    times = activation_times(points, tets, fibres, dict.fromkeys(face.tolist(), 0.0))
    central = np.linalg.norm(points[:, :2] - SIDE / 2, axis=1) < 0.2 * SIDE
    assert times[central] == pytest.approx(points[central, 2] / speed, rel=1e-9, abs=1e-12)


def test_the_fast_layer_carries_the_wave_ahead_along_its_face() -> None:
    points, tets, fibres = block(8)
    on_face = points[:, 2] == 0.0
    tops = tets[:, [[1, 2, 3], [0, 2, 3], [0, 1, 3], [0, 1, 2]]].reshape(-1, 3)
    layer = tops[on_face[tops].all(axis=1)]
    times = activation_times(points, tets, fibres, {0: 0.0}, fast_layer=layer, fast_speed=3.0)
    far = int(np.linalg.norm(points - [SIDE, 0.0, 0.0], axis=1).argmin())
    assert times[far] == pytest.approx(SIDE / 3.0)
    assert (times <= activation_times(points, tets, fibres, {0: 0.0}) + 1e-12).all()


def test_a_late_site_is_reached_by_the_wave_before() -> None:
    points, tets, fibres = block(4)
    alone = activation_times(points, tets, fibres, {0: 0.0})
    assert activation_times(points, tets, fibres, {0: 0.0, 9: 1.0}) == pytest.approx(alone)


def test_missing_sites_bad_speeds_and_islands_are_refused() -> None:
    points, tets, fibres = block(1)
    with pytest.raises(ValueError, match=r"\b0 sites"):
        activation_times(points, tets, fibres, {})
    with pytest.raises(ValueError, match="0 m/s"):
        activation_times(points, tets, fibres, {0: 0.0}, speed=0.0)
    with pytest.raises(ValueError, match=r"\b1 nodes"):
        activation_times(np.vstack([points, [1.0, 1.0, 1.0]]), tets, fibres, {0: 0.0})
