"""Python and the command line diagnose alike, and neither trusts the simulator unless told."""

import numpy as np
import pytest

import heartfit as hf
from heartfit.api import diagnosis
from heartfit.cli.main import main
from heartfit.discovery.inference.decide import DEFAULT_RULES, STRICT_RULES
from heartfit.discovery.sphere_model.cause import Cause, Diagnosis
from heartfit.discovery.sphere_model.structure import Structure
from heartfit.places import PLACES
from heartfit.places.wall import WallPressure


@pytest.fixture
def recording():
    return hf.measure(hf.simulate(hf.adult()))


@pytest.fixture
def searches(monkeypatch):
    """Keyword arguments with which the search is called."""
    calls = []

    def search(recording, conditions, **options):
        calls.append(options)
        return Diagnosis("none", (), (), "", (), 0, recording.period, 5.0)

    monkeypatch.setattr(diagnosis.sphere_diagnosis, "diagnose", search)
    return calls


@pytest.fixture
def on_the_command_line(monkeypatch, tmp_path):
    """Diagnose a recording by the command with these options."""
    monkeypatch.setattr("heartfit.results.cause_figure.render_cause", lambda *_: None)
    monkeypatch.setattr("heartfit.io.causes.write_cause_card", lambda *_: None)

    def run(recording, *options):
        hf.write_recording(tmp_path / "m.csv", recording)
        return main(["diagnose", str(tmp_path / "m.csv"), "-o", str(tmp_path / "cause"), *options])

    return run


@pytest.mark.parametrize(
    ("options", "keywords"),
    [
        ([], {}),
        (["--trust-simulator"], {"trust_simulator": True}),
        (["--trust-simulator", "--no-places"], {"trust_simulator": True, "places": ()}),
        (["--strict", "--without", "Pericardium"], {"strict": True, "without": ["Pericardium"]}),
    ],
)
def test_python_and_the_command_line_ask_alike(recording, searches, on_the_command_line, options, keywords):
    hf.diagnose(recording, **keywords)
    assert on_the_command_line(recording, *options) == 0
    python, command = searches
    structures = [one.pop("structure") for one in (python, command)]
    assert python == command
    assert [structure is None for structure in structures] == [bool(keywords.get("trust_simulator"))] * 2


def test_by_default_the_simulator_is_not_trusted_and_no_place_is_searched(recording, searches):
    hf.diagnose(recording)
    (options,) = searches
    assert isinstance(options["structure"], Structure)
    assert options["places"] == ()
    assert options["rules"] is DEFAULT_RULES


def test_places_are_searched_with_or_without_trust(recording, searches):
    hf.diagnose(recording, places=[WallPressure], strict=True)
    hf.diagnose(recording, trust_simulator=True)
    untrusted, trusted = searches
    assert untrusted["places"] == [WallPressure]
    assert untrusted["structure"] is not None
    assert untrusted["rules"] is STRICT_RULES
    assert trusted["places"] == PLACES
    assert trusted["structure"] is None


def test_what_is_no_question_is_refused(recording, searches):
    with pytest.raises(hf.InputError, match="got str; expected a Recording: read it"):
        hf.diagnose("measured.csv")
    with pytest.raises(hf.InputError, match=r"without: mechanism 'Pericardum'.*did you mean Pericardium"):
        hf.diagnose(recording, without=["Pericardum"])
    with pytest.raises(hf.InputError, match="and it is trusted; expected one of both"):
        hf.diagnose(recording, trust_simulator=True, controls={})
    assert searches == []


def test_warnings_about_the_fit_are_printed(recording, monkeypatch, on_the_command_line, capsys):
    warned = Diagnosis("none", (), (), "", (), 0, 0.86, 5.0, warnings=("sigma_0 is far out",))
    monkeypatch.setattr(diagnosis.sphere_diagnosis, "diagnose", lambda *_, **__: warned)
    on_the_command_line(recording)
    assert "m.csv: warning: sigma_0 is far out" in capsys.readouterr().err


def test_a_diagnosis_prints_its_verdict_and_causes():
    cause = Cause("MitralRegurgitation", 34.5, 5.77e-5, "m^2", (4.63e-5, 6.91e-5))
    traces = np.zeros(10_000)
    text = repr(Diagnosis("named", (cause,), (), "", (), 0, 0.86, 5.0, traces=(traces,)))
    assert text == (
        "Diagnosis(named, MitralRegurgitation 5.77e-05 m^2 (4.63e-05 to 6.91e-05), ln Bayes factor 34.5)"
    )
