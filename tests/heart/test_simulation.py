"""Beat of two spheres: periodic, conserving, physiological, convergent, with stated failures."""

from dataclasses import replace

import numpy as np
import pytest

from heartfit.heart.beat import Beat
from heartfit.heart.circulation.coupling import Tolerances
from heartfit.heart.circulation.state import HeartState
from heartfit.heart.heart import Heart
from heartfit.heart.simulation import RESPONSES, Numerics, simulate
from heartfit.heart.sphere.body import Sphere, SphericalBody

NUMERICS = Numerics(max_beats=12)
KILO, MILLILITRE = 1e3, 1e-6


@pytest.fixture(scope="module")
def beat(spherical_heart: Heart, spheres: SphericalBody) -> Beat:
    return simulate(spherical_heart, spheres, NUMERICS)


def per_beat(beat: Beat, flow: str) -> float:
    """Volume through a branch in the beat: flows are those at the end of the steps."""
    return float(beat.flow[flow][1:].sum() * (beat.time[1] - beat.time[0]))


def test_the_limit_cycle_is_reached_and_stated(beat: Beat) -> None:
    assert (beat.status, beat.reason, beat.completed) == ("completed", "", True)
    assert beat.diagnostics["drift"] < NUMERICS.drift
    assert 1 < beat.diagnostics["beats"] < NUMERICS.max_beats
    for side in ("lv", "rv"):
        curve = beat.volume[side]
        assert abs(curve[-1] - curve[0]) < NUMERICS.drift * np.ptp(curve)


def test_a_run_from_its_own_limit_cycle_takes_one_beat(
    spherical_heart: Heart, spheres: SphericalBody
) -> None:
    ends: list[HeartState] = []
    first = simulate(spherical_heart, spheres, NUMERICS, watch=ends.extend)
    again = simulate(spherical_heart, spheres, NUMERICS, start=ends[-1])
    assert again.diagnostics["beats"] == 1
    assert again.diagnostics["drift"] < first.diagnostics["drift"]
    assert again.volume["lv"] == pytest.approx(
        first.volume["lv"], abs=NUMERICS.drift * np.ptp(first.volume["lv"])
    )


def test_a_wrong_guess_of_the_responses_costs_a_beat_and_measured_ones_save_it(
    beat: Beat, spherical_heart: Heart, spheres: SphericalBody
) -> None:
    guessed = simulate(spherical_heart, spheres, NUMERICS, responses=(2.5, 2.5))
    measured = [guessed.diagnostics[name] for name in RESPONSES]
    informed = simulate(spherical_heart, spheres, NUMERICS, responses=measured)
    assert informed.diagnostics["beats"] < guessed.diagnostics["beats"]
    assert measured == pytest.approx([beat.diagnostics[name] for name in RESPONSES], rel=0.1)


def test_inflow_equals_outflow(beat: Beat) -> None:
    """The net flow through a ventricle is its change of volume over the beat."""
    strokes = {name: per_beat(beat, name) for name in beat.flow}
    for inlet, outlet, side in (("mitral", "aortic", "lv"), ("tricuspid", "pulmonary", "rv")):
        gained = beat.volume[side][-1] - beat.volume[side][0]
        assert strokes[inlet] - strokes[outlet] == pytest.approx(gained, abs=0.02 * MILLILITRE)
        assert strokes[outlet] > 30 * MILLILITRE


def test_isovolumic_phases_keep_the_volume(beat: Beat) -> None:
    valves = {"lv": ("mitral", "aortic"), "rv": ("tricuspid", "pulmonary")}
    for side, (inlet, outlet) in valves.items():
        closed = (beat.flow[inlet] <= 0.0) & (beat.flow[outlet] <= 0.0)
        both = closed[1:] & closed[:-1]
        assert both.sum() >= 6
        assert abs(np.diff(beat.volume[side])[both]).sum() < 0.1 * MILLILITRE


def test_pressures_are_those_of_a_human(beat: Beat) -> None:
    systolic = {name: curve.max() / KILO for name, curve in beat.pressure.items()}
    assert 10.0 < systolic["lv"] < 20.0
    assert 2.0 < systolic["rv"] < 6.0
    assert 7.0 < beat.pressure["aorta"].min() / KILO < systolic["aorta"] <= systolic["lv"] + 0.1
    assert 0.0 < beat.pressure["lv"].min() / KILO < 1.0
    assert 0.4 < np.ptp(beat.volume["lv"]) / beat.volume["lv"].max() < 0.8


@pytest.mark.parametrize(("second_order", "order"), [(False, 0.9), (True, 1.8)])
def test_the_beat_converges_with_the_time_step(
    spherical_heart: Heart, spheres: SphericalBody, second_order: bool, order: float
) -> None:
    """Observed order of the smallest volume and of the last arterial pressure of the first beat.

    The valves open between time levels, so that single ratios scatter about the order; the slope over all of them
    is asserted.
    """
    steps = [spherical_heart.period / n for n in (100, 200, 400, 800)]
    tight = Tolerances(force=1e-6, volume=1e-13, pressure=1e-5, iterations=50)
    schemes = [Numerics(dt, second_order, max_beats=1, tolerances=tight) for dt in steps]
    beats = [simulate(spherical_heart, spheres, scheme) for scheme in schemes]
    for values in (
        [beat.volume["lv"].min() for beat in beats],
        [beat.pressure["aorta"][-1] for beat in beats],
    ):
        assert np.polyfit(np.log(steps[1:]), np.log(abs(np.diff(values))), 1)[0] > order


def test_a_failing_heart_reports_time_and_reason(spherical_heart: Heart, spheres: SphericalBody) -> None:
    hopeless = Numerics(cuts=1, tolerances=Tolerances(iterations=1))
    beat = simulate(spherical_heart, spheres, hopeless)
    assert (beat.status, beat.completed) == ("failed", False)
    assert beat.reason.startswith("beat 1: at 0.")
    assert "1 iterations" in beat.reason
    assert beat.time.size == 0
    assert beat.diagnostics["beats"] == 0.0


def test_a_heart_that_cannot_be_filled_fails(spherical_heart: Heart) -> None:
    balloon = spherical_heart.with_parameters({"c_1": 5.0, "c_2": 0.0})
    body = SphericalBody(
        Sphere.from_volumes(80e-6, 130e-6), Sphere.from_volumes(90e-6, 45e-6), balloon.tissue
    )
    beat = simulate(balloon, body)
    assert beat.status == "failed"
    assert "stretched to" in beat.reason or "too soft" in beat.reason


def test_cut_steps_recover_the_beat(beat: Beat, spherical_heart: Heart, spheres: SphericalBody) -> None:
    strict = replace(NUMERICS, tolerances=Tolerances(iterations=3))
    cut = simulate(spherical_heart, spheres, strict)
    assert cut.diagnostics["step_cuts"] > 0
    assert cut.volume["lv"] == pytest.approx(beat.volume["lv"], abs=0.1 * MILLILITRE)


def test_progress_rises_to_one(spherical_heart: Heart, spheres: SphericalBody) -> None:
    fractions: list[float] = []
    simulate(spherical_heart, spheres, Numerics(time_step=0.01, max_beats=2, drift=0.0), fractions.append)
    assert (np.diff(fractions) > 0.0).all()
    assert fractions[0] > 0.0
    assert fractions[-1] == pytest.approx(1.0)
