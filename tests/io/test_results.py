"""Results survive a file, carry their fingerprint, and are never half written."""

from pathlib import Path

import numpy as np
import pytest

from heartfit.calibration.gaussian import Gaussian
from heartfit.calibration.unscented import sigma_points
from heartfit.calibration.update import Posterior, calibrate
from heartfit.core.errors import InputError
from heartfit.heart.beat import Beat, failed_beat
from heartfit.io.beats import read_beat, write_beat
from heartfit.io.files import replacing
from heartfit.io.results import (
    read_case,
    read_fingerprint,
    read_observations,
    read_posterior,
    read_result,
    read_sigma_points,
    write_case,
    write_observations,
    write_posterior,
    write_result,
    write_sigma_points,
)
from heartfit.observation.measurement import Measurement, Observation
from heartfit.results.case import CaseResult

PRIOR = Gaussian.from_relative({"sigma_0": 240e3, "mu": 7e3}, {"sigma_0": 0.2, "mu": 0.3})


def posterior() -> Posterior:
    outcomes = [{"V_min": 1e-4 * float(np.exp(point.z @ [-0.3, 0.1]))} for point in sigma_points(PRIOR)]
    return calibrate(PRIOR, outcomes, {"V_min": outcomes[1]["V_min"]})


def beat() -> Beat:
    time = np.linspace(0, 0.8, 41)
    wave = np.cos(2 * np.pi * time / 0.8)
    return Beat(
        time=time,
        volume={"lv": 120e-6 + 50e-6 * wave, "rv": 110e-6 + 40e-6 * wave},
        pressure={"lv": 8e3 - 7e3 * wave, "left_atrium": 1e3 + 0 * wave},
        flow={"mitral": 1e-4 * wave, "mitral_regurgitation": 1e-5 * wave},
        period=0.8,
        trigger=0.18,
        diagnostics={"drift": 1e-7, "beats": 3.0, "cpu_s": 0.3},  # costs differ between runs
    )


def test_a_posterior_round_trip(tmp_path: Path) -> None:
    write_posterior(tmp_path / "p.json", posterior(), "abc")
    summary = read_result(tmp_path / "p.json")["summary"]
    assert summary["step"] == pytest.approx(dict(zip(posterior().prior.names, posterior().step, strict=True)))
    assert summary["long_steps"] == []
    restored = read_posterior(tmp_path / "p.json")
    assert restored.estimate.physical() == pytest.approx(posterior().estimate.physical(), rel=1e-14)
    assert restored.gain == pytest.approx(posterior().gain, rel=1e-14)
    assert restored.observations == ("V_min",)
    assert restored.observed == pytest.approx(posterior().observed, rel=1e-14)
    assert read_fingerprint(tmp_path / "p.json") == "abc"
    assert read_result(tmp_path / "p.json")["summary"]["estimate"] == posterior().estimate.physical()


def test_sigma_points_round_trip(tmp_path: Path) -> None:
    points = sigma_points(PRIOR)
    write_sigma_points(tmp_path / "p.json", PRIOR, points, "abc")
    prior, restored = read_sigma_points(tmp_path / "p.json")
    assert prior.names == PRIOR.names
    assert [point.label for point in restored] == [point.label for point in points]
    assert restored[3].parameters == points[3].parameters


def test_observations_round_trip(tmp_path: Path) -> None:
    observations = [
        Observation("V_min", 72e-6, "m^3", 1.3e-6, 2e-6),
        Observation("q_max", 4e-4, "m^3/s", 3e-5),
    ]
    measurement = Measurement(observations, np.array([[1.69e-12, -1e-11], [-1e-11, 9e-10]]) / 3.0)
    write_observations(tmp_path / "o.json", measurement, "abc")
    restored = read_observations(tmp_path / "o.json")
    assert restored.observations == observations
    assert np.array_equal(restored.covariance, measurement.covariance)


def test_a_beat_round_trip(tmp_path: Path) -> None:
    write_beat(tmp_path / "3.json", beat(), "abc")
    restored = read_beat(tmp_path / "3.json")
    assert restored.completed
    assert restored.trigger == 0.18
    assert restored.diagnostics == {"drift": 1e-7, "beats": 3.0}
    for group in ("volume", "pressure", "flow"):
        expected = getattr(beat(), group)
        assert getattr(restored, group).keys() == expected.keys()
        for name, values in expected.items():
            assert getattr(restored, group)[name] == pytest.approx(values, rel=1e-10)


def test_a_failed_beat_keeps_its_reason(tmp_path: Path) -> None:
    write_beat(tmp_path / "3.json", failed_beat("element 7 inverted", 0.8, 0.18, {"beats": 1.0}), "abc")
    restored = read_beat(tmp_path / "3.json")
    assert not restored.completed
    assert restored.reason == "element 7 inverted"
    assert restored.time.size == 0


def test_an_interrupted_write_leaves_the_old_file(tmp_path: Path) -> None:
    write_result(tmp_path / "r.json", {"a": 1}, "abc")

    def interrupted() -> None:
        with replacing(tmp_path / "r.json") as draft:
            draft.write_text("half")
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        interrupted()
    assert read_result(tmp_path / "r.json") == {"a": 1}
    assert [path.name for path in tmp_path.iterdir()] == ["r.json"]


@pytest.mark.parametrize("content", ["{", "[1]", '{"content": 1}'])
def test_a_broken_result_is_named(tmp_path: Path, content: str) -> None:
    (tmp_path / "r.json").write_text(content)
    with pytest.raises(InputError, match=r"r\.json: .*run the stage again"):
        read_result(tmp_path / "r.json")


def test_numbers_that_json_cannot_hold_become_null(tmp_path: Path) -> None:
    write_result(tmp_path / "r.json", {"shift": float("nan"), "count": np.int64(3)}, "abc")
    assert read_result(tmp_path / "r.json") == {"shift": None, "count": 3}


def test_a_case_round_trip(tmp_path: Path) -> None:
    numbers = {"sigma_0": 240e3}
    record = CaseResult(
        *("real", "physical", "abc"),
        *({"V_min": value} for value in (72e-6, 1e-6, 80e-6, 73e-6)),
        *(numbers for _ in range(4)),
        units={"sigma_0": "Pa"},
        failed_points=0,
        sigma_points=9,
        shift=float("nan"),
        notes=("long step",),
    )
    write_case(tmp_path / "c.json", record)
    restored = read_case(tmp_path / "c.json")
    assert restored.errors() == record.errors()
    assert np.isnan(restored.shift)
    assert list(restored.notes) == ["long step"]
