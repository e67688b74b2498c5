"""Command on two beats of a heart with a right ventricle, and a condition with a volume only."""

import numpy as np
import pytest

from heartfit import places
from heartfit.cli import main as cli
from heartfit.discovery.sphere_model import earlier, structure
from heartfit.discovery.sphere_model import forward_model as library
from heartfit.io.causes import read_cause
from heartfit.io.curves import write_table_of_curves
from heartfit.places.library import PressureError
from heartfit.places.wall import WallPressure
from heartfit.roles import registered
from heartfit.synthetic.campaign import PlantedPlan
from heartfit.synthetic.case import plant

pytestmark = pytest.mark.usefixtures("coarse_search")
OFFSET = PlantedPlan(11, "single", ("CatheterOffset",), 2.5, reloaded=True)


@pytest.fixture
def arguments(tmp_path, monkeypatch):
    """Arguments of the command; instruments need no simulation, and one place is searched instead of all."""
    few = {name: registered()[name] for name in ("CatheterOffset", "ImageShrinkage")}
    monkeypatch.setattr(library, "registered", lambda: few)
    monkeypatch.setattr(places, "PLACES", (PressureError,))
    rest, raised = (plant(OFFSET).curves[name] for name in ("rest", "legs_raised"))
    volume, pressure = rest["lv_volume"], rest["lv_pressure"]
    times = np.arange(60) * volume.period / 30
    curves = {"lv_volume": volume(times), "rv_volume": 1.1 * volume(times), "lv_pressure": pressure(times)}
    write_table_of_curves(tmp_path / "m.csv", times, curves, volume.period)
    left = {name: curve for name, curve in curves.items() if name.startswith("lv")}
    write_table_of_curves(tmp_path / "left.csv", times, left, volume.period)
    filled = {"lv_volume": raised["lv_volume"](times[:30])}
    write_table_of_curves(tmp_path / "legs.csv", times[:30], filled, volume.period)
    return [
        str(tmp_path / "m.csv"),
        "--condition",
        f"legs={tmp_path / 'legs.csv'}",
        "-o",
        str(tmp_path / "out"),
    ]


def test_the_command_names_the_cause_and_searches_both_ventricles(arguments, tmp_path, capsys):
    assert cli.main(["diagnose", *arguments, "--trust-simulator"]) == 0
    printed, content = capsys.readouterr().out, read_cause(tmp_path / "out" / "cause.json")
    assert printed.count("\n") == 1
    assert not content["unsearched"]
    curves = {departure["curve"] for departure in content["departures"]}
    assert curves == {"lv_volume", "lv_pressure", "rv_volume"}
    assert {(gain["curve"], gain["on"]) for gain in content["gain"]} <= {("lv_volume", "legs")}
    assert "CatheterOffset" in {
        *content["withdrawn"],
        *(mechanism["name"] for mechanism in content["mechanisms"]),
    }


def test_a_mechanism_that_is_left_out_is_not_tried(arguments, tmp_path):
    left, output = str(tmp_path / "left.csv"), arguments[-1]
    options = "--trust-simulator", "--without", "ImageShrinkage"
    assert cli.main(["diagnose", left, *options, "-o", output]) == 0
    assert set(read_cause(tmp_path / "out" / "cause.json")["ranking"]) == {"CatheterOffset", "unknown"}


def test_the_same_recording_within_the_structure_of_other_simulators(arguments, tmp_path, capsys):
    assert cli.main(["diagnose", *arguments]) == 0
    content = read_cause(tmp_path / "out" / "cause.json")
    assert "no missing mechanism" in capsys.readouterr().out.lower()
    assert content["verdict"] in ("none", "model")
    assert set(content["unsearched"]) == {"rv_volume"}


def test_an_unchanged_heart_has_changed_in_nothing_and_no_instrument_is_asked(
    arguments, tmp_path, monkeypatch
):
    monkeypatch.setattr(earlier, "EARLIER_PLACES", (WallPressure,))
    leaking = {name: registered()[name] for name in ("MitralRegurgitation", "CatheterOffset")}
    monkeypatch.setattr(library, "registered", lambda: leaking)
    recording, output = str(tmp_path / "left.csv"), arguments[-1]
    assert cli.main(["diagnose", recording, "--against", recording, "-o", output]) == 0
    content = read_cause(tmp_path / "out" / "cause.json")
    assert content["verdict"] == "none"
    assert set(content["ranking"]) == {"MitralRegurgitation", "unknown"}
    assert content["changes"] == []


def test_controls_tell_the_structure(arguments, tmp_path, monkeypatch):
    """Five controls of the same curves leave the same residual, which is fitted once."""
    residual, fitted = structure.healthy_residual, []

    def fitted_once(control):
        if not fitted:
            fitted.append(residual(control))
        return fitted[0]

    monkeypatch.setattr(structure, "healthy_residual", fitted_once)
    recording, *_, output = arguments
    group = tmp_path / "group"
    group.mkdir()
    for control in range(5):
        (group / f"{control}.csv").write_text((tmp_path / "m.csv").read_text())
    assert cli.main(["diagnose", recording, "--reference", str(group), "-o", output]) == 0
    assert read_cause(tmp_path / "out" / "cause.json")["verdict"] in ("none", "model")
