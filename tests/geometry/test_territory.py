"""Territories on the bull's-eye: the standard's arteries, exact sizes, a remote region spared."""

import numpy as np
import pytest

from heartfit.geometry.territory import territory_weights

LAD, LCX, RCA = {1, 2, 7, 8, 13, 14, 17}, {5, 6, 11, 12, 16}, {3, 4, 9, 10, 15}


@pytest.mark.parametrize(("degrees", "artery"), [(60, LAD), (180, LCX), (300, RCA)])
def test_the_arteries_have_the_segments_of_the_standard(degrees: float, artery: set[int]) -> None:
    weight = territory_weights(np.deg2rad(degrees), len(artery) / 17.0)
    assert set(np.flatnonzero(weight > 0.5)) == artery


@pytest.mark.parametrize("share", [0.0, 0.03, 0.2, 0.5, 0.83, 1.0])
@pytest.mark.parametrize("angle", [-1.0, 0.4, 3.0, 9.0])
def test_a_territory_has_the_declared_size(angle: float, share: float) -> None:
    weight = territory_weights(angle, share)
    assert weight.shape == (18,)
    assert weight[1:].mean() == pytest.approx(share, abs=1e-12)
    assert weight[0] == 0.0
    assert ((weight >= 0.0) & (weight <= 1.0)).all()


def test_a_territory_grows_monotonically_from_its_middle() -> None:
    grown = np.array([territory_weights(3.0, share) for share in np.linspace(0.0, 1.0, 41)])
    assert (np.diff(grown, axis=0) >= -1e-12).all()
    assert grown[8, 12] > grown[8, 9] == 0.0


def test_a_territory_moves_continuously_with_its_middle_and_has_the_period_of_a_turn() -> None:
    around = np.array([territory_weights(angle, 0.3) for angle in np.linspace(0.0, 2.0 * np.pi, 721)])
    assert abs(np.diff(around, axis=0)).max() < 0.04
    assert around[-1] == pytest.approx(around[0], abs=1e-9)
