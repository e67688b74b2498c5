"""One half of a recording chooses a name, the other one judges it, and both give the size."""

from collections.abc import Mapping
from types import SimpleNamespace
from typing import Any, cast

import numpy as np
import pytest

from heartfit.discovery.sphere_model import diagnose as diagnosis
from heartfit.discovery.sphere_model import searched_recording as module
from heartfit.discovery.sphere_model.diagnose import diagnose
from heartfit.discovery.sphere_model.nominal_heart import ADULT
from heartfit.discovery.sphere_model.recording import Recording, Samples, search_data
from heartfit.discovery.sphere_model.searched_recording import SearchedRecording

PERIOD = 0.8
FRAMES, SAMPLES = np.arange(25) * PERIOD / 25, np.arange(800) * 1e-3


def volume(times: np.ndarray) -> Samples:
    return Samples(times, 100e-6 + 40e-6 * np.cos(2.0 * np.pi * times / PERIOD))


def pressure(times: np.ndarray) -> Samples:
    return Samples(times, 8e3 - 7e3 * np.cos(2.0 * np.pi * (times / PERIOD + 1 / 6)))


BOTH = Recording(
    PERIOD, {"lv_volume": volume(FRAMES), "lv_pressure": pressure(SAMPLES), "rv_volume": volume(FRAMES)}
)


def test_frames_alternate_and_pressure_does_in_blocks_of_50_ms() -> None:
    first, second = BOTH.halves()
    assert second is not None
    assert first.curves["lv_volume"].times == pytest.approx(FRAMES[::2])
    assert second.curves["lv_volume"].times == pytest.approx(FRAMES[1::2])
    assert (np.floor(first.curves["lv_pressure"].times / 0.05) % 2 == 0).all()
    assert (np.floor(second.curves["lv_pressure"].times / 0.05) % 2 == 1).all()
    assert first.curves["rv_volume"].times == pytest.approx(FRAMES), (
        "a curve that is not searched stays whole"
    )
    assert "rv_volume" not in second.curves


def test_beats_alternate_where_there_are_several() -> None:
    times = np.arange(100) * PERIOD / 25
    first, second = Recording(PERIOD, {"lv_volume": volume(times)}).halves()
    assert second is not None
    assert {*np.floor(first.curves["lv_volume"].times / PERIOD).astype(int)} == {0, 2}
    assert {*np.floor(second.curves["lv_volume"].times / PERIOD).astype(int)} == {1, 3}


@pytest.mark.parametrize("frames", [16, 25, 40])
def test_the_halves_share_no_sample_and_make_up_the_recording(frames: int) -> None:
    times = np.arange(frames) * PERIOD / frames
    whole = Recording(PERIOD, {"lv_volume": volume(times), "lv_pressure": pressure(SAMPLES)})
    first, second = whole.halves()
    assert second is not None
    for name, samples in whole.curves.items():
        assert not {*first.curves[name].times} & {*second.curves[name].times}
        merged = first.merged(second).curves[name]
        assert merged.times == pytest.approx(samples.times)
        assert merged.values == pytest.approx(samples.values)


def test_a_short_recording_stays_whole_and_nothing_judges() -> None:
    short = Recording(PERIOD, {"lv_volume": volume(np.arange(14) * PERIOD / 14)})
    assert short.halves() == (short, None)


def searched_by(
    monkeypatch: pytest.MonkeyPatch, conditions: Mapping[str, Recording]
) -> tuple[Recording, Recording | None]:
    """Return the samples that the search sees, and those that it keeps for the judgement."""
    calls: list[tuple[Any, ...]] = []
    stand_in = SimpleNamespace(search=lambda *arguments: calls.append(arguments))
    monkeypatch.setattr(diagnosis, "SearchedRecording", stand_in)
    monkeypatch.setattr(diagnosis, "conclude", lambda *_: None)
    diagnose(BOTH, conditions)
    ((recording, _, _, unseen, *_),) = calls
    return recording, unseen


def test_without_another_condition_the_search_sees_one_half(monkeypatch: pytest.MonkeyPatch) -> None:
    recording, unseen = searched_by(monkeypatch, {})
    assert unseen is not None
    assert recording.curves["lv_volume"].times == pytest.approx(FRAMES[::2])
    assert unseen.curves["lv_volume"].times == pytest.approx(FRAMES[1::2])


def test_with_another_condition_the_search_sees_all_samples(monkeypatch: pytest.MonkeyPatch) -> None:
    recording, unseen = searched_by(monkeypatch, {"legs raised": BOTH})
    assert unseen is None
    assert recording.curves is BOTH.curves


def test_the_final_size_is_that_of_a_fit_to_both_halves(monkeypatch: pytest.MonkeyPatch) -> None:
    """The stand-in of the fit gives the number of samples as the amplitude."""
    first, second = BOTH.halves()
    switch = SimpleNamespace(name="area", unit="m^2", at=lambda x: x)
    explained = SimpleNamespace(fit=SimpleNamespace(x=np.zeros(1)))
    findings = SimpleNamespace(explanation=lambda _: explained, log_bayes_factor=lambda _: 12.0)
    case = SearchedRecording(
        first,
        cast("Any", SimpleNamespace(nominal=ADULT)),
        cast("Any", {"Leak": SimpleNamespace(unknowns=(switch,))}),
        search_data(first),
        cast("Any", findings),
        cast("Any", None),
        second,
    )

    class Fitted:
        def __init__(self, data: Any) -> None:
            self.count = float(data.values.size)

        def explain(self, *_: Any) -> Any:
            return SimpleNamespace(interval=lambda _: (self.count, self.count - 1.0, self.count + 1.0))

    monkeypatch.setattr(module, "FitContext", Fitted)
    monkeypatch.setattr(module, "hypothesis", lambda *_: None)
    (final,) = case.sizes_from_all_samples([("Leak",)])
    assert final.amplitude == search_data(BOTH).values.size == 25 + 80
    assert (final.name, final.ln_bayes_factor) == ("Leak", 12.0)
