"""A case's three-dimensional model extended step by step, as long as each step helps where nothing was fitted."""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace

from heartfit.calibration.unscented import CalibrationError
from heartfit.discovery.refit.model import Extension, Model, ObservedBeat
from heartfit.discovery.refit.refit import Refit, continue_refit, refit
from heartfit.discovery.refit.target import MeasuredCase, Target
from heartfit.discovery.refit.verdict import Proof, TriedExtension, apply_proof, propose_extensions
from heartfit.discovery.sphere_model.cause import Attempt, Diagnosis
from heartfit.geometry.mesh import Motion
from heartfit.personalise.setting import Setting


@dataclass(frozen=True, eq=False)
class FittedExtension:
    """An extension, its refit and the beat at the refit's estimate."""

    extension: Extension
    refit: Refit
    shown: ObservedBeat


@dataclass(frozen=True, eq=False)
class ExtensionTrial:
    """A measured case with its registered motion, the model that stands for it, and the most steps of a refit."""

    case: MeasuredCase
    registered: Motion
    model: Model
    setting: Setting
    target: Target
    most_steps: int

    @property
    def none(self) -> Extension:
        """The model as it is."""
        return Extension(self.setting).with_free_parameters()

    def refitted(self) -> Refit:
        """The model as it is after its steps; raises CalibrationError where too many beats fail."""
        return refit(self.none, self.model, self.target, self.most_steps)

    def extended(self, extension: Extension, base: Refit) -> Refit:
        """The better of two refits, from the centre of the priors and from where the model without it ended.

        A strong effect drags the model without it far off, and a weak one is found from there. Raises CalibrationError
        where too many beats fail.
        """
        both = (
            self.continue_refit(extension, base),
            refit(extension, self.model, self.target, self.most_steps),
        )
        best = min(both, key=lambda fit: fit.objective)
        return replace(best, simulations=sum(fit.simulations for fit in both))

    def continue_refit(self, extension: Extension, base: Refit) -> Refit:
        """The refit from where the model without it ended; raises CalibrationError where the beat there fails."""
        return continue_refit(extension, self.model, self.target, self.most_steps, base)

    def at(self, extension: Extension, fitted: Refit) -> FittedExtension:
        """The beat at a refit's estimate; raises CalibrationError where it fails."""
        beat = self.model(extension, fitted.parameters, keep_positions=True)
        if not beat.completed:
            raise CalibrationError(f"the beat at the estimate: {beat.reason}")
        return FittedExtension(extension, fitted, ObservedBeat.from_beat(beat, extension, fitted.parameters))

    def proof(self, none: FittedExtension, extended: FittedExtension) -> Proof:
        """Both refits beside the measurement."""
        return Proof(self.case, self.model.mesh, self.registered, none.shown, extended.shown)

    def prove(self, diagnosis: Diagnosis, none: Refit) -> tuple[Diagnosis, Refit]:
        """The diagnosis after its proof, and the last refit that was kept; none: the refit without an extension.

        Where no extension is kept the last that was tried is shown; where none of them beats, the model without.
        """
        base = self.at(self.none, none)
        steps = list(self.climb(base, propose_extensions(diagnosis, self.setting)))
        kept = [fit for fit, helps in steps if helps]
        shown = (kept or [fit for fit, _ in steps] or [base])[-1]
        tried = TriedExtension(
            shown.extension,
            none,
            shown.refit,
            kept[-1].extension.effects if kept else (),
            sum(fit.refit.simulations + 1 for fit in (base, *(fit for fit, _ in steps))),
        )
        return apply_proof(diagnosis, tried, self.proof(base, shown)), shown.refit

    def attempt(self, mechanism: str, none: Refit) -> Attempt:
        """Gain of one mechanism, whatever the search concludes; raises CalibrationError if the extended heart
        has no beat.
        """
        extension = Extension.from_names(self.setting, mechanism).with_free_parameters()
        base = self.at(self.none, none)
        extended = self.at(extension, self.continue_refit(extension, none))
        beats = none.simulations + extended.refit.simulations + 2
        tried = TriedExtension(extension, none, extended.refit, (), beats)
        proof = self.proof(base, extended)
        return Attempt(tried.refitted({}), tuple(proof.gains()), proof.traces())

    def climb(
        self, base: FittedExtension, extensions: Iterable[Extension]
    ) -> Iterator[tuple[FittedExtension, bool]]:
        """One extension after the other, until one does not beat or does not help over the one before it.

        It helps if it comes nearer to what was not fitted, and if what was fitted is evidence for it.
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
