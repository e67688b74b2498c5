"""A recording as a problem of inference, and the fit of the sphere without a mechanism."""

from dataclasses import dataclass
from functools import cached_property
from typing import Protocol

import numpy as np

from heartfit.core.errors import InputError
from heartfit.discovery.inference.context import FitContext
from heartfit.discovery.inference.data import Data
from heartfit.discovery.inference.evidence import Explanation, fit
from heartfit.discovery.inference.hypothesis import CountedHypothesis
from heartfit.discovery.sphere_model.forward_model import SphereForwardModel, hypothesis
from heartfit.discovery.sphere_model.landmarks import FINE, Frame, Landmarks
from heartfit.discovery.sphere_model.nominal_heart import ADULT, PEOPLE, WITH_RIGHT, NominalHeart
from heartfit.discovery.sphere_model.recording import BIN, Recording, averaged_by_phase, search_data

NO_BEAT = "baseline: the sphere does not beat about the nominal heart; expected it to"


class DiscrepancyPrior(Protocol):
    """Prior of a difference between the sphere and the source of a recording, which its data may hold."""

    def enter(self, problem: "SphereProblem") -> "SphereProblem":
        """Return the problem with the covariance of the discrepancy in its data."""
        ...


@dataclass(frozen=True, eq=False)
class SphereProblem:
    """A recording as a problem of inference: its data, with the structural covariance, and the forward model."""

    recording: Recording
    data: Data
    model: SphereForwardModel

    @classmethod
    def from_recording(
        cls,
        recording: Recording,
        nominal: NominalHeart | None = None,
        structure: "DiscrepancyPrior | None" = None,
    ) -> "SphereProblem":
        """Pose the problem.

        structure: of the discrepancy that the data may hold; None where the model is trusted. nominal: scaled to the
        recorded size, the ADULT of a trusted model or the middle of all PEOPLE, if None.
        """
        data = search_data(recording)
        trusted = WITH_RIGHT if "rv_volume" in recording.searched else ADULT
        middle = trusted if structure is None else PEOPLE
        model = SphereForwardModel.at_samples(nominal or middle.scaled_to(recording), data.blocks)
        problem = cls(recording, data, model)
        return problem if structure is None else structure.enter(problem)

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
