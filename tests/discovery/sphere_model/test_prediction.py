"""Predictions of held-out data by models in closed form: nothing is fitted to the data that judge."""

from collections.abc import Sequence
from dataclasses import replace
from functools import partial
from typing import cast

import numpy as np
import pytest

from heartfit.core.arrays import Floats
from heartfit.discovery.inference.data import Block, Data, Noise
from heartfit.discovery.inference.hypothesis import Coordinate, Hypothesis
from heartfit.discovery.sphere_model import held_out as module
from heartfit.discovery.sphere_model.forward_model import Candidate, SphereForwardModel
from heartfit.discovery.sphere_model.held_out import predict_condition, predict_unseen
from heartfit.discovery.sphere_model.nominal_heart import ADULT
from heartfit.discovery.sphere_model.problem import SphereProblem
from heartfit.discovery.sphere_model.recording import Recording

PERIOD = 0.8
SIZES = {"lv_volume": 40e-6, "lv_pressure": 7e3}
NOISES = {name: Noise((1e-3 * size,), 0.0, 0.0, 0.0) for name, size in SIZES.items()}
EFFECT = cast("tuple[Candidate, ...]", ("effect",))


def model_of(model: SphereForwardModel, effects: Sequence[object] = ()) -> Hypothesis:
    """Curves of a heart whose size is one coordinate; the effect adds a second harmonic.

    The size grows with the atrial pressure and falls with the peripheral resistance, and the beat has the heart's rate.
    """
    values, period = model.nominal.values, model.nominal.heart.period
    load = values["circulation.left_atrium"] / 900.0
    resistance = values["circulation.systemic.R_p"] / 1.15e8

    def forward(x: Floats) -> Floats:
        curves = []
        for name, times in model.times.items():
            phase = 2.0 * np.pi * times / period
            curve = (1.0 + x[0]) * (load * np.cos(phase) + resistance * np.sin(phase))
            curves.append(SIZES[name] * (curve + sum(x[1:]) * np.cos(2.0 * phase)))
        return np.concatenate(curves)

    return Hypothesis(
        tuple(map(str, effects)), tuple(Coordinate(f"x{i}") for i in range(1 + len(effects))), forward
    )


@pytest.fixture(autouse=True)
def _closed_form(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(module, "hypothesis", model_of)


def measured(times: dict[str, Floats], nominal: object, x: Floats, period: float = PERIOD) -> Data:
    """Data without noise of the heart with the effect."""
    blocks = tuple(Block(name, "SI", at, period, NOISES[name]) for name, at in times.items())
    return Data(model_of(SphereForwardModel(nominal, times), EFFECT).forward(x), blocks)  # type: ignore[arg-type]


EXTENSION = partial(model_of, effects=EFFECT)
RESTING = ADULT.at_period(PERIOD)
ONE_BEAT = {"lv_volume": np.arange(24) * PERIOD / 24, "lv_pressure": (np.arange(80) + 0.5) * PERIOD / 80}
TRUTH = np.array([0.2, 0.3])


def test_unseen_samples_are_predicted_as_the_models_were_fitted() -> None:
    data = measured(ONE_BEAT, RESTING, TRUTH)
    unseen = SphereProblem(cast("Recording", None), data, SphereForwardModel(RESTING, ONE_BEAT))
    prediction = predict_unseen(unseen, EXTENSION, np.array([0.1]), TRUTH)
    assert prediction is not None
    assert prediction.extended == pytest.approx(data.values)
    assert prediction.baseline == pytest.approx(
        model_of(SphereForwardModel(RESTING, ONE_BEAT)).forward(np.array([0.1]))
    )
    assert prediction.helps()


def test_another_condition_changes_rate_and_loading_and_nothing_else() -> None:
    """The heart beats faster, fuller and against less resistance; size and effect are those of the rest."""
    faster = ADULT.at_period(0.6)
    loading = {"circulation.left_atrium": 900.0 * 1.3, "circulation.systemic.R_p": 1.15e8 * 0.8}
    raised = replace(faster, heart=faster.heart.with_parameters(loading))
    times = {name: at * 0.6 / PERIOD for name, at in ONE_BEAT.items()}
    data = measured(times, raised, TRUTH, 0.6)
    close = 2e-3 * np.abs(data.values).max()
    prediction = predict_condition("legs raised", RESTING, data, EXTENSION, TRUTH[:1], TRUTH)
    assert prediction is not None
    assert prediction.extended == pytest.approx(data.values, abs=close)
    assert prediction.helps()
    larger = predict_condition(
        "legs raised", RESTING, data, EXTENSION, TRUTH[:1], TRUTH + np.array([0.0, 0.5])
    )
    assert larger is not None
    assert not larger.helps(), "the size of an effect is not fitted to another condition"
