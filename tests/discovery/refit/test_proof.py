"""A leak hidden in a sphere is refitted and gains on held-out data; an effect without gain is withdrawn."""

from collections.abc import Mapping
from dataclasses import replace

import numpy as np
import pytest

from heartfit.calibration.unscented import CalibrationError
from heartfit.discovery.refit.extension import Extension
from heartfit.discovery.refit.refit import Refit, continue_refit, refit
from heartfit.discovery.refit.target import BIN, BLOCK, MeasuredCase, Split, Target, average_bins, covariance
from heartfit.discovery.refit.verdict import causes_of
from heartfit.heart.beat import Beat, failed_beat
from heartfit.heart.simulation import Numerics
from heartfit.heart.sphere.body import Sphere
from heartfit.heart.sphere.simulation import simulate_spheres
from heartfit.observation.beat import beat_curves
from heartfit.observation.curve import Curve
from heartfit.observation.noise_model import NoiseModel
from heartfit.observation.scatter import Scatter
from heartfit.personalise.setting import Setting
from tests.discovery.refit.one_by_one import OneByOne

PERIOD = 0.8
SPHERE = Sphere.from_volumes(110e-6, 200e-6)
PLAIN = Setting.model_validate(
    {"element": "sphere", "estimate": ("sigma_0", "R_p"), "prior": {"sigma_0": {"mean": 150e3}}}
).with_prior({})
AREA = 0.4e-4


@OneByOne
def run(extension: Extension, parameters: Mapping[str, float]) -> Beat:
    heart = extension.setting.base_heart(PERIOD).with_parameters(parameters)
    return simulate_spheres(heart, [SPHERE], Numerics(time_step=5e-3, max_beats=8, drift=1e-3))


def shown(area: float, contractility: float = 160e3) -> dict[str, Curve]:
    leaking = Extension.from_names(PLAIN, "MitralRegurgitation")
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
    return MeasuredCase.from_curves(noisy, [])


def target(case: MeasuredCase) -> Target:
    return Target(case.split.fitted, covariance(case.split.fitted, case.raw, []))


@pytest.fixture(scope="module")
def refits(case: MeasuredCase) -> tuple[Refit, Refit]:
    none, extended = Extension(PLAIN), Extension.from_names(PLAIN, "MitralRegurgitation")
    targets = target(case), case.complete_target
    return refit(none, run, *targets, 20), refit(extended, run, *targets, 20)


def test_no_sample_is_both_fitted_and_held_out(case: MeasuredCase) -> None:
    split = case.split
    for name, samples in split.fitted.items():
        assert not set(samples.times) & set(split.held[name].times)
    assert len(split.fitted["lv_volume"].times) == 13
    first = split.fitted["lv_pressure"].times
    assert np.diff(first)[BLOCK - 1] == pytest.approx((BLOCK + 1) * BIN, abs=3e-3), "then a block is left out"


def test_a_refit_of_both_ventricles_holds_half_of_the_right_volume_out(case: MeasuredCase) -> None:
    split = Split.from_curves({**case.curves, "rv_volume": case.curves["lv_volume"]})
    fitted, held = split.fitted["rv_volume"], split.held["rv_volume"]
    assert fitted.times == pytest.approx(split.fitted["lv_volume"].times)
    assert not set(fitted.times) & set(held.times)
    own = set(Extension(PLAIN).with_free_parameters(True).names) - set(
        Extension(PLAIN).with_free_parameters().names
    )
    assert {"tissue.right.contractility", "tissue.right.delay", "AtrialKick.right"} < own


def test_a_volume_that_was_read_twice_is_averaged_and_has_the_noise_of_its_readings(
    case: MeasuredCase,
) -> None:
    first = case.raw["lv_volume"]
    error = 2e-6 * np.cos(np.pi * np.arange(25) / 3.0)
    scale = np.column_stack([np.ones(25), first.values])
    error -= scale @ np.linalg.lstsq(scale[::2], error[::2], rcond=None)[0]
    twice = MeasuredCase.from_curves(case.raw, [], replace(first, values=3.0 * (first.values + error)))
    assert twice.curves["lv_volume"].values == pytest.approx(first.values + 0.5 * error, abs=0.3e-6)
    known = twice.frames["lv_volume"]
    rows = slice(0, 13)
    lags = np.abs(np.subtract.outer(first.times[::2], first.times[::2]))
    rough = 0.6e-6**2 * np.exp(-np.minimum(lags, PERIOD - lags) / 0.05)
    assert twice.target.covariance[rows, rows] == pytest.approx(known.covariance(first.times[::2]) + rough)
    assert twice.recording().noise == twice.frames


def test_what_chooses_a_name_is_kept_from_what_judges_it(case: MeasuredCase) -> None:
    chosen, unseen = replace(case, curves={**case.curves, "rv_volume": case.curves["lv_volume"]}).halves()
    assert unseen is not None
    assert set(unseen.curves) == {"lv_volume", "lv_pressure"}
    assert "rv_volume" in chosen.curves, "reported as not searched"
    for name, samples in unseen.curves.items():
        assert not set(samples.times) & set(chosen.curves[name].times)


def test_few_frames_are_not_halved(case: MeasuredCase) -> None:
    volume = case.curves["lv_volume"].resampled(12)
    chosen, unseen = MeasuredCase.from_curves({"lv_volume": volume}, []).halves()
    assert unseen is None
    assert chosen.curves["lv_volume"].times.size == 12


def test_bins_are_means_and_few_samples_keep_their_number() -> None:
    times = np.arange(200) * 0.004
    means = average_bins(Curve(times, times, 0.8))
    assert means.times == pytest.approx(means.values)
    assert np.diff(means.times).max() < 0.013
    assert average_bins(Curve(times[::10], times[::10], 0.8)).times.size == 20


def test_the_noise_of_images_is_that_of_their_phases(case: MeasuredCase) -> None:
    sd = np.linspace(0.0, 0.02, 25)
    scatter = Scatter(tuple(map(str, range(25))), 20, np.zeros(25), np.diag(sd**2))
    fitted = {"lv_volume": case.split.fitted["lv_volume"]}
    total = covariance(fitted, case.raw, [NoiseModel({}, scatter, {"lv_volume": scatter})])
    exact = {"lv_volume": replace(scatter, covariance=np.zeros((25, 25)))}
    rough = covariance(fitted, case.raw, [NoiseModel({}, scatter, exact)])
    stroke = np.ptp(case.raw["lv_volume"].values)
    assert np.diag(total - rough) == pytest.approx(1.05 * (stroke * sd[::2]) ** 2)
    assert np.linalg.eigvalsh(rough).min() > 0.0


def test_the_refit_finds_the_leak_and_the_heart_that_has_it(refits: tuple[Refit, Refit]) -> None:
    none, extended = refits
    (cause,) = causes_of(Extension.from_names(PLAIN, "MitralRegurgitation"), extended.posterior, {})
    assert cause.interval[0] < AREA < cause.interval[1]
    assert cause.amplitude == pytest.approx(AREA, rel=0.25)
    assert extended.objective < none.objective - 10.0
    assert extended.log_evidence > none.log_evidence + 10.0
    assert extended.parameters["sigma_0"] == pytest.approx(160e3, rel=0.05)


def test_a_refit_renews_its_slopes_and_takes_one_beat_per_step_until_convergence(
    case: MeasuredCase, refits: tuple[Refit, Refit]
) -> None:
    none, extended = refits
    assert none.converged
    assert extended.converged
    assert 1 + 2 * 3 < none.simulations < 1 + 4 * 3 + 15
    assert 1 + 2 * 4 < extended.simulations < 1 + 4 * 4 + 20
    hasty = refit(Extension(PLAIN), run, target(case), case.complete_target, 1)
    assert hasty.simulations == 1 + 3 + 1 + 3
    assert not hasty.converged


def test_fixed_parameters_of_a_setting_are_freed_about_its_heart() -> None:
    freed = Extension.from_names(PLAIN, "MitralRegurgitation").with_free_parameters()
    held, heart = (
        {freed_parameter.name for freed_parameter in freed.freed},
        PLAIN.base_heart(PERIOD).parameters(),
    )
    assert "circulation.systemic.tau" in held
    assert "circulation.systemic.R_p" not in held, "estimated already"
    x = freed.start(2.0)
    assert freed.parameters(x)["circulation.systemic.tau"] == pytest.approx(heart["circulation.systemic.tau"])
    assert freed.parameters(x)["MitralRegurgitation.area"] == pytest.approx(2 * 0.15e-4)
    x[freed.names.index("circulation.systemic.tau")] = 1.0
    tau = freed.parameters(x)["circulation.systemic.tau"]
    assert tau == pytest.approx(heart["circulation.systemic.tau"] * np.exp(0.2))


def test_a_heart_with_a_shorter_contraction_gets_a_leak_only_if_the_duration_is_frozen() -> None:
    plain = Extension(PLAIN)
    off = plain.parameters(plain.start()) | {"tissue.control.duration": 0.30}
    curves = beat_curves(run(plain, off))
    sound = MeasuredCase.from_curves(
        {name: curves[name].resampled(50) for name in ("lv_volume", "lv_pressure")}, []
    )
    frozen, freed = (
        [
            refit(extension, run, target(sound), sound.complete_target, 30).log_evidence
            for extension in (none, leak)
        ]
        for none, leak in (
            (plain, Extension.from_names(PLAIN, "MitralRegurgitation")),
            (
                plain.with_free_parameters(),
                Extension.from_names(PLAIN, "MitralRegurgitation").with_free_parameters(),
            ),
        )
    )
    assert frozen[1] - frozen[0] > 5.0
    assert freed[1] - freed[0] < 1.0


def test_a_refit_from_the_end_of_the_baseline_finds_the_extension(
    case: MeasuredCase, refits: tuple[Refit, Refit]
) -> None:
    none, extended = refits
    continued = continue_refit(
        Extension.from_names(PLAIN, "MitralRegurgitation"), run, target(case), case.complete_target, 20, none
    )
    assert continued.converged
    assert continued.objective == pytest.approx(extended.objective, abs=1.0)
    assert continued.log_evidence == pytest.approx(extended.log_evidence, abs=1.5)
    assert continued.simulations < extended.simulations + 5


def test_slopes_are_differences_at_the_estimate(case: MeasuredCase, refits: tuple[Refit, Refit]) -> None:
    extension, fit = Extension.from_names(PLAIN, "MitralRegurgitation"), refits[1]
    shifted = fit.estimate + 0.25 * np.eye(3)[1]
    curves = beat_curves(run(extension, extension.parameters(shifted)))
    values = np.concatenate([curves[name](held.times) for name, held in case.split.fitted.items()])
    assert fit.slopes[:, 1] == pytest.approx((values - fit.predicted) / 0.25)


def test_a_slope_without_a_beat_is_not_known(case: MeasuredCase) -> None:
    plain = Extension(PLAIN)
    beats = [run(plain, plain.parameters(np.zeros(2)))] * 2

    @OneByOne
    def only_at_the_centre(*_: object) -> Beat:
        return beats.pop() if beats else failed_beat("never", PERIOD, 0.0, {})

    fit = refit(plain, only_at_the_centre, target(case), case.complete_target, 20)
    assert np.isnan(fit.complete_slopes).all()
    assert not fit.slopes.any()
    assert fit.estimate == pytest.approx(0.0)
    beats = [run(plain, plain.parameters(np.zeros(2)))]
    with pytest.raises(CalibrationError, match="repeated"):
        refit(plain, only_at_the_centre, target(case), case.complete_target, 20)


def test_an_absent_effect_ends_at_zero_at_the_optimum_of_the_baseline() -> None:
    plain = Extension(PLAIN)
    curves = beat_curves(run(plain, plain.parameters(np.array([0.5, -0.5]))))
    sound = MeasuredCase.from_curves(
        {name: curves[name].resampled(50) for name in ("lv_volume", "lv_pressure")}, []
    )
    none = refit(plain, run, target(sound), sound.complete_target, 20)
    continued = continue_refit(
        Extension.from_names(PLAIN, "MitralRegurgitation"),
        run,
        target(sound),
        sound.complete_target,
        20,
        none,
    )
    assert continued.estimate[-1] == pytest.approx(0.0, abs=0.05)
    assert continued.objective < none.objective + 0.3
    assert continued.log_evidence < none.log_evidence


def test_the_estimate_is_a_heart_that_was_simulated(case: MeasuredCase, refits: tuple[Refit, Refit]) -> None:
    extension, fit = Extension(PLAIN), refits[0]
    curves = beat_curves(run(extension, fit.parameters))
    values = np.concatenate([curves[name](curve.times) for name, curve in case.split.fitted.items()])
    misfit = target(case).misfit(values)
    assert misfit == pytest.approx(fit.misfit)
    assert fit.objective == pytest.approx(0.5 * misfit + 0.5 * fit.estimate @ fit.estimate)


def test_a_model_that_does_not_beat_is_refused(case: MeasuredCase) -> None:
    never = OneByOne(lambda *_: failed_beat("no equilibrium", PERIOD, 0.1, {}))
    with pytest.raises(CalibrationError):
        refit(Extension(PLAIN), never, target(case), case.complete_target, 1)


def test_amplitudes_are_off_at_zero_and_one_scale_at_one() -> None:
    extension = Extension.from_names(PLAIN, "MitralRegurgitation", "CatheterOffset")
    assert extension.names == ("sigma_0", "R_p", "MitralRegurgitation.area", "CatheterOffset.offset")
    off, on = extension.parameters(extension.start(0.0)), extension.parameters(extension.start())
    assert off["MitralRegurgitation.area"] == 0.0
    assert on["MitralRegurgitation.area"] == pytest.approx(0.15e-4)
    assert off["sigma_0"] == on["sigma_0"] == pytest.approx(150e3)
