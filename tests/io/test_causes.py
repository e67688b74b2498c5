"""cause.json: its content, its schema, and one line for an invalid file."""

import json
from dataclasses import fields, replace
from pathlib import Path

import numpy as np
import pytest

from heartfit.core.errors import InputError
from heartfit.discovery.inference.decide import BesideProcess
from heartfit.discovery.sphere_model.cause import Cause, Diagnosis, FittedModel, Gain, Trace, UnnamedCandidate
from heartfit.io.causes import (
    SHARED,
    TraceFile,
    cause_schema,
    read_cause,
    read_diagnosis,
    write_cause,
    write_cause_card,
)
from heartfit.observation.beat import BeatPhases
from heartfit.results.cause_card import markdown_card
from heartfit.results.cause_figure import render_cause
from heartfit.results.misfit_text import misfit_sentences
from tests.printed import numbers_in

SCHEMA = Path(__file__).parents[2] / "config" / "cause.schema.json"
TIMES = np.arange(20) * 0.04
LACKING = -600.0 * np.exp(-(((TIMES - 0.2) / 0.05) ** 2))
TRACE = Trace(
    "lv_pressure",
    TIMES,
    1e4 + LACKING,
    *np.full((2, 20), 1e4),
    np.full(20, 200.0),
    LACKING,
    np.full(20, 90.0),
)
DIAGNOSIS = Diagnosis(
    "named",
    (Cause("MitralRegurgitation", 12.0, 3e-5, "m^2", (2e-5, 4e-5)),),
    (("SlowRelaxation",),),
    "",
    (Gain("lv_pressure", "legs_raised", 900.0, 450.0, 0.5, (0.4, 0.7)),),
    900,
    0.8,
    5.0,
    traces=(TRACE,),
    phases=BeatPhases(np.array([0.0, 0.06, 0.3, 0.36, 0.55, 0.65]), 0.8),
    from_all_samples=(Cause("MitralRegurgitation", 20.0, 3.2e-5, "m^2", (2.5e-5, 4e-5)),),
    warnings=("stroke work 4 J, expected 0.05 to 3.5 J: check the unit and the column",),
)


@pytest.fixture
def path(tmp_path):
    write_cause(tmp_path / "cause.json", DIAGNOSIS, misfit_sentences(DIAGNOSIS), "0123")
    return tmp_path / "cause.json"


def test_the_figure_is_stored_in_numbers_and_in_words(path):
    content = read_cause(path)
    (departure,), (miss, _) = content["departures"], content["misses"]
    assert departure["curve"] == "lv_pressure"
    assert (departure["phase"], departure["size"]) == ("ejection", pytest.approx(-LACKING[2:8].mean()))
    assert {0.22, 0.082, 2.7, 6.0} <= set(numbers_in(miss))
    assert [part for part in ("kPa", " high", "ejection") if part not in miss] == []


def test_every_key_is_required(path):
    content = json.loads(path.read_text())
    required = json.loads(cause_schema())["required"]
    assert required == [
        "verdict", "mechanisms", "alternatives", "next_measurement", "gain", "simulations", "fingerprint",
    ]  # fmt: skip
    for key in required:
        path.write_text(json.dumps({name: value for name, value in content.items() if name != key}))
        with pytest.raises(InputError, match=rf"{key}: .*cause\.json"):
            read_cause(path)


@pytest.mark.parametrize(
    ("old", "new", "expected"),
    [
        ('"named"', '"maybe"', "verdict"),
        ('"amplitude": 3e-05', '"amplitude": "much"', "mechanisms.0.amplitude"),
        ('"simulations": 900', '"simulations": null', "simulations"),
        ("{", "", "Extra data|Expecting"),
    ],
)
def test_a_broken_file_is_reported_in_one_line(path, old, new, expected):
    path.write_text(path.read_text().replace(old, new, 1))
    with pytest.raises(InputError, match=expected) as error:
        read_cause(path)
    assert "\n" not in str(error.value)


def test_the_schema_is_in_step():
    assert SCHEMA.read_text() == cause_schema(), (
        "regenerate: heartfit cause-schema > config/cause.schema.json"
    )


SEARCHED = replace(
    DIAGNOSIS,
    ranking={"SlowRelaxation": np.pi, "MitralRegurgitation": 1 / 3, "unknown": -np.inf},
    withdrawn=("CatheterOffset",),
    unsearched={"rv_volume": "a left ventricle does not explain it"},
    self_test=np.inf,
    tried=(
        FittedModel((), -0.1, 2 / 3, 23),
        FittedModel(("MitralRegurgitation", "SlowRelaxation"), 1e-17, 1.0, 25),
    ),
    samples=97,
    candidate=UnnamedCandidate(DIAGNOSIS.mechanisms, BesideProcess(12.0, -1.4, 0.1, 2.0, 4.0)),
)


@pytest.mark.parametrize("diagnosis", [DIAGNOSIS, SEARCHED])
def test_a_diagnosis_is_read_back_to_the_bit(tmp_path, diagnosis):
    """A refit starts from the stored diagnosis: it has the numbers of the search and the order of its ranking."""
    write_cause_card(tmp_path, render_cause(diagnosis, "heart1"), "0123")
    restored = read_diagnosis(tmp_path)
    arrays = {"traces", "phases"}
    for name in {field.name for field in fields(Diagnosis)} - arrays:
        assert getattr(restored, name) == getattr(diagnosis, name), name
    assert list(restored.ranking) == list(diagnosis.ranking)
    assert np.array_equal(restored.phases.starts, diagnosis.phases.starts)
    assert restored.phases.period == diagnosis.phases.period
    (trace,) = restored.traces
    for name in {field.name for field in fields(Trace)}:
        assert np.array_equal(getattr(trace, name), getattr(diagnosis.traces[0], name)), name
    assert markdown_card(restored, "") == markdown_card(diagnosis, "")


def test_every_field_of_a_diagnosis_is_restored(tmp_path):
    assert {entry.name for entry in fields(Diagnosis)} <= SHARED | {entry.name for entry in fields(TraceFile)}
    write_cause_card(tmp_path, render_cause(DIAGNOSIS, "heart"), "0123")
    restored = read_diagnosis(tmp_path)
    assert restored.from_all_samples == DIAGNOSIS.from_all_samples
    assert restored.warnings == DIAGNOSIS.warnings
    assert DIAGNOSIS.warnings[0] in markdown_card(restored, "heart")
