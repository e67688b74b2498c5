"""A noise model and the sensors, printed and drawn with the numbers they hold."""

from pathlib import Path

import numpy as np
import pytest

from heartfit.io.figures import write_figure
from heartfit.observation.curve import Curve
from heartfit.observation.noise_model import NoiseModel, Share
from heartfit.observation.operator import Pair, Reading
from heartfit.observation.scatter import Scatter
from heartfit.results.noise_model import noise_model_table, plot_noise_model, sensor_table

PHASES = 10
WAVE = np.sin(np.pi * np.arange(PHASES) / PHASES)
LABELS = tuple(f"phase {phase} of {PHASES}" for phase in range(PHASES))
MODEL = NoiseModel(
    {},
    Scatter(("V_min", "q_max"), 24, np.array([0.2, np.log(0.8)]), np.diag([0.05**2, 0.1**2])),
    {
        "lv_volume": Scatter(LABELS, 24, 0.1 * WAVE, np.diag((0.04 * WAVE) ** 2)),
        "rv_volume": Scatter(LABELS, 24, 0.2 * WAVE, np.diag((0.06 * WAVE) ** 2)),
    },
)


def pair(shrinkage: float) -> Pair:
    times = 0.8 / PHASES * np.arange(PHASES)
    readings = [
        Reading(
            {"lv_volume": Curve(times, 120e-6 - stroke * WAVE, 0.8)},
            {"V_min": 120e-6 - stroke, "q_max": 5.0 * stroke},
        )
        for stroke in (60e-6, (1.0 - shrinkage) * 60e-6)
    ]
    return Pair(*readings)


def test_bias_deviation_and_cover_stand_in_percent() -> None:
    shares = dict.fromkeys(("V_min", "q_max", "lv_volume", "rv_volume"), Share.from_count(23, 24))
    table = noise_model_table(MODEL, shares).set_index("observation")
    assert table.loc["V_min", ["bias (%)", "sd (%)"]].tolist() == pytest.approx([20.0, 5.0])
    assert table.loc["q_max", ["bias (%)", "sd (%)"]].tolist() == pytest.approx([-20.0, 10.0])
    assert table.loc["LV volume, phase 5 of 10", ["bias (%)", "sd (%)"]].tolist() == pytest.approx(
        [10.0, 4.0]
    )
    assert table.loc["RV volume, phase 5 of 10", ["bias (%)", "sd (%)"]].tolist() == pytest.approx(
        [20.0, 6.0]
    )
    cover = table.loc["V_min", ["covered (%)", "covered, low (%)", "covered, high (%)"]].tolist()
    assert cover == pytest.approx([95.83, 78.88, 99.89], abs=0.01)
    assert set(table["fresh sequences"]) == {24}


def test_sensors_stand_in_percent_and_milliseconds() -> None:
    names = ("shrinkage", "smoothing", "delay")
    table = sensor_table(
        Scatter(names, 24, np.array([0.15, 0.02, -0.005]), np.diag([0.04, 0.003, 0.004]) ** 2)
    )
    assert table["sensor"].tolist() == ["shrinkage (%)", "smoothing (ms)", "delay (ms)"]
    assert table["mean"].to_numpy() == pytest.approx([15.0, 20.0, -5.0])
    assert table["sd"].to_numpy() == pytest.approx([4.0, 3.0, 4.0])


def test_new_sequences_are_drawn_in_the_intervals_of_the_model(tmp_path: Path) -> None:
    figure = plot_noise_model(MODEL, [pair(0.1), pair(0.2)])
    observations, errors, volume = figure.axes
    bar, reach = observations.patches[0], MODEL.observations.half_width()[0]
    assert bar.get_y() == pytest.approx(100.0 * (0.2 - reach))
    assert bar.get_height() == pytest.approx(200.0 * reach)
    v_min, q_max = (line.get_ydata() for line in observations.get_lines()[:2])
    assert v_min == pytest.approx([100.0 * 0.1 / 0.9, 100.0 * 0.2 / 0.8])
    assert q_max == pytest.approx(100.0 * np.log([0.9, 0.8]))
    lines = {line.get_label(): line.get_ydata() for line in errors.get_lines()}
    assert lines["bias"] == pytest.approx(10.0 * WAVE)
    assert lines["fresh sequences"] == pytest.approx(100.0 * (0.1 / 0.9) * WAVE)
    curves = {line.get_label(): line.get_ydata() for line in volume.get_lines()}
    assert curves["without bias"] == pytest.approx(curves["measured"] - 0.1 * 54.0 * WAVE)
    assert curves["true"].min() == pytest.approx(60.0)
    write_figure(tmp_path / "model.png", figure)
    assert (tmp_path / "model.png").stat().st_size > 20_000
