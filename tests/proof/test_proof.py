"""A leak that a sphere hides is refitted, sized and gains on what was not fitted; what helps nowhere is withdrawn."""

from collections.abc import Mapping
from dataclasses import replace

import numpy as np
import pytest

from heartfit.beat import Beat, failed_beat
from heartfit.calibration.unscented import CalibrationError, SigmaPoint
from heartfit.configuration.setting import Setting
from heartfit.mechanics.sphere import Sphere
from heartfit.observation.beat import beat_curves
from heartfit.observation.curve import Curve
from heartfit.observation.noise_model import NoiseModel
from heartfit.observation.scatter import Scatter
from heartfit.proof.extension import Extension
from heartfit.proof.noise import Around, covariance, held_fixed
from heartfit.proof.refit import Refit, Target, refit
from heartfit.proof.split import BIN, BLOCK, Split, binned
from heartfit.proof.target import MeasuredCase
from heartfit.proof.verdict import sized
from heartfit.simulation import Numerics
from heartfit.sphere.simulation import simulate_spheres

PERIOD = 0.8
SPHERE = Sphere.of(110e-6, 200e-6)
PLAIN = Setting.model_validate(
    {"element": "sphere", "estimate": ("sigma_0", "R_p"), "prior": {"sigma_0": {"mean": 150e3}}}
).with_prior({})
AREA = 0.4e-4


def run(extension: Extension, parameters: Mapping[str, float]) -> Beat:
    heart = extension.setting.base_heart(PERIOD).with_parameters(parameters)
    return simulate_spheres(heart, [SPHERE], Numerics(time_step=5e-3, max_beats=8, drift=1e-3))


def shown(area: float, contractility: float = 160e3) -> dict[str, Curve]:
    leaking = Extension.by(PLAIN, "MitralRegurgitation")
    values = {"sigma_0": contractility, "R_p": 1.1e8, "MitralRegurgitation.area": area}
    return beat_curves(run(leaking, leaking.parameters(leaking.start(0.0)) | values))


@pytest.fixture(scope="module")
def case() -> MeasuredCase:
    rng, curves = np.random.default_rng(7), shown(AREA)
    volume, pressure = curves["lv_volume"].resampled(25), curves["lv_pressure"].resampled(200)
    noisy = {
        "lv_volume": replace(volume, values=volume.values + 0.5e-6 * rng.standard_normal(25)),
        "lv_pressure": replace(pressure, values=pressure.values + 100.0 * rng.standard_normal(200)),
    }
    return MeasuredCase.of(noisy, [])


def target(case: MeasuredCase) -> Target:
    return Target(case.split.fitted, covariance(case.split.fitted, case.raw, []))


@pytest.fixture(scope="module")
def refits(case: MeasuredCase) -> tuple[Refit, Refit]:
    none, extended = Extension(PLAIN), Extension.by(PLAIN, "MitralRegurgitation")
    return refit(none, run, target(case), 5), refit(extended, run, target(case), 5)


def test_no_sample_is_fitted_and_held_out_at_once(case: MeasuredCase) -> None:
    split = case.split
    for name, samples in split.fitted.items():
        assert not set(samples.times) & set(split.held[name].times)
    assert len(split.fitted["lv_volume"].times) == 13
    first = split.fitted["lv_pressure"].times
    assert np.diff(first)[BLOCK - 1] == pytest.approx((BLOCK + 1) * BIN, abs=3e-3), "then a block is left out"


def test_the_right_ventricle_is_never_fitted(case: MeasuredCase) -> None:
    split = Split.of({**case.curves, "rv_volume": case.curves["lv_volume"]})
    assert "rv_volume" not in split.fitted
    assert split.held["rv_volume"].times.size == 25


def test_bins_are_means_and_few_samples_keep_their_number() -> None:
    times = np.arange(200) * 0.004
    means = binned(Curve(times, times, 0.8))
    assert means.times == pytest.approx(means.values)
    assert np.diff(means.times).max() < 0.013
    assert binned(Curve(times[::10], times[::10], 0.8)).times.size == 20


def test_the_noise_of_images_is_that_of_their_phases(case: MeasuredCase) -> None:
    sd = np.linspace(0.0, 0.02, 25)
    scatter = Scatter(tuple(map(str, range(25))), 20, np.zeros(25), np.diag(sd**2))
    fitted = {"lv_volume": case.split.fitted["lv_volume"]}
    total = covariance(fitted, case.raw, [NoiseModel({}, scatter, scatter)])
    rough = covariance(
        fitted, case.raw, [NoiseModel({}, scatter, replace(scatter, covariance=np.zeros((25, 25))))]
    )
    stroke = np.ptp(case.raw["lv_volume"].values)
    assert np.diag(total - rough) == pytest.approx(1.05 * (stroke * sd[::2]) ** 2)
    assert np.linalg.eigvalsh(rough).min() > 0.0


def test_what_is_held_fixed_is_noise_along_its_slope(case: MeasuredCase) -> None:
    fitted, step = {"lv_volume": case.split.fitted["lv_volume"]}, 0.2
    base = case.raw["lv_volume"]
    centre = base.values.mean()
    wide = {
        sign: replace(base, values=centre + (1.0 + sign * 0.1) * (base.values - centre))
        for sign in (1.0, -1.0)
    }
    points = [
        SigmaPoint(0, "centre", np.zeros(1), {}),
        SigmaPoint(1, "tau+", np.array([step]), {}),
        SigmaPoint(2, "tau-", np.array([-step]), {}),
    ]
    around = Around(
        points, {"centre": {}, "tau+": {"lv_volume": wide[1.0]}, "tau-": {"lv_volume": wide[-1.0]}}
    )
    found = held_fixed(("sigma_0",), around, fitted, case.raw, 0.1)
    slope = 0.2 * (base.values - centre)[::2] * 0.1 / (2.0 * step)
    assert found == pytest.approx(np.outer(slope, slope), rel=1e-6, abs=1e-18)
    assert not held_fixed(("tau",), around, fitted, case.raw, 0.1).any()


def test_the_refit_finds_the_leak_and_the_heart_that_has_it(refits: tuple[Refit, Refit]) -> None:
    none, extended = refits
    (cause,) = sized(Extension.by(PLAIN, "MitralRegurgitation"), extended, {})
    assert cause.interval[0] < AREA < cause.interval[1]
    assert cause.amplitude == pytest.approx(AREA, rel=0.25)
    assert extended.objective < none.objective - 10.0
    assert extended.log_evidence > none.log_evidence + 10.0
    assert extended.parameters["sigma_0"] == pytest.approx(160e3, rel=0.05)


def test_steps_end_where_the_objective_does_and_no_beat_is_run_twice(
    case: MeasuredCase, refits: tuple[Refit, Refit]
) -> None:
    none, extended = refits
    assert none.converged
    assert extended.converged
    assert none.simulations in [step * 5 + 1 for step in (2, 3, 4)], "an estimate is the next step's centre"
    assert extended.simulations in [step * 7 + 1 for step in (2, 3, 4)]
    hasty = refit(Extension(PLAIN), run, target(case), 1)
    assert not hasty.converged
    assert hasty.simulations == 5 + 1


def test_the_estimate_is_the_best_heart_that_was_simulated(
    case: MeasuredCase, refits: tuple[Refit, Refit]
) -> None:
    extension, found = Extension(PLAIN), refits[0]
    curves = beat_curves(run(extension, found.parameters))
    values = np.concatenate([curves[name](each.times) for name, each in case.split.fitted.items()])
    misfit = target(case).misfit(values)
    assert misfit == pytest.approx(found.misfit)
    assert found.objective == pytest.approx(0.5 * misfit + 0.5 * found.estimate @ found.estimate)


def test_a_model_that_does_not_beat_is_refused(case: MeasuredCase) -> None:
    with pytest.raises(CalibrationError):
        refit(Extension(PLAIN), lambda *_: failed_beat("no equilibrium", PERIOD, 0.1, {}), target(case), 1)


def test_amplitudes_are_off_at_zero_and_one_scale_at_one() -> None:
    extension = Extension.by(PLAIN, "MitralRegurgitation", "CatheterOffset")
    assert extension.names == ("sigma_0", "R_p", "MitralRegurgitation.area", "CatheterOffset.offset")
    off, on = extension.parameters(extension.start(0.0)), extension.parameters(extension.start())
    assert off["MitralRegurgitation.area"] == 0.0
    assert on["MitralRegurgitation.area"] == pytest.approx(0.15e-4)
    assert off["sigma_0"] == on["sigma_0"] == pytest.approx(150e3)
