"""Refit of a model whose curve is linear in the coordinates: estimate, covariance and evidence in closed form."""

from collections.abc import Mapping
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from scipy.integrate import simpson
from scipy.stats import norm

from heartfit.core.arrays import Floats
from heartfit.discovery.refit import refit as module
from heartfit.discovery.refit.extension import Extension
from heartfit.discovery.refit.refit import Refit, complete_posterior, continue_refit, refit
from heartfit.discovery.refit.target import Target
from heartfit.discovery.sphere_model.recording import Samples
from heartfit.mechanisms.mitral_regurgitation import MitralRegurgitation
from heartfit.personalise.setting import Setting
from tests.discovery.refit.one_by_one import OneByOne

PLAIN = Setting.model_validate(
    {"element": "sphere", "estimate": ("sigma_0", "R_p"), "prior": {"sigma_0": {"mean": 150e3}}}
).with_prior({})
NONE, LEAKING = Extension(PLAIN), Extension.from_names(PLAIN, "MitralRegurgitation")
SLOPES = np.random.default_rng(5).standard_normal((12, 3))
TRUTH = np.array([0.6, -0.4, 1.2])
NOISE = 0.2**2 * np.eye(12)
WITHIN = 0.3
"""Predicted decrease of the objective that ends a refit."""


def target(x: Floats = TRUTH) -> Target:
    return Target({"lv_volume": Samples(np.arange(12.0), SLOPES @ x)}, NOISE)


@OneByOne
def run(extension: Extension, parameters: Mapping[str, float]) -> SimpleNamespace:
    """Stand-in for a beat: the coordinates at which the parameters lie."""
    prior = PLAIN.gaussian()
    x = (np.log([parameters[name] for name in prior.names]) - prior.mean) / prior.sd
    areas = [parameters["MitralRegurgitation.area"]] if extension.added else []
    return SimpleNamespace(completed=True, x=np.append(x, areas) / np.append(np.ones(2), leak_scale(areas)))


def leak_scale(areas: list[float]) -> Floats:
    return np.full(len(areas), MitralRegurgitation.switch().scale)


@pytest.fixture(autouse=True)
def _linear(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(
        module,
        "beat_curves",
        lambda beat, _: {"lv_volume": lambda times: (SLOPES[:, : beat.x.size] @ beat.x)[times.astype(int)]},
    )


def posterior(count: int, y: Floats) -> tuple[Floats, Floats, float]:
    """Mean, covariance and ln Z of the first coordinates under N(0, I), up to the constant of the samples."""
    A = SLOPES[:, :count]
    covariance = np.linalg.inv(np.eye(count) + A.T @ np.linalg.solve(NOISE, A))
    marginal = NOISE + A @ A.T
    volumes = np.linalg.slogdet(marginal)[1] - np.linalg.slogdet(NOISE)[1]
    evidence = -0.5 * (y @ np.linalg.solve(marginal, y) + volumes)
    return covariance @ A.T @ np.linalg.solve(NOISE, y), covariance, float(evidence)


@pytest.fixture
def fits() -> tuple[Refit, Refit]:
    return refit(NONE, run, target(), target(), 20), refit(LEAKING, run, target(), target(), 20)


def test_a_refit_ends_at_the_posterior_with_its_evidence(fits: tuple[Refit, Refit]) -> None:
    for fit in fits:
        mean, covariance, evidence = posterior(fit.estimate.size, target().values())
        off = fit.estimate - mean
        assert fit.converged
        assert 0.5 * off @ np.linalg.solve(covariance, off) < WITHIN
        assert fit.covariance == pytest.approx(covariance, rel=1e-6)
        positive = np.log(2.0 * norm.cdf(mean[2] / np.sqrt(covariance[2, 2]))) if mean.size == 3 else 0.0
        assert fit.log_evidence == pytest.approx(evidence + positive, abs=1e-6)


def integrated_evidence(y: Floats) -> float:
    """ln Z of the leaking model by quadrature over the amplitude a >= 0, up to the constant of the samples."""
    A = SLOPES[:, :2]
    marginal = NOISE + A @ A.T
    volumes = np.linalg.slogdet(marginal)[1] - np.linalg.slogdet(NOISE)[1]
    residual = y - np.linspace(0.0, 8.0, 16001)[:, None] * SLOPES[:, 2]
    squares = np.einsum("ai,ai->a", residual, np.linalg.solve(marginal, residual.T).T)
    squares += np.linspace(0.0, 8.0, 16001) ** 2
    integral = simpson(np.exp(-0.5 * (squares - squares.min())), dx=8.0 / 16000.0)
    return float(np.log(2.0 * integral / np.sqrt(2.0 * np.pi)) - 0.5 * squares.min() - 0.5 * volumes)


@pytest.mark.parametrize("size", [-4.0, -1.2, -0.3, 0.3, 1.2])
@pytest.mark.parametrize("shared", [0.0, 0.9, -0.9])
def test_the_evidence_of_an_amplitude_near_its_bound_is_its_integral(
    monkeypatch: pytest.MonkeyPatch, size: float, shared: float
) -> None:
    """Also where the effect looks like that of another unknown: ``shared`` is the cosine of their slopes."""
    base, own = np.linalg.qr(SLOPES)[0][:, :2], np.linalg.qr(SLOPES)[0][:, 2]
    columns = np.column_stack([base, shared * base[:, 0] + np.sqrt(1.0 - shared**2) * own])
    monkeypatch.setitem(globals(), "SLOPES", columns)
    measured = target(np.array([*TRUTH[:2], size]))
    fit = refit(LEAKING, run, measured, measured, 20)
    assert (fit.estimate[2] == 0.0) == (size < 0.0)
    assert fit.log_evidence == pytest.approx(integrated_evidence(measured.values()), abs=0.01)


def test_the_first_slopes_are_those_of_the_model() -> None:
    assert refit(LEAKING, run, target(), target(), 0).slopes == pytest.approx(SLOPES)


def test_an_amplitude_of_the_wrong_sign_is_held_at_zero() -> None:
    negative = target(TRUTH * [1.0, 1.0, -1.0])
    fit = refit(LEAKING, run, negative, negative, 20)
    assert fit.converged
    assert fit.estimate[2] == 0.0


def test_an_extension_starts_where_the_model_without_it_ended(fits: tuple[Refit, Refit]) -> None:
    continued = continue_refit(LEAKING, run, target(), target(), 0, fits[0])
    assert continued.estimate == pytest.approx([*fits[0].estimate, 0.5])
    assert continued.slopes == pytest.approx(SLOPES)
    assert continued.simulations == 1 + 1 + 3, "the start, then the beats of its slopes"
    further = continue_refit(LEAKING, run, target(), target(), 20, fits[0])
    assert further.estimate == pytest.approx(fits[1].estimate, abs=0.05)


def test_every_step_has_slopes_of_its_own(monkeypatch: pytest.MonkeyPatch) -> None:
    """A model whose slopes turn along the way: corrected slopes of the start alone end above the minimum."""

    def bent(times: Floats, x: Floats) -> Floats:
        return (SLOPES[:, : x.size] @ (x + 0.4 * np.sin(3.0 * x)))[times.astype(int)]

    monkeypatch.setattr(
        module, "beat_curves", lambda beat, _: {"lv_volume": lambda times: bent(times, beat.x)}
    )
    measured = Target({"lv_volume": Samples(np.arange(12.0), bent(np.arange(12.0), TRUTH))}, NOISE)
    fit = refit(LEAKING, run, measured, measured, 20)
    assert fit.converged
    assert fit.objective < 0.5 * TRUTH @ TRUTH + 0.1


def test_slopes_that_cost_too_much_are_corrected_instead(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(module, "SLOPE_BEATS", 1)
    negative = target(TRUTH * [1.0, 1.0, -1.0])
    fit = refit(LEAKING, run, negative, negative, 20)
    assert fit.converged
    assert fit.slopes == pytest.approx(SLOPES), "of a linear model these stay right"
    assert 1 + 1 + 3 < fit.simulations < 1 + 1 + 3 + 10, "slopes once, then a beat for each step"


def test_the_final_posterior_is_that_of_all_samples_whatever_half_was_fitted() -> None:
    complete = target()
    half = Target({"lv_volume": complete.samples["lv_volume"].part(np.arange(12) % 2 == 0)}, NOISE[:6, :6])
    fit = refit(LEAKING, run, half, complete, 20)
    assert fit.complete_slopes == pytest.approx(SLOPES)
    assert fit.slopes == pytest.approx(SLOPES[::2]), "of the fitted samples"
    final = complete_posterior(LEAKING, fit, complete, SLOPES @ fit.estimate)
    mean, covariance, _ = posterior(3, complete.values())
    assert final is not None
    assert final.mean == pytest.approx(mean)
    assert final.covariance == pytest.approx(covariance)
    assert (final.sd < fit.posterior.sd).all()
    negative = replace(complete.samples["lv_volume"], values=SLOPES @ (TRUTH * [1.0, 1.0, -1.0]))
    bounded = complete_posterior(LEAKING, fit, Target({"lv_volume": negative}, NOISE), SLOPES @ fit.estimate)
    assert bounded is not None
    assert bounded.mean[2] == 0.0


def test_without_a_slope_of_all_samples_there_is_no_final_posterior(fits: tuple[Refit, Refit]) -> None:
    unknown = replace(fits[1], complete_slopes=np.where(np.arange(3) == 1, np.nan, SLOPES))
    assert complete_posterior(LEAKING, unknown, target(), fits[1].predicted) is None


def test_a_coordinate_is_a_standard_deviation_of_the_prior() -> None:
    x, prior = np.array([1.0, -2.0, 0.5]), PLAIN.gaussian()
    values = LEAKING.parameters(x)
    assert values["sigma_0"] == pytest.approx(150e3 * np.exp(prior.sd[0]))
    assert values["R_p"] == pytest.approx(np.exp(prior.mean[1] - 2.0 * prior.sd[1]))
    assert values["MitralRegurgitation.area"] == pytest.approx(0.5 * MitralRegurgitation.switch().scale)
