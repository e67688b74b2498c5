"""Filling indices of curves in closed form, of beats, and of a volume curve alone."""

from dataclasses import replace

import numpy as np
import pytest

from heartfit.core.arrays import Floats
from heartfit.core.errors import InputError
from heartfit.discovery.sphere_model.forward_model import NUMERICS
from heartfit.discovery.sphere_model.nominal_heart import ADULT
from heartfit.mechanisms.mitral_dynamics import MitralDynamics
from heartfit.mechanisms.relaxed_friction import RelaxedFriction
from heartfit.observation.beat import BeatPhases, beat_curves
from heartfit.observation.curve import Curve
from heartfit.observation.filling import UNITS, filling_indices, volume_indices

PERIOD, SAMPLES = 0.8, 800
TIMES = np.arange(SAMPLES) * PERIOD / SAMPLES
EARLY, ATRIAL = 500e-6, 300e-6
EJECTION = (0.05, 0.30)
EARLY_WAVE = (0.36, 0.42, 0.60)  # opening, peak and end
ATRIAL_WAVE = (0.66, 0.72, 0.78)
BACK, BACK_WAVE = -80e-6, (0.61, 0.63, 0.65)
CLOSING = (0.782, 0.786, 0.79)
STEP = PERIOD / SAMPLES


def triangle(wave: tuple[float, float, float], peak: float) -> Floats:
    return np.interp(TIMES, wave, (0.0, peak, 0.0))


def beat_of(mitral: Floats, start: int = 0) -> dict[str, Curve]:
    """Curves of a ventricle that ejects this inflow as a half sine, from sample ``start`` on."""
    share = (TIMES - EJECTION[0]) / (EJECTION[1] - EJECTION[0])
    outflow = np.where((share > 0.0) & (share < 1.0), np.sin(np.pi * share), 0.0)
    aortic = outflow * mitral.sum() / outflow.sum()
    volume = 150e-6 + np.cumsum(mitral - aortic) * STEP
    turned = {"aortic_flow": aortic, "mitral_flow": mitral, "lv_volume": volume}
    times = TIMES + start * STEP
    return {name: Curve(times, np.roll(values, -start), PERIOD) for name, values in turned.items()}


def two_waves() -> Floats:
    return triangle(EARLY_WAVE, EARLY) + triangle(ATRIAL_WAVE, ATRIAL)


@pytest.mark.parametrize("start", [0, 150, 420, 640, 790])
def test_indices_of_triangles_are_exact(start: int) -> None:
    indices = filling_indices(beat_of(two_waves(), start))
    assert indices["E"] == pytest.approx(EARLY)
    assert indices["A"] == pytest.approx(ATRIAL)
    assert indices["E/A"] == pytest.approx(EARLY / ATRIAL)
    assert indices["time of E"] == pytest.approx(EARLY_WAVE[1])
    assert indices["time of A"] == pytest.approx(ATRIAL_WAVE[1])
    assert indices["deceleration time"] == pytest.approx(EARLY_WAVE[2] - EARLY_WAVE[1], abs=1e-9)
    assert indices["backflow"] == 0.0
    assert set(indices) == set(UNITS)


def test_isovolumic_times_lie_between_the_crossings_of_the_valves() -> None:
    """A valve counts as open above 2 % of its peak flow: a triangle reaches this at 2 % of its flank."""
    indices = filling_indices(beat_of(two_waves()))
    tail = (EJECTION[1] - EJECTION[0]) * np.arcsin(0.02) / np.pi
    opening = EARLY_WAVE[0] + 0.02 * (EARLY_WAVE[1] - EARLY_WAVE[0])
    end = ATRIAL_WAVE[2] - 0.02 * EARLY / ATRIAL * (ATRIAL_WAVE[2] - ATRIAL_WAVE[1])
    assert indices["isovolumic relaxation"] == pytest.approx(opening - (EJECTION[1] - tail), abs=0.1 * STEP)
    assert indices["isovolumic contraction"] == pytest.approx(
        EJECTION[0] + tail + PERIOD - end, abs=0.1 * STEP
    )


def test_blood_that_flows_back_makes_the_dip_and_the_backflow() -> None:
    mitral = two_waves() + triangle(BACK_WAVE, BACK) + triangle(CLOSING, BACK)
    indices = filling_indices(beat_of(mitral))
    lost = 0.5 * -BACK * (BACK_WAVE[2] - BACK_WAVE[0])
    assert indices["backflow"] == pytest.approx(0.5 * -BACK * (CLOSING[2] - CLOSING[0]))
    assert indices["dip"] == pytest.approx(lost)
    assert filling_indices(beat_of(two_waves()))["dip"] == 0.0


def test_an_exponential_deceleration_is_extrapolated_over_its_upper_half() -> None:
    """E exp(-t/tau) passes 0.8 E at tau ln 1.25 and 0.5 E at tau ln 2."""
    tau = 0.08
    since = TIMES - EARLY_WAVE[1]
    early = np.where(since < 0.0, triangle(EARLY_WAVE, EARLY), EARLY * np.exp(-since / tau))
    curves = beat_of(np.where(ATRIAL_WAVE[0] > TIMES, early, 0.0) + triangle(ATRIAL_WAVE, ATRIAL))
    expected = tau * (np.log(1.25) + 0.8 * (np.log(2.0) - np.log(1.25)) / 0.3)
    assert filling_indices(curves)["deceleration time"] == pytest.approx(expected, rel=1e-3)


def test_a_beat_without_two_waves_is_refused() -> None:
    with pytest.raises(InputError, match="two waves"):
        filling_indices(beat_of(triangle(EARLY_WAVE, EARLY)))
    with pytest.raises(InputError, match="two waves"):
        filling_indices(beat_of(triangle((0.36, 0.74, 0.78), EARLY)))
    with pytest.raises(InputError, match=r"0\.70 E only"):
        filling_indices(
            beat_of(np.maximum(two_waves(), 0.7 * EARLY * ((TIMES > 0.4) & (TIMES < 0.7))) * (TIMES > 0.36)
                    + triangle(ATRIAL_WAVE, ATRIAL))
        )  # fmt: skip
    with pytest.raises(InputError, match="never opens"):
        filling_indices(beat_of(np.full(SAMPLES, EARLY)))
    with pytest.raises(ValueError, match="no curve mitral_flow"):
        filling_indices(
            {name: curve for name, curve in beat_of(two_waves()).items() if name != "mitral_flow"}
        )


def test_a_volume_alone_gives_waves_times_and_dip() -> None:
    mitral = two_waves() + triangle(BACK_WAVE, BACK)
    volume = beat_of(mitral)["lv_volume"]
    whole, frames = volume_indices(volume), volume_indices(volume.resampled(40))
    step = PERIOD / 40
    for indices, tolerance in ((whole, 0.02), (frames, 0.25)):
        assert indices["E"] == pytest.approx(EARLY, rel=tolerance)
        assert indices["A"] == pytest.approx(ATRIAL, rel=tolerance)
    assert frames["time of E"] == pytest.approx(EARLY_WAVE[1], abs=step)
    assert frames["time of A"] == pytest.approx(ATRIAL_WAVE[1], abs=step)
    assert whole["dip"] == pytest.approx(0.5 * -BACK * (BACK_WAVE[2] - BACK_WAVE[0]), rel=1e-3)
    assert not set(whole) & {"deceleration time", "backflow"}


def test_valve_dynamics_lower_the_volume_in_diastasis_and_keep_the_phases() -> None:
    """Blood flows back in diastasis: filling still lasts until the atria have contracted."""
    curves = {}
    for name, mechanisms in (("standard", ()), ("extended", (MitralDynamics(), RelaxedFriction()))):
        heart = ADULT.heart
        for mechanism in mechanisms:
            heart = heart + mechanism
        curves[name] = beat_curves(replace(ADULT, heart=heart).beat(NUMERICS))
    standard, extended = (filling_indices(curves[name]) for name in curves)
    assert standard["dip"] == 0.0
    assert standard["backflow"] < 0.01e-6
    assert extended["dip"] > 0.1e-6
    assert extended["backflow"] > 0.5e-6
    starts, usual = (BeatPhases.from_curves(curves[name]).starts for name in ("extended", "standard"))
    assert np.abs(starts - usual).max() < 0.06
