"""Hearts of other simulators: read from their bank, measured with a drawn trigger and noise, and of the human range."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from heartfit.core.errors import InputError
from heartfit.discovery.sphere_model.consistency import implausible
from heartfit.discovery.sphere_model.recording import Recording
from heartfit.io.other_worlds import read_other_hearts
from heartfit.roles import registered
from heartfit.synthetic.other_worlds import EXPECTED, UPSTROKE, OtherHeart, measure

BANK = Path(__file__).parents[2] / "resources" / "other_worlds"
WARNED = {"physioblocks": {4003, 4019, 4044}, "regazzoni": {1060}}
"""Seeds of healthy hearts that are warned of, by simulator: an atrial kick between the last and the first frame; 40 %
of a stroke volume that moves while the pressure rises."""
WORLDS = sorted(BANK.glob("*.csv"))


@pytest.fixture(scope="module", params=WORLDS, ids=lambda path: path.stem)
def hearts(request: pytest.FixtureRequest) -> list[OtherHeart]:
    return read_other_hearts(request.param)


def test_a_world_has_healthy_hearts_and_every_illness_in_two_severities(hearts: list[OtherHeart]) -> None:
    kinds = [(heart.illness, heart.severity) for heart in hearts]
    assert kinds.count(("", "")) >= 20
    for illness in EXPECTED.keys() - {""}:
        count = 1 if hearts[0].world == "korakianitis" else 2
        assert [kinds.count((illness, severity)) for severity in ("moderate", "severe")] == [count, count]


def test_every_ill_heart_has_its_healthy_beat_of_the_same_rate(hearts: list[OtherHeart]) -> None:
    healthy = {heart.seed: heart for heart in hearts if not heart.illness}
    ill = {heart.seed: heart for heart in hearts if heart.illness}
    assert len(healthy) + len(ill) == len(hearts)
    assert all(healthy[seed].volume.period == heart.volume.period for seed, heart in ill.items())


def test_what_names_an_illness_is_in_the_library() -> None:
    assert frozenset().union(*EXPECTED.values()) <= set(registered())


def test_healthy_hearts_are_within_the_ranges_of_people(hearts: list[OtherHeart]) -> None:
    for heart in hearts:
        if not heart.illness:
            ejected = np.ptp(heart.volume.values) / heart.volume.values.max()
            assert 0.45 <= ejected <= 0.70
            assert 80e-6 <= heart.volume.values.max() <= 250e-6
            assert 60.0 / 90.0 <= heart.volume.period <= 60.0 / 50.0


def test_a_measured_heart_is_plausible_and_its_upstroke_follows_the_trigger(hearts: list[OtherHeart]) -> None:
    delays, warned = [], set()
    for heart in hearts:
        measured = Recording.from_curves(measure(heart))
        if not heart.illness and implausible(measured):
            warned.add(heart.seed)
        pressure = measured.curves["lv_pressure"]
        delays.append(pressure.times[int(np.argmax(np.diff(pressure.values)))])
    assert warned == WARNED.get(hearts[0].world, set())
    assert np.median(delays) == pytest.approx(UPSTROKE[0], abs=0.012)


def test_a_seed_measures_the_same_and_another_one_differs(hearts: list[OtherHeart]) -> None:
    first, again = measure(hearts[0]), measure(hearts[0])
    other = measure(replace(hearts[0], seed=hearts[0].seed + 5000))
    for name, curve in first.items():
        assert (curve.values == again[name].values).all()
        assert (curve.values != other[name].values).any()


def test_a_cell_that_is_no_number_is_named(tmp_path: Path) -> None:
    path = tmp_path / "bank.csv"
    path.write_text("seed,illness,severity,period_s,volume_ml_0\n1,,,0.8,much\n")
    with pytest.raises(InputError, match="volume_ml_0 in data row 1 is much"):
        read_other_hearts(path)
