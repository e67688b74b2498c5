"""Comparison of the refitted model without and with an extension on held-out samples."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from heartfit.calibration.gaussian import Gaussian
from heartfit.core.arrays import Floats
from heartfit.discovery.inference.decide import Verdict
from heartfit.discovery.inference.error_ratio import error_ratio
from heartfit.discovery.refit.extension import Extension
from heartfit.discovery.refit.model import ObservedBeat
from heartfit.discovery.refit.refit import Refit
from heartfit.discovery.refit.target import MeasuredCase
from heartfit.discovery.sphere_model.cause import Cause, CurveFit, Diagnosis, Gain, Refitted, Trace
from heartfit.discovery.sphere_model.misfit import deviation_of_means, phase_names
from heartfit.discovery.sphere_model.recording import Samples
from heartfit.geometry.mesh import Motion, VentricularMesh
from heartfit.observation.beat import BeatPhases
from heartfit.observation.curve import Curve
from heartfit.observation.strain import DIRECTIONS, segment_strain
from heartfit.personalise.setting import Setting

HELD_OUT_NOTES = {
    "lv_volume": "frames that were not fitted",
    "lv_pressure": "every other 40 ms, which were not fitted",
    "rv_volume": "frames that were not fitted",
}
STRAINS = ("circumferential", "longitudinal")


@dataclass(frozen=True, eq=False)
class Proof:
    """A measured case, its mesh and registered motion, and the refitted model without and with the extension."""

    case: MeasuredCase
    mesh: VentricularMesh
    measured: Motion
    baseline: ObservedBeat
    extended: ObservedBeat

    def gains(self) -> list[Gain]:
        """Return the gains on the held-out part of each curve and on the strain."""
        return [*curve_gains(self.case, self.baseline.curves, self.extended.curves), *self.strain_gains]

    @cached_property
    def strain_gains(self) -> tuple[Gain, ...]:
        """Gains on circumferential and longitudinal strain over all segments and frames."""
        return tuple(self._strain_gains())

    def _strain_gains(self) -> Iterator[Gain]:
        times = self.measured.times
        simulated = (beat.motion.resample(times) for beat in (self.baseline, self.extended))
        motions = (self.measured, *simulated)
        measured, *fits = (segment_strain(self.mesh, motion) for motion in motions)
        frames = np.repeat(times, measured.shape[2])
        for name in STRAINS:
            direction = DIRECTIONS.index(name)
            before, after = ((measured - strain)[:, direction].ravel() for strain in fits)
            yield _gain(f"{name} strain", "never fitted", frames, before, after)

    def helps(self) -> bool:
        r"""Return True if the extension brings all held-out curves and the strain together nearer to the measurement.

        .. math:: \sum_c \frac{e_c^2 - b_c^2}{\sigma_c^2 + b_c^2} < 0

        with the mean square errors b without and e with the extension, and the noise sigma. A curve that the model
        misses by far without the extension is no better known than this miss, so it does not outvote the others. The
        strain of the wall, one registered motion, has one vote: the mean over its directions, b being its noise, too.
        """
        curves = sum(self._relative_change(name, held) for name, held in self.case.split.held.items())
        strain = [gain.ratio**2 - 1.0 for gain in self.strain_gains]
        return curves + float(np.mean(strain)) < 0.0

    def _relative_change(self, name: str, held: Samples) -> float:
        before, after = (
            float(np.mean((held.values - beat.curves[name](held.times)) ** 2))
            for beat in (self.baseline, self.extended)
        )
        return (after - before) / (self.case.deviation(name) ** 2 + before)

    def traces(self, phases: BeatPhases | None = None) -> tuple[Trace, ...]:
        """Return each measured curve with both fits; phases: of the beat, over which residuals are averaged."""
        return tuple(self._trace(name, phases) for name in self.case.curves)

    def _trace(self, name: str, phases: BeatPhases | None) -> Trace:
        curve = self.case.curves[name]
        baseline, extended = (beat.curves[name](curve.times) for beat in (self.baseline, self.extended))
        noise = self.case.covariance({name: Samples.from_curve(curve)})
        means = deviation_of_means(noise, phase_names(curve.times, curve.period, phases))
        sd = self.case.noise[name]
        return Trace(name, curve.times, curve.values, baseline, extended, sd, None, None, mean_noise=means)


def curve_gains(
    case: MeasuredCase, baseline: Mapping[str, Curve], extended: Mapping[str, Curve]
) -> Iterator[Gain]:
    """Yield the gain on the held-out part of each curve."""
    for name, held in case.split.held.items():
        before, after = (held.values - curves[name](held.times) for curves in (baseline, extended))
        yield _gain(name, HELD_OUT_NOTES[name], held.times, before, after)


def _gain(name: str, on: str, times: Floats, before: Floats, after: Floats) -> Gain:
    ratio, interval = error_ratio(times, before, after)
    baseline, extended = (float(np.sqrt(np.mean(error**2))) for error in (before, after))
    return Gain(name, on, baseline, extended, ratio, interval)


Z_95 = 1.96


@dataclass(frozen=True, eq=False)
class TriedExtension:
    """Refits of the baseline and of an extension; kept: effects that helped; simulations: beats of all refits.

    final: coordinates of the extension given both halves of the samples, None where they are not known; fits: of the
    curves about the extension.
    """

    extension: Extension
    baseline: Refit
    extended: Refit
    kept: tuple[str, ...]
    simulations: int
    final: Gaussian | None = None
    fits: tuple[CurveFit, ...] = ()

    def refitted(self, ranking: Mapping[str, float]) -> Refitted:
        """Return the result in the form of a diagnosis; ranking: evidence of each mechanism in the search."""
        return Refitted(
            tuple(causes_of(self.extension, self.extended.posterior, ranking)),
            self.extended.log_evidence - self.baseline.log_evidence,
            {name: self.baseline.parameters[name] for name in self.extension.base.estimate},
            {name: self.extended.parameters[name] for name in self.extension.base.estimate},
            self.simulations,
            self.baseline.converged and self.extended.converged,
            tuple(causes_of(self.extension, self.final, ranking)) if self.final else (),
            self.fits,
        )


def propose_extensions(diagnosis: Diagnosis, base: Setting, both: bool = False) -> list[Extension]:
    """Return the extensions to refit in three dimensions, each of which contains the previous one; both: ventricles.

    They consist of the named mechanisms or, without any, of the candidate; of two, the stronger one is tried alone
    first, because the second may be false. Of a group the best is tried, and for an unknown effect without a candidate
    the best of the ranking. Where the simulation explains the recording nothing is tried.
    """
    leading = [cause.name for cause in diagnosis.mechanisms or _candidates(diagnosis)]
    if diagnosis.verdict in ("none", "insufficient") and not leading:
        return []
    if len(leading) == 2 and diagnosis.verdict != "group":
        leading.sort(key=lambda name: -diagnosis.ranking.get(name, np.inf))
        return [Extension.from_names(base, *leading[:count]).with_free_parameters(both) for count in (1, 2)]
    best = leading or [name for name in diagnosis.ranking if name != "unknown"]
    return [Extension.from_names(base, best[0]).with_free_parameters(both)]


def _candidates(diagnosis: Diagnosis) -> tuple[Cause, ...]:
    return diagnosis.candidate.causes if diagnosis.candidate else ()


def apply_proof(
    diagnosis: Diagnosis, tried: TriedExtension, proof: Proof, fits: Sequence[CurveFit] = ()
) -> Diagnosis:
    """Return the diagnosis with amplitudes and gains in three dimensions, without mechanisms that do not help.

    fits: of the curves about the model without an extension.
    """
    refitted = tried.refitted(diagnosis.ranking) if tried.extension.added else None
    causes = {cause.name: cause for cause in refitted.extension} if refitted else {}
    candidate = tuple(causes.get(cause.name, cause) for cause in _candidates(diagnosis))
    known = replace(
        diagnosis,
        mechanisms=tuple(
            replace(causes.get(cause.name, cause), ln_bayes_factor=cause.ln_bayes_factor)
            for cause in diagnosis.mechanisms
        ),
        candidate=diagnosis.candidate and replace(diagnosis.candidate, causes=candidate),
        gain=tuple(proof.gains()) if refitted else (),
        simulations=diagnosis.simulations + tried.simulations,
        traces=proof.traces(diagnosis.phases),
        refitted=refitted,
        model="3-D heart",
        free_parameters=len(tried.baseline.names),
        fits=tuple(fits),
    )
    return withdraw_unhelpful(known, tried.kept)


def withdraw_unhelpful(diagnosis: Diagnosis, kept: Sequence[str]) -> Diagnosis:
    """Return the diagnosis with only the mechanisms that helped; a group is kept if the tried member helped.

    Without any, the verdict is unknown: the missing effect is not in the library.
    """
    names = [cause.name for cause in diagnosis.mechanisms]
    if not names or set(names) <= set(kept) or (diagnosis.verdict == "group" and kept):
        return diagnosis
    left = tuple(
        replace(cause, ln_bayes_factor=diagnosis.ranking.get(cause.name, cause.ln_bayes_factor))
        for cause in diagnosis.mechanisms
        if cause.name in kept
    )
    withdrawn_names = (
        names[:1] if diagnosis.verdict == "group" else [name for name in names if name not in kept]
    )
    verdict: Verdict = "named" if left else "unknown"
    return replace(
        diagnosis, verdict=verdict, mechanisms=left, withdrawn=(*diagnosis.withdrawn, *withdrawn_names)
    )


def causes_of(extension: Extension, posterior: Gaussian, ranking: Mapping[str, float]) -> list[Cause]:
    """Return the amplitudes of an extension with 95 % intervals and the evidence of each in the search.

    posterior: of the coordinates of the extension.
    """
    causes = []
    for effect in extension.added:
        switch = effect.unknowns[0]
        place = posterior.names.index(f"{effect.name}.{switch.name}")
        x, reach = float(posterior.mean[place]), Z_95 * float(posterior.sd[place])
        amplitude, low, high = (switch.at(value) for value in (x, x - reach, x + reach))
        causes.append(
            Cause(effect.name, ranking.get(effect.name, np.nan), amplitude, switch.unit, (low, high))
        )
    return causes
