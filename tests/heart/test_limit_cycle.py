"""Drift of a beat from its limit cycle, and the shifts of the pressures that reduce it."""

import numpy as np
import pytest

from heartfit.heart.circulation.elements import PULMONARY, Windkessel, WindkesselState
from heartfit.heart.limit_cycle import INITIAL_RESPONSES, SURPLUS_FRACTION, Recurrence

VOLUMES = 1e-6 * np.array([[100.0, 80.0], [50.0, 40.0], [101.0, 80.1]])


def recurrence(first: tuple[float, float], last: tuple[float, float]) -> Recurrence:
    return Recurrence(VOLUMES, [WindkesselState(p) for p in first], [WindkesselState(p) for p in last])


def test_the_drift_is_the_largest_of_volumes_over_stroke_and_pressures_over_themselves() -> None:
    assert recurrence((10e3, 2e3), (10e3, 2e3)).drift() == pytest.approx(1.0 / 51.0)
    assert recurrence((10e3, 2e3), (10.1e3, 1.9e3)).drift() == pytest.approx(0.05)


def test_the_first_shift_removes_the_deficit_by_the_guessed_response() -> None:
    trees, volumes = (Windkessel(), PULMONARY), VOLUMES.copy()
    volumes[-1] = volumes[0]
    beat = Recurrence(
        volumes, *([WindkesselState(p) for p in pressures] for pressures in ((10e3, 2e3), (10.1e3, 1.9e3)))
    )
    aorta, artery = beat.shifts(trees, 0.8)
    assert aorta == pytest.approx(100.0 / (1.0 - np.exp(-0.5)) / INITIAL_RESPONSES[0] - 100.0)
    assert artery == pytest.approx(-100.0 / (1.0 - np.exp(-1.6)) / INITIAL_RESPONSES[1] + 100.0)


@pytest.mark.parametrize("feedback", [0.8, 1.0, 1.8, 3.0])
def test_two_beats_give_the_response_and_its_limit(feedback: float) -> None:
    """The deficit falls linearly with the pressure, by the feedback: the second shift ends on its zero."""
    tree, periodic, decay = Windkessel(), 12e3, 1.0 - np.exp(-0.5)

    def beat(start: float) -> Recurrence:
        end = start + decay * feedback * (periodic - start)
        return Recurrence(VOLUMES[[0, 1, 0], :1], [WindkesselState(start)], [WindkesselState(end)])

    first = beat(9e3)
    second = beat(first.last[0].P_c + first.shifts([tree], 0.8)[0])
    shift = second.shifts([tree], 0.8, second.responses([tree], 0.8, first))[0]
    assert second.last[0].P_c + shift == pytest.approx(periodic, abs=1e-6)


def test_a_response_out_of_range_is_not_used() -> None:
    tree = Windkessel()
    beats = [
        Recurrence(VOLUMES[[0, 1, 0], :1], [WindkesselState(start)], [WindkesselState(start + 500.0)])
        for start in (9e3, 10e3)
    ]
    assert beats[1].responses([tree], 0.8, beats[0]) == list(INITIAL_RESPONSES[:1])


def test_the_surplus_stroke_of_an_initially_fuller_ventricle_is_deducted() -> None:
    tree, states = Windkessel(), ([WindkesselState(10e3)], [WindkesselState(10.1e3)])
    steady, emptied = VOLUMES[[0, 1, 0], :1], VOLUMES[[0, 1, 0], :1] - [[0.0], [0.0], [10e-6]]
    shifts = [Recurrence(volumes, *states).shifts([tree], 0.8)[0] for volumes in (steady, emptied)]
    pressure_rise = tree.periodic_start(SURPLUS_FRACTION * 10e-6, 0.8).P_c - tree.P_ve
    assert shifts[0] - shifts[1] == pytest.approx(pressure_rise / INITIAL_RESPONSES[0])
