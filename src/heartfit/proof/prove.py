"""A diagnosis extended to three dimensions: what was named is refitted, and withdrawn where it does not help."""

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np

from heartfit.calibration.unscented import CalibrationError
from heartfit.configuration.setting import Setting
from heartfit.diagnosis.cause import Cause, Diagnosis
from heartfit.geometry.motion import Motion
from heartfit.proof.extension import Extension
from heartfit.proof.model import Model, Shown
from heartfit.proof.proof import Proof
from heartfit.proof.refit import Refit, Target, refit
from heartfit.proof.target import MeasuredCase

INTERVAL = 1.96


@dataclass(frozen=True, eq=False)
class Trial:
    """A measured case with its registered motion, the model that stands for it, and how many steps a refit takes."""

    case: MeasuredCase
    registered: Motion
    model: Model
    setting: Setting
    target: Target
    steps: int

    def refitted(self, extension: Extension) -> Refit:
        """The extension after its steps; raises CalibrationError where too many beats fail."""
        return refit(extension, self.model, self.target, self.steps)

    def shown(self, extension: Extension, fitted: Refit) -> Shown:
        """The beat at a refit's estimate."""
        return Shown.of(
            self.model(extension, fitted.parameters, keep_positions=True), extension, fitted.parameters
        )

    def proof(self, none: Refit, extension: Extension, extended: Refit) -> Proof:
        """Both refits beside the measurement."""
        both = self.shown(Extension(self.setting), none), self.shown(extension, extended)
        return Proof(self.case, self.model.mesh, self.registered, *both)

    def prove(self, found: Diagnosis, none: Refit) -> tuple[Diagnosis, Refit]:
        """The diagnosis after its proof, and the refit of the extension; none: the refit without one.

        An extension whose refit fails is withdrawn: what does not beat is no cause.
        """
        extension = extension_of(found, self.setting)
        try:
            extended = self.refitted(extension)
        except CalibrationError:
            return withdrawing(found, extension), none
        proof = self.proof(none, extension, extended)
        return proved(found, extension, (none, extended), proof), extended


def extension_of(found: Diagnosis, base: Setting) -> Extension:
    """What is tried in three dimensions: what is named, the best of a group, or the best of all if nothing is."""
    named = [each.name for each in found.mechanisms]
    first = [name for name in found.ranking if name != "unknown"][:1]
    return Extension.by(base, *(named if found.verdict == "two" else named[:1] or first))


def proved(found: Diagnosis, extension: Extension, refits: tuple[Refit, Refit], proof: Proof) -> Diagnosis:
    """The diagnosis with sizes and gains of the three-dimensional model; a name that does not help is withdrawn.

    refits: without and with the extension.
    """
    sizes = {each.name: each for each in sized(extension, refits[1], found.ranking)}
    known = replace(
        found,
        mechanisms=tuple(sizes.get(each.name, each) for each in found.mechanisms),
        gain=tuple(proof.gains()),
        simulations=found.simulations + sum(each.simulations for each in refits),
        traces=proof.traces(),
    )
    return known if proof.helps() else withdrawing(known, extension)


def withdrawing(found: Diagnosis, extension: Extension) -> Diagnosis:
    """The diagnosis without the names of the extension: something is lacking, but not this."""
    if not found.mechanisms:
        return found
    return replace(found, verdict="unknown", mechanisms=(), withdrawn=(*found.withdrawn, *extension.effects))


def sized(extension: Extension, fitted: Refit, ranking: Mapping[str, float]) -> list[Cause]:
    """The amplitudes of an extension, with their 95 % intervals, and the evidence that the search gave each."""
    found = []
    for each in extension.added:
        switch = each.unknowns[0]
        place = fitted.names.index(f"{each.name}.{switch.name}")
        x, reach = float(fitted.estimate[place]), INTERVAL * float(fitted.sd[place])
        amplitude, low, high = (switch.at(value) for value in (x, x - reach, x + reach))
        found.append(Cause(each.name, ranking.get(each.name, np.nan), amplitude, switch.unit, (low, high)))
    return found
