"""Errors and filling indices of a heart without and with its named mechanisms, on curves in closed form."""

from dataclasses import replace

import numpy as np
import pytest

from heartfit.discovery.inference.decide import BesideProcess
from heartfit.discovery.sphere_model.cause import Cause, Diagnosis, Gain, Trace, UnnamedCandidate
from heartfit.observation.curve import Curve
from heartfit.results.extension import extension_table, plot_extension, unseen

PERIOD, FRAMES = 0.8, 40
TIMES = np.arange(FRAMES) * PERIOD / FRAMES


def volume(kick: float, dip: float) -> np.ndarray:
    """Ejection to 70 mL, filling to 150 mL, a fall by ``dip`` and a rise by ``kick`` [mL]."""
    corners = np.array([0.0, 0.3, 0.5, 0.62, 0.78, 0.8])
    levels = 1e-6 * np.array(
        [150.0 - dip + kick, 70.0, 150.0, 150.0 - dip, 150.0 - dip + kick, 150.0 - dip + kick]
    )
    return np.interp(TIMES, corners, levels)


@pytest.fixture
def diagnosis() -> Diagnosis:
    measured, none, extended = volume(30.0, 5.0), volume(20.0, 0.0), volume(29.0, 4.0)
    noise = np.full(FRAMES, 1e-6)
    left = Trace("lv_volume", TIMES, measured, none, extended, noise, measured - none, noise)
    gain = (
        Gain("lv_volume", "frames that were not fitted", 4e-6, 1e-6, 0.25, (0.2, 0.3)),
        Gain("circumferential strain", "never fitted", 0.05, 0.04, 0.8, (0.7, 0.9)),
    )
    cause = Cause("MitralDynamics", 20.0, 1.0, "1", (0.5, 1.5))
    return Diagnosis("named", (cause,), (), "", gain, 1, PERIOD, 7.0, traces=(left,))


def test_errors_and_indices_are_those_of_the_curves(diagnosis: Diagnosis) -> None:
    shifted = Curve(TIMES, diagnosis.traces[0].measured + 3e-6, PERIOD)
    table = extension_table(diagnosis, (shifted, shifted)).set_index("quantity")
    assert table.loc["left ventricle, volume error (mL): frames that were not fitted", "with"] == "1.00"
    assert table.loc["circumferential strain, error (%): never fitted", "without"] == "5.00"
    dip = table.loc["fall of the volume in diastasis (mL)"]
    assert (dip["measured"], dip["without"], dip["with"]) == ("5", "0", "4")
    other = table.loc["left ventricle, volume error (mL): the same frames, surface alone"]
    held, trace = unseen(diagnosis.traces[0]), diagnosis.traces[0]
    expected = np.sqrt(np.mean((shifted.values - trace.extended)[held] ** 2))
    assert float(other["with"]) == pytest.approx(1e6 * expected, abs=0.005)


def test_a_volume_without_two_waves_leaves_its_indices_empty(diagnosis: Diagnosis) -> None:
    flat = replace(diagnosis.traces[0], none=100e-6 + 40e-6 * np.cos(2.0 * np.pi * TIMES / PERIOD))
    table = extension_table(replace(diagnosis, traces=(flat,))).set_index("quantity")
    row = table.loc["early filling, peak flow E (mL/s)"]
    assert row["without"] == ""
    assert row["measured"] != ""


def test_the_figure_has_a_row_for_each_ventricle(diagnosis: Diagnosis) -> None:
    right = replace(diagnosis.traces[0], curve="rv_volume")
    figure = plot_extension(replace(diagnosis, traces=(diagnosis.traces[0], right)), "patient1")
    labels = [axes.get_ylabel() for axes in figure.axes]
    assert [label for label in labels if "ventricle" in label] == [
        "left ventricle, volume (mL)",
        "right ventricle, volume (mL)",
    ]
    assert "mitral dynamics" in figure.get_suptitle()
    candidate = UnnamedCandidate(diagnosis.mechanisms, BesideProcess(22.7, -1.4, 1.0, 2.0, 4.0))
    unnamed = replace(diagnosis, verdict="insufficient", mechanisms=(), candidate=candidate)
    assert "mitral dynamics (candidate, not named)" in plot_extension(unnamed, "patient1").get_suptitle()
