"""A case's three-dimensional model extended step by step, as long as each step helps where nothing was fitted."""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace

from heartfit.calibration.unscented import CalibrationError
from heartfit.configuration.setting import Setting
from heartfit.diagnosis.cause import Attempt, Diagnosis
from heartfit.geometry.motion import Motion
from heartfit.proof.extension import Extension
from heartfit.proof.model import Model, Shown
from heartfit.proof.proof import Proof
from heartfit.proof.refit import Refit, continued, refit
from heartfit.proof.split import Target
from heartfit.proof.target import MeasuredCase
from heartfit.proof.verdict import Tried, extensions_of, proved


@dataclass(frozen=True, eq=False)
class Fitted:
    """An extension, its refit and the beat at the refit's estimate."""

    extension: Extension
    refit: Refit
    shown: Shown


@dataclass(frozen=True, eq=False)
class Trial:
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
        return Extension(self.setting).freeing()

    def refitted(self) -> Refit:
        """The model as it is after its steps; raises CalibrationError where too many beats fail."""
        return refit(self.none, self.model, self.target, self.most_steps)

    def extended(self, extension: Extension, base: Refit) -> Refit:
        """The better of two refits, from the centre of the priors and from where the model without it ended.

        A strong effect drags the model without it far off, and a weak one is found from there. Raises CalibrationError
        where too many beats fail.
        """
        both = self.continued(extension, base), refit(extension, self.model, self.target, self.most_steps)
        best = min(both, key=lambda each: each.objective)
        return replace(best, simulations=sum(each.simulations for each in both))

    def continued(self, extension: Extension, base: Refit) -> Refit:
        """The refit from where the model without it ended; raises CalibrationError where the beat there fails."""
        return continued(extension, self.model, self.target, self.most_steps, base)

    def at(self, extension: Extension, fitted: Refit) -> Fitted:
        """The beat at a refit's estimate; raises CalibrationError where it fails."""
        beat = self.model(extension, fitted.parameters, keep_positions=True)
        if not beat.completed:
            raise CalibrationError(f"the beat at the estimate: {beat.reason}")
        return Fitted(extension, fitted, Shown.of(beat, extension, fitted.parameters))

    def proof(self, none: Fitted, extended: Fitted) -> Proof:
        """Both refits beside the measurement."""
        return Proof(self.case, self.model.mesh, self.registered, none.shown, extended.shown)

    def prove(self, found: Diagnosis, none: Refit) -> tuple[Diagnosis, Refit]:
        """The diagnosis after its proof, and the last refit that was kept; none: the refit without an extension.

        Where no extension is kept the last that was tried is shown; where none of them beats, the model without.
        """
        base = self.at(self.none, none)
        steps = list(self.climb(base, extensions_of(found, self.setting)))
        kept = [each for each, helps in steps if helps]
        shown = (kept or [each for each, _ in steps] or [base])[-1]
        tried = Tried(
            shown.extension,
            none,
            shown.refit,
            kept[-1].extension.effects if kept else (),
            sum(each.refit.simulations + 1 for each in (base, *(each for each, _ in steps))),
        )
        return proved(found, tried, self.proof(base, shown)), shown.refit

    def attempt(self, mechanism: str, none: Refit) -> Attempt:
        """What one mechanism gains, whatever a search says of it; raises CalibrationError where it does not beat."""
        extension = Extension.by(self.setting, mechanism).freeing()
        base = self.at(self.none, none)
        extended = self.at(extension, self.continued(extension, none))
        beats = none.simulations + extended.refit.simulations + 2
        tried = Tried(extension, none, extended.refit, (), beats)
        proof = self.proof(base, extended)
        return Attempt(tried.refitted({}), tuple(proof.gains()), proof.traces())

    def climb(self, base: Fitted, extensions: Iterable[Extension]) -> Iterator[tuple[Fitted, bool]]:
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
