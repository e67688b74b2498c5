"""Gains of a cause on held-out data: the other half of the recording, or the same heart under another condition.

The other half was kept from the search, and the models that it fitted predict it. Another condition: the fitted model
beats at the rate of that condition, and only its loading, the atrial pressure and the peripheral resistance, is
refitted.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from math import exp

import numpy as np

from heartfit.core.arrays import Floats
from heartfit.discovery.inference.context import FitContext
from heartfit.discovery.inference.data import Data, Whitening
from heartfit.discovery.inference.error_ratio import error_ratio
from heartfit.discovery.inference.hypothesis import Coordinate, Hypothesis
from heartfit.discovery.sphere_model.cause import Gain
from heartfit.discovery.sphere_model.forward_model import SphereForwardModel, hypothesis
from heartfit.discovery.sphere_model.nominal_heart import NominalHeart
from heartfit.discovery.sphere_model.problem import SphereProblem
from heartfit.discovery.sphere_model.recording import Recording
from heartfit.discovery.sphere_model.searched_recording import SearchedRecording

LOADING = {"circulation.left_atrium": 0.3, "circulation.systemic.R_p": 0.3}
RIGHT_LOADING = {"circulation.right_atrium": 0.3, "circulation.pulmonary_tree.R_p": 0.3}
"""Parameters that another condition may change, with the standard deviations of the logarithm of the change."""


@dataclass(frozen=True, eq=False)
class HeldOutPrediction:
    """Held-out data and their predictions (n,) without (``baseline``) and with the cause (``extended``)."""

    on: str
    data: Data
    baseline: Floats
    extended: Floats

    def helps(self) -> bool:
        """True if the cause makes the held-out data more likely."""
        return self.log_likelihood_gain() > 0.0

    def log_likelihood_gain(self) -> float:
        """ln likelihood of the held-out data with the cause, minus that without."""
        whitening = Whitening.from_data(self.data)
        baseline, extended = (
            whitening.log_likelihood(self.data.values - predicted)
            for predicted in (self.baseline, self.extended)
        )
        return extended - baseline

    def gains(self) -> tuple[Gain, ...]:
        """One gain for each curve."""
        return tuple(self._gain(index) for index in range(len(self.data.blocks)))

    def _gain(self, index: int) -> Gain:
        block, rows = self.data.blocks[index], self.data.rows[index]
        errors = [(self.data.values - predicted)[rows] for predicted in (self.baseline, self.extended)]
        ratio, interval = error_ratio(np.mod(block.times, block.period), *errors)
        before, after = (float(np.sqrt(np.mean(error**2))) for error in errors)
        return Gain(block.curve, self.on, before, after, ratio, interval)


Extension = Callable[[SphereForwardModel], Hypothesis]
"""The hypothesis of a cause about a forward model."""


def predict_unseen(
    unseen: SphereProblem, extension: Extension, baseline: Floats, extended: Floats
) -> HeldOutPrediction | None:
    """Prediction of data that the search has not seen, by both models as they were fitted; None where a beat fails."""
    model = unseen.model
    without, within = hypothesis(model).forward(baseline), extension(model).forward(extended)
    if without is None or within is None:
        return None
    return HeldOutPrediction("samples that the search has not seen", unseen.data, without, within)


def predict_condition(
    name: str, nominal: NominalHeart, data: Data, extension: Extension, baseline: Floats, extended: Floats
) -> HeldOutPrediction | None:
    """Prediction of another condition by both fitted models with refitted loading; None where a fit fails."""
    paced = nominal.at_period(data.blocks[0].period)
    without = _fit_loading(paced, data, hypothesis, baseline)
    within = _fit_loading(paced, data, extension, extended)
    if without is None or within is None:
        return None
    return HeldOutPrediction(name, data, without, within)


def _fit_loading(nominal: NominalHeart, data: Data, extension: Extension, x: Floats) -> Floats | None:
    loads = LOADING if nominal.right is None else LOADING | RIGHT_LOADING

    def forward(change: Floats) -> Floats | None:
        pairs = zip(loads.items(), change.tolist(), strict=True)
        changed = {path: nominal.values[path] * exp(sd * z) for (path, sd), z in pairs}
        loaded = replace(nominal, heart=nominal.heart.with_parameters(changed))
        return extension(SphereForwardModel.at_samples(loaded, data.blocks)).forward(x)

    loading = Hypothesis((), tuple(Coordinate(path) for path in loads), forward)
    explanation = FitContext(data).explain(loading, loading.at(0.0))
    return None if explanation is None else explanation.fit.predicted


def predict_extension(
    case: SearchedRecording, extension: Extension, fitted: Floats, conditions: Mapping[str, Recording]
) -> list[HeldOutPrediction | None]:
    """Predictions of conditions and unseen samples without and with an extension at its ``fitted`` coordinates (d,)."""
    fits, nominal = (case.findings.survey.baseline.fit.x, fitted), case.model.nominal
    tests: list[HeldOutPrediction | None] = [
        predict_condition(name, nominal, case.problem(condition).data, extension, *fits)
        for name, condition in conditions.items()
    ]
    if case.unseen_problem is not None:
        tests.append(predict_unseen(case.unseen_problem, extension, *fits))
    return tests
