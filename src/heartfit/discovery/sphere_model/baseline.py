"""Fit of the sphere without a mechanism: what it leaves of a healthy heart, and of the same heart at another time."""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from heartfit.core.arrays import Floats
from heartfit.core.errors import InputError
from heartfit.discovery.inference.context import FitContext
from heartfit.discovery.inference.data import Data, Whitening
from heartfit.discovery.inference.evidence import Explanation, fit
from heartfit.discovery.inference.hypothesis import CountedHypothesis
from heartfit.discovery.sphere_model.forward_model import SphereForwardModel, hypothesis
from heartfit.discovery.sphere_model.nominal_heart import ADULT, PEOPLE, NominalHeart, perturb
from heartfit.discovery.sphere_model.recording import BIN, Recording, averaged_by_phase, search_data
from heartfit.discovery.sphere_model.structure import CURVES, FINE, Frame, Landmarks, Structure

NO_BEAT = "baseline: the sphere does not beat about the nominal heart; expected it to"


@dataclass(frozen=True, eq=False)
class SphereProblem:
    """A recording as a problem of inference: its data, with the structural covariance, and the forward model."""

    recording: Recording
    data: Data
    model: SphereForwardModel

    @classmethod
    def from_recording(
        cls, recording: Recording, nominal: NominalHeart | None = None, structure: Structure | None = None
    ) -> "SphereProblem":
        """Pose the problem.

        structure: of the discrepancy that the data may hold; None where the model is trusted. nominal: scaled to the
        recorded size, the ADULT of a trusted model or the middle of all PEOPLE, if None.
        """
        data = search_data(recording)
        middle = ADULT if structure is None else PEOPLE
        model = SphereForwardModel.at_samples(nominal or middle.scaled_to(recording), data.blocks)
        problem = cls(recording, data, model)
        return problem if structure is None else problem._within(structure)

    def _within(self, structure: Structure) -> "SphereProblem":
        weights = self.frame.weights(self.data.blocks)
        mean = weights @ structure.mean
        blocks = zip(self.data.blocks, self.data.rows, strict=True)
        return replace(
            self,
            data=replace(
                self.data, structure=weights @ structure.covariance @ weights.T, scales=structure.scales
            ),
            model=replace(self.model, offsets={block.curve: mean[rows] for block, rows in blocks}),
        )

    @cached_property
    def frame(self) -> Frame:
        """Landmarks of the recorded pressure or, without one, of the fitted beat's."""
        volume = self.recording.end_diastolic_volume()
        if "lv_pressure" not in self.recording.curves:
            return Frame(self._simulated_landmarks(), {"lv_volume": volume})
        period = self.recording.period
        pressure = averaged_by_phase(self.recording.curves["lv_pressure"], period, BIN)
        landmarks = Landmarks.from_pressure(pressure.times, pressure.values, period)
        return Frame(landmarks, {"lv_volume": volume, "lv_pressure": float(np.ptp(pressure.values))})

    def _simulated_landmarks(self) -> Landmarks:
        nominal = self.model.nominal
        times = np.arange(FINE) * nominal.heart.period / FINE
        pressure = SphereForwardModel(nominal, {"lv_pressure": times}).predict(self.fit().fit.x, ())
        if pressure is None:
            raise InputError(NO_BEAT)
        return Landmarks.from_pressure(times, pressure, nominal.heart.period)

    def fit(self) -> Explanation:
        """Fit the baseline; raises InputError where it does not beat.

        Without a structural covariance the fit begins where the model may err by a smooth discrepancy: a heart far from
        the nominal one is fitted in timing first.
        """
        context, baseline = FitContext(self.data), hypothesis(self.model)
        start = baseline.at(0.0)
        if self.data.structure is None:
            rough = context.discrepancy.whitenings[-1]
            first = fit(CountedHypothesis(baseline), self.data.values, rough, start)
            start = start if first is None else first.x
        explained = context.explain(baseline, start)
        if explained is None:
            raise InputError(NO_BEAT)
        return explained


def healthy_residual(recording: Recording) -> Floats:
    """Return what the sphere leaves of a healthy heart, (2 PHASES,); raises InputError without volume and pressure."""
    missing = [curve for curve in CURVES if curve not in recording.curves]
    if missing:
        raise InputError(
            f"reference: no {' and '.join(missing)}; expected volume and pressure of every control"
        )
    problem = SphereProblem.from_recording(recording, PEOPLE.scaled_to(recording))
    left = problem.data.values - problem.fit().fit.predicted
    return problem.frame.residual(problem.data.blocks, [left[rows] for rows in problem.data.rows])


def learn_from_controls(controls: Mapping[str, Recording]) -> Structure:
    """Return the structure of what the sphere leaves of controls, by name; raises InputError that names a control."""
    residuals = []
    for name, recording in controls.items():
        try:
            residuals.append(healthy_residual(recording))
        except InputError as error:
            raise InputError(f"{name}: {error}") from error
    return Structure.from_residuals(np.array(residuals))


def learn_from_earlier(before: Recording, structure: Structure) -> tuple[NominalHeart, Structure]:
    """Return the heart that was fitted to a recording, and the discrepancy of a second recording of the same heart."""
    problem = SphereProblem.from_recording(before, structure=structure)
    data, fitted = problem.data, problem.fit().fit
    left = data.values - fitted.predicted
    levels, scale = Whitening.from_data(data).most_probable_levels(left)
    heart = replace(perturb(problem.model.nominal, fitted.x), stands_for="change")
    weights = problem.frame.weights(data.blocks)
    return heart, structure.after(weights, data.noise_covariance(levels), left, scale)
