"""Filling indices of a volume curve in closed form, of beats, and of the measured heart."""

from dataclasses import replace
from functools import reduce
from operator import add
from pathlib import Path

import numpy as np
import pytest

from heartfit.core.arrays import Floats
from heartfit.core.errors import InputError
from heartfit.discovery.sphere_model.forward_model import NUMERICS
from heartfit.discovery.sphere_model.nominal_heart import ADULT
from heartfit.io.measured_heart import read_measured_heart
from heartfit.io.tables import read_published
from heartfit.mechanisms.mitral_dynamics import MitralDynamics
from heartfit.mechanisms.relaxed_friction import RelaxedFriction
from heartfit.observation.beat import BeatPhases, beat_curves
from heartfit.observation.curve import Curve
from heartfit.observation.filling import volume_indices

PERIOD, SAMPLES = 0.8, 800
TIMES = np.arange(SAMPLES) * PERIOD / SAMPLES
EARLY, ATRIAL = 500e-6, 300e-6
EJECTION = (0.05, 0.30)
EARLY_WAVE = (0.36, 0.42, 0.60)  # opening, peak and end
ATRIAL_WAVE = (0.66, 0.72, 0.78)
BACK, BACK_WAVE = -80e-6, (0.61, 0.63, 0.65)
STEP = PERIOD / SAMPLES


def triangle(wave: tuple[float, float, float], peak: float) -> Floats:
    return np.interp(TIMES, wave, (0.0, peak, 0.0))


def volume_of(mitral: Floats, start: int = 0) -> Curve:
    """Volume of a ventricle that ejects this inflow as a half sine, from sample ``start`` on."""
    share = (TIMES - EJECTION[0]) / (EJECTION[1] - EJECTION[0])
    outflow = np.where((share > 0.0) & (share < 1.0), np.sin(np.pi * share), 0.0)
    aortic = outflow * mitral.sum() / outflow.sum()
    volume = 150e-6 + np.cumsum(mitral - aortic) * STEP
    return Curve(TIMES + start * STEP, np.roll(volume, -start), PERIOD)


def two_waves() -> Floats:
    return triangle(EARLY_WAVE, EARLY) + triangle(ATRIAL_WAVE, ATRIAL)


@pytest.mark.parametrize("start", [0, 150, 420, 640, 790])
def test_waves_times_and_dip_are_those_of_triangles(start: int) -> None:
    volume = volume_of(two_waves() + triangle(BACK_WAVE, BACK), start)
    whole, frames = volume_indices(volume), volume_indices(volume.resampled(40))
    for indices, tolerance in ((whole, 0.02), (frames, 0.25)):
        assert indices["E"] == pytest.approx(EARLY, rel=tolerance)
        assert indices["A"] == pytest.approx(ATRIAL, rel=tolerance)
    assert whole["E/A"] == pytest.approx(EARLY / ATRIAL, rel=0.02)
    assert whole["time of A"] == pytest.approx(ATRIAL_WAVE[1], abs=2 * STEP)
    assert frames["time of E"] == pytest.approx(EARLY_WAVE[1], abs=PERIOD / 40)
    assert whole["dip"] == pytest.approx(0.5 * -BACK * (BACK_WAVE[2] - BACK_WAVE[0]), rel=1e-3)
    assert volume_indices(volume_of(two_waves(), start))["dip"] == pytest.approx(0.0, abs=1e-15)


@pytest.mark.parametrize("wave", [EARLY_WAVE, (0.36, 0.74, 0.78)])
def test_a_beat_without_two_waves_is_refused(wave: tuple[float, float, float]) -> None:
    with pytest.raises(InputError, match="two waves"):
        volume_indices(volume_of(triangle(wave, EARLY)))


def test_valve_dynamics_lower_the_volume_in_diastasis_and_keep_the_phases() -> None:
    """Blood flows back in diastasis: filling still lasts until the atria have contracted."""
    hearts = {"standard": (), "extended": (MitralDynamics(), RelaxedFriction())}
    standard, extended = (
        beat_curves(replace(ADULT, heart=reduce(add, mechanisms, ADULT.heart)).beat(NUMERICS))
        for mechanisms in hearts.values()
    )
    assert volume_indices(standard["lv_volume"])["dip"] == 0.0
    assert volume_indices(extended["lv_volume"])["dip"] > 0.1e-6
    flows = (curves["mitral_flow"] for curves in (standard, extended))
    usual_return, returned = (-np.minimum(flow.values, 0.0).mean() * flow.period for flow in flows)
    assert usual_return < 0.1e-6
    assert returned > 0.5e-6
    starts, usual = (BeatPhases.from_curves(curves).starts for curves in (extended, standard))
    assert np.abs(starts - usual).max() < 0.06


def test_the_measured_volume_has_a_dip(measured_heart_folder: Path) -> None:
    table = read_published(measured_heart_folder / "volumes.csv")
    period = read_measured_heart(measured_heart_folder).period
    indices = volume_indices(Curve.of_volume(table["time_s"], 1e-6 * table["lv_volume_ml"], period))
    assert 3e-6 < indices["dip"] < 6e-6
    assert indices["E"] == pytest.approx(474e-6, rel=0.01)
