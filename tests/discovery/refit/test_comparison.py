"""Held-out samples compare a refit with the one before; fitted samples, which would decide otherwise, do not."""

from dataclasses import dataclass, field, replace
from types import SimpleNamespace
from typing import Any, cast

import numpy as np
import pytest

from heartfit.core.arrays import Floats
from heartfit.discovery.refit.extension import Extension
from heartfit.discovery.refit.model import ObservedBeat
from heartfit.discovery.refit.prove import ExtensionTrial, FittedExtension
from heartfit.discovery.refit.refit import Refit
from heartfit.discovery.refit.target import MeasuredCase, sample, stack
from heartfit.discovery.refit.verdict import Proof, curve_gains
from heartfit.discovery.sphere_model.cause import Gain
from heartfit.observation.curve import Curve
from heartfit.personalise.setting import Setting

PERIOD = 0.8
TIMES = {"lv_volume": np.arange(24) * PERIOD / 24, "lv_pressure": (np.arange(80) + 0.5) * PERIOD / 80}
HELD = {"lv_volume": np.arange(24) % 2 == 1, "lv_pressure": np.arange(80) // 4 % 2 == 1}
ML, PA = 1e-6, 1.0
PLAIN = Setting.model_validate({"element": "sphere", "estimate": ("sigma_0", "R_p")}).with_prior({})
NONE, LEAKING, BOTH = (
    Extension.from_names(PLAIN, *("MitralRegurgitation", "AorticStenosis")[:count]) for count in range(3)
)
Errors = tuple[float, float]
"""Errors of a model's volume [mL] and pressure [Pa]."""


def wave(name: str) -> Floats:
    phase = 2.0 * np.pi * TIMES[name] / PERIOD
    return 100e-6 + 40e-6 * np.cos(phase) if name == "lv_volume" else 8e3 - 7e3 * np.cos(phase)


CASE = MeasuredCase.from_curves({name: Curve(TIMES[name], wave(name), PERIOD) for name in TIMES}, [])


def beat(held: Errors, fitted: Errors = (0.0, 0.0)) -> ObservedBeat:
    """A beat that errs by these numbers at held-out and at fitted samples."""
    units = dict(zip(TIMES, (ML, PA), strict=True))
    at = {name: np.where(HELD[name], held[i], fitted[i]) for i, name in enumerate(TIMES)}
    curves = {name: Curve(TIMES[name], wave(name) + units[name] * at[name], PERIOD) for name in TIMES}
    return ObservedBeat(curves, cast("Any", None))


def fitted(extension: Extension, evidence: float = 0.0, slopes: Floats | None = None) -> Refit:
    x = extension.start(0.5)
    known = extension.names, x, np.eye(x.size), extension.parameters(x), 1.0, 1.0, evidence
    return Refit(
        *known, 10, 9, True, x, np.eye(x.size), np.full((1, 1), np.nan) if slopes is None else slopes
    )


@dataclass(frozen=True, eq=False)
class Trial(ExtensionTrial):
    """A trial whose beats, by the number of effects, are known; each extension is likelier than the one before."""

    beats: list[ObservedBeat] = field(default_factory=list)

    def extended(self, extension: Extension, _: Refit) -> Refit:
        return fitted(extension, 10.0 * len(extension.added))

    def at(self, extension: Extension, refit: Refit) -> FittedExtension:
        return FittedExtension(extension, refit, self.beats[len(extension.added)])


@pytest.fixture(autouse=True)
def _same_strain(monkeypatch: pytest.MonkeyPatch) -> None:
    """The beats have no motion: their strain does not change."""
    monkeypatch.setattr(Proof, "strain_gains", (Gain("strain", "never fitted", 1.0, 1.0, 1.0, (0.9, 1.1)),))


def trial(*beats: ObservedBeat) -> Trial:
    model = cast("Any", SimpleNamespace(mesh=None))
    return Trial(CASE, cast("Any", None), model, PLAIN, CASE.target, CASE.complete_target, 5, list(beats))


@pytest.mark.parametrize(
    ("errors", "helps"),
    [
        ((3.0, 1.0, 0.5), [True, True]),
        ((3.0, 1.0, 2.0), [True, False]),
        ((1.0, 3.0, 0.5), [False]),
        ((1.0, 1.0, 1.0), [False]),
    ],
    ids=["both-nearer", "second-farther", "first-farther", "no-nearer"],
)
def test_each_extension_must_come_nearer_to_held_out_samples_than_the_model_before_it(
    errors: tuple[float, ...], helps: list[bool]
) -> None:
    """At the fitted samples the order of the models is the reverse."""
    steps = trial(*(beat((error, 0.0), (4.0 - error, 0.0)) for error in errors))
    base = steps.at(NONE, fitted(NONE))
    assert [nearer for _, nearer in steps.climb(base, [LEAKING, BOTH])] == helps


@pytest.mark.parametrize(
    ("baseline", "extended", "helps"),
    [
        ((3.0, 10.0), (1.0, 100.0), True),
        ((1.1, 100.0), (1.0, 1000.0), False),
        ((3.0, 2000.0), (1.0, 2200.0), True),
        ((3.0, 2000.0), (2.9, 2600.0), False),
    ],
    ids=[
        "2-mL-against-90-Pa",
        "0.1-mL-against-900-Pa",
        "a-curve-missed-by-far",
        "much-farther-from-a-curve-missed-by-far",
    ],
)
def test_volume_and_pressure_count_in_units_of_their_noise_and_of_what_the_model_leaves(
    baseline: Errors, extended: Errors, helps: bool
) -> None:
    """A correct model misses a volume by 0.6 mL and a pressure by 150 Pa."""
    steps = trial(beat(baseline), beat(extended))
    before, after = (
        steps.at(extension, fitted(extension, evidence))
        for extension, evidence in ((NONE, 0.0), (LEAKING, 10.0))
    )
    assert steps.proof(before, after).helps() is helps
    if helps:
        assert not steps.proof(after, before).helps()


def test_a_gain_is_that_of_the_held_out_samples() -> None:
    none, extended = beat((2.0, 300.0), (1.0, 100.0)), beat((1.0, 100.0), (4.0, 500.0))
    gains = {gain.curve: gain for gain in curve_gains(CASE, none.curves, extended.curves)}
    assert gains["lv_volume"].ratio == pytest.approx(0.5)
    assert gains["lv_volume"].none == pytest.approx(2.0 * ML)
    assert gains["lv_pressure"].ratio == pytest.approx(1.0 / 3.0)
    assert all("not fitted" in gain.on for gain in gains.values())


def curves_at(x: Floats) -> dict[str, Curve]:
    """Curves that are linear in both coordinates: the sizes of a cosine and of a sine."""
    sizes = dict(zip(TIMES, (1.0 * ML, 200.0 * PA), strict=True))
    phases = {name: 2.0 * np.pi * times / PERIOD for name, times in TIMES.items()}
    changes = {
        name: sizes[name] * (x[0] * np.cos(phase) + x[1] * np.sin(phase)) for name, phase in phases.items()
    }
    return {name: Curve(TIMES[name], wave(name) + change, PERIOD) for name, change in changes.items()}


def test_the_final_size_of_a_linear_model_is_the_posterior_of_all_samples() -> None:
    """The estimate of the fitted half, from which the linear step starts, has no influence on it."""
    case = MeasuredCase.from_curves(curves_at(np.array([0.8, -1.1])), [])
    complete, rows = case.complete_target, np.vstack([np.zeros(2), np.eye(2)])
    origin, *units = (stack(sample(curves_at(x), complete.samples)) for x in rows)
    A = np.column_stack([unit - origin for unit in units])
    weighted = np.linalg.solve(complete.covariance, A)
    covariance = np.linalg.inv(np.eye(2) + A.T @ weighted)
    steps = replace(trial(), complete=complete)
    for estimate in (np.zeros(2), np.array([0.5, 0.4])):
        shown = ObservedBeat(curves_at(estimate), cast("Any", None))
        final = steps.final(FittedExtension(NONE, replace(fitted(NONE, slopes=A), estimate=estimate), shown))
        assert final is not None
        assert final.mean == pytest.approx(covariance @ weighted.T @ (complete.values() - origin))
        assert final.covariance == pytest.approx(covariance)
