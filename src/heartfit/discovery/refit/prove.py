"""Stepwise extension of a case's three-dimensional model, as long as each step improves the fit to held-out data."""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass

from heartfit.calibration.gaussian import Gaussian
from heartfit.calibration.unscented import CalibrationError
from heartfit.core.arrays import Floats
from heartfit.discovery.refit.extension import Extension
from heartfit.discovery.refit.goodness import curve_fits
from heartfit.discovery.refit.model import Model, ObservedBeat
from heartfit.discovery.refit.refit import Refit, complete_posterior, continue_refit, refit
from heartfit.discovery.refit.target import MeasuredCase, Target, sample, stack
from heartfit.discovery.refit.verdict import Proof, TriedExtension, apply_proof, propose_extensions
from heartfit.discovery.sphere_model.cause import Attempt, CurveFit, Diagnosis
from heartfit.geometry.mesh import Motion
from heartfit.personalise.setting import Setting


@dataclass(frozen=True, eq=False)
class FittedExtension:
    """An extension, its refit and the beat at the estimate of the refit."""

    extension: Extension
    refit: Refit
    shown: ObservedBeat


@dataclass(frozen=True, eq=False)
class ExtensionTrial:
    """A measured case with its registered motion, its model, and the largest number of steps of a refit.

    target: the fitted half of the samples; complete: both halves.
    """

    case: MeasuredCase
    registered: Motion
    model: Model
    setting: Setting
    target: Target
    complete: Target
    most_steps: int

    @property
    def baseline(self) -> Extension:
        """Return the baseline model, without an extension."""
        return Extension(self.setting).with_free_parameters(self.case.both)

    def refitted(self) -> Refit:
        """Return the refit of the baseline model; raises CalibrationError if too many beats fail."""
        return refit(self.baseline, self.model, self.target, self.complete, self.most_steps)

    def extended(self, extension: Extension, base: Refit) -> Refit:
        """Return the refit that starts from the base; raises CalibrationError if the beat there fails."""
        return continue_refit(extension, self.model, self.target, self.complete, self.most_steps, base)

    def at(self, extension: Extension, fitted: Refit) -> FittedExtension:
        """Return a refit with the beat at its estimate; raises CalibrationError if the beat fails."""
        beat = self.model(extension, fitted.parameters, keep_positions=True)
        if not beat.completed:
            raise CalibrationError(f"the beat at the estimate: {beat.reason}")
        return FittedExtension(extension, fitted, ObservedBeat.from_beat(beat, extension, fitted.parameters))

    def final(self, fitted: FittedExtension) -> Gaussian | None:
        """Return the coordinates given both halves of the samples; None where not all their slopes are known."""
        return complete_posterior(fitted.extension, fitted.refit, self.complete, self._predicted(fitted))

    def fits(self, fitted: FittedExtension) -> tuple[CurveFit, ...]:
        """Return the chi-squared of each curve about a refit; none where not all its slopes are known."""
        return tuple(curve_fits(fitted.refit, self.target, self.complete, self._predicted(fitted)))

    def _predicted(self, fitted: FittedExtension) -> Floats:
        return stack(sample(fitted.shown.curves, self.complete.samples))

    def proof(self, baseline: FittedExtension, extended: FittedExtension) -> Proof:
        """Return both refits with the measurement."""
        return Proof(self.case, self.model.mesh, self.registered, baseline.shown, extended.shown)

    def prove(self, diagnosis: Diagnosis, baseline: Refit) -> tuple[Diagnosis, Refit]:
        """Return the diagnosis after its proof, and the last accepted refit; baseline: the refit without an extension.

        If no extension is accepted, the last refit is that of the last trial; if all trials fail, it is the baseline.
        """
        base = self.at(self.baseline, baseline)
        steps = list(self.climb(base, propose_extensions(diagnosis, self.setting, self.case.both)))
        kept = [fit for fit, helps in steps if helps]
        shown = (kept or [fit for fit, _ in steps] or [base])[-1]
        tried = TriedExtension(
            shown.extension,
            baseline,
            shown.refit,
            kept[-1].extension.effects if kept else (),
            sum(fit.refit.simulations + 1 for fit in (base, *(fit for fit, _ in steps))),
            self.final(shown),
            self.fits(shown),
        )
        return apply_proof(diagnosis, tried, self.proof(base, shown), self.fits(base)), shown.refit

    def attempt(self, mechanism: str, baseline: Refit) -> Attempt:
        """Return the gain of one mechanism, whatever the diagnosis; raises CalibrationError if its beat fails."""
        extension = Extension.from_names(self.setting, mechanism).with_free_parameters(self.case.both)
        base = self.at(self.baseline, baseline)
        extended = self.at(extension, self.extended(extension, baseline))
        beats = baseline.simulations + extended.refit.simulations + 2
        tried = TriedExtension(
            extension, baseline, extended.refit, (), beats, self.final(extended), self.fits(extended)
        )
        proof = self.proof(base, extended)
        return Attempt(tried.refitted({}), tuple(proof.gains()), proof.traces())

    def climb(
        self, base: FittedExtension, extensions: Iterable[Extension]
    ) -> Iterator[tuple[FittedExtension, bool]]:
        """Yield refitted extensions in order and whether they help, until a beat fails or an extension does not help.

        An extension helps if it improves both the fit to held-out data and the evidence of the fitted data.
        """
        for extension in extensions:
            try:
                tried = self.at(extension, self.extended(extension, base.refit))
            except CalibrationError:
                return
            likelier = tried.refit.log_evidence > base.refit.log_evidence
            helps = likelier and self.proof(base, tried).helps()
            yield tried, helps
            if not helps:
                return
            base = tried
