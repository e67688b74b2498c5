"""What a beat lacks to be periodic, from its start and its end."""

import numpy as np
import pytest

from heartfit.circulation.windkessel import PULMONARY, Windkessel, WindkesselState
from heartfit.limit_cycle import RESPONSES, SURPLUS, Recurrence

VOLUMES = 1e-6 * np.array([[100.0, 80.0], [50.0, 40.0], [101.0, 80.1]])


def recurrence(first: tuple[float, float], last: tuple[float, float]) -> Recurrence:
    return Recurrence(VOLUMES, [WindkesselState(p) for p in first], [WindkesselState(p) for p in last])


def test_the_drift_is_the_largest_of_volumes_over_stroke_and_pressures_over_themselves() -> None:
    assert recurrence((10e3, 2e3), (10e3, 2e3)).drift() == pytest.approx(1.0 / 51.0)
    assert recurrence((10e3, 2e3), (10.1e3, 1.9e3)).drift() == pytest.approx(0.05)


def test_the_first_shift_undoes_the_lack_by_the_response_that_is_guessed() -> None:
    trees, volumes = (Windkessel(), PULMONARY), VOLUMES.copy()
    volumes[-1] = volumes[0]
    beat = Recurrence(
        volumes, *([WindkesselState(p) for p in each] for each in ((10e3, 2e3), (10.1e3, 1.9e3)))
    )
    aorta, artery = beat.shifts(trees, 0.8)
    assert aorta == pytest.approx(100.0 / (1.0 - np.exp(-0.5)) / RESPONSES[0] - 100.0)
    assert artery == pytest.approx(-100.0 / (1.0 - np.exp(-1.6)) / RESPONSES[1] + 100.0)


@pytest.mark.parametrize("feedback", [0.8, 1.0, 1.8, 3.0])
def test_two_beats_show_the_response_and_where_it_leads(feedback: float) -> None:
    """Beats whose lack falls in a straight line, by the feedback: the second shift ends on the line's zero."""
    tree, periodic, decay = Windkessel(), 12e3, 1.0 - np.exp(-0.5)

    def beat(start: float) -> Recurrence:
        end = start + decay * feedback * (periodic - start)
        return Recurrence(VOLUMES[[0, 1, 0], :1], [WindkesselState(start)], [WindkesselState(end)])

    first = beat(9e3)
    second = beat(first.last[0].P_c + first.shifts([tree], 0.8)[0])
    shift = second.shifts([tree], 0.8, first)[0]
    assert second.last[0].P_c + shift == pytest.approx(periodic, abs=1e-6)


def test_a_response_that_cannot_be_is_not_believed() -> None:
    tree = Windkessel()
    beats = [
        Recurrence(VOLUMES[[0, 1, 0], :1], [WindkesselState(start)], [WindkesselState(start + 500.0)])
        for start in (9e3, 10e3)
    ]
    assert beats[1].shifts([tree], 0.8, beats[0]) == pytest.approx(beats[1].shifts([tree], 0.8))


def test_a_ventricle_that_began_fuller_ejected_more_than_it_will() -> None:
    tree, states = Windkessel(), ([WindkesselState(10e3)], [WindkesselState(10.1e3)])
    steady, emptied = VOLUMES[[0, 1, 0], :1], VOLUMES[[0, 1, 0], :1] - [[0.0], [0.0], [10e-6]]
    shifts = [Recurrence(volumes, *states).shifts([tree], 0.8)[0] for volumes in (steady, emptied)]
    held = tree.periodic_start(SURPLUS * 10e-6, 0.8).P_c - tree.P_ve
    assert shifts[0] - shifts[1] == pytest.approx(held / RESPONSES[0])
