"""What a proof makes of a diagnosis: sizes of the three-dimensional model, gains, and names that are withdrawn."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from heartfit.configuration.setting import Setting
from heartfit.diagnosis.cause import Cause, Diagnosis, Refitted, Verdict
from heartfit.proof.extension import Extension
from heartfit.proof.proof import Proof
from heartfit.proof.refit import Refit

INTERVAL = 1.96


@dataclass(frozen=True, eq=False)
class Tried:
    """An extension beside none, refitted; kept: what of it helped; simulations: beats of all refits."""

    extension: Extension
    none: Refit
    extended: Refit
    kept: tuple[str, ...]
    simulations: int

    def refitted(self, ranking: Mapping[str, float]) -> Refitted:
        """As a diagnosis tells it."""
        return Refitted(
            tuple(sized(self.extension, self.extended, ranking)),
            self.extended.log_evidence - self.none.log_evidence,
            {name: self.none.parameters[name] for name in self.extension.base.estimate},
            {name: self.extended.parameters[name] for name in self.extension.base.estimate},
            self.simulations,
            self.none.converged and self.extended.converged,
        )


def extensions_of(found: Diagnosis, base: Setting) -> list[Extension]:
    """What is tried in three dimensions, each containing the one before.

    What is named; of two the stronger alone at first, for a companion may be false; the best of a group; and where
    nothing is named the best of all, as a trial.
    """
    named = sorted(
        (each.name for each in found.mechanisms), key=lambda name: -found.ranking.get(name, np.inf)
    )
    if found.verdict == "two":
        return [Extension.by(base, *named[:count]).freeing() for count in (1, 2)]
    best = [each.name for each in found.mechanisms] or [each for each in found.ranking if each != "unknown"]
    return [Extension.by(base, best[0]).freeing()]


def proved(found: Diagnosis, tried: Tried, proof: Proof) -> Diagnosis:
    """The diagnosis with sizes and gains of the three-dimensional model, without the names that do not help."""
    refitted = tried.refitted(found.ranking) if tried.extension.added else None
    sizes = {each.name: each for each in refitted.extension} if refitted else {}
    known = replace(
        found,
        mechanisms=tuple(sizes.get(each.name, each) for each in found.mechanisms),
        gain=tuple(proof.gains()) if refitted else (),
        simulations=found.simulations + tried.simulations,
        traces=proof.traces(),
        refitted=refitted,
    )
    return keeping(known, tried.kept)


def keeping(found: Diagnosis, kept: Sequence[str]) -> Diagnosis:
    """The diagnosis with the names alone that helped; a group stands with the one of it that was tried.

    Without any something is lacking, but nothing of the library: unknown.
    """
    names = [each.name for each in found.mechanisms]
    if not names or set(names) <= set(kept) or (found.verdict == "group" and kept):
        return found
    left = tuple(each for each in found.mechanisms if each.name in kept)
    gone = names[:1] if found.verdict == "group" else [name for name in names if name not in kept]
    verdict: Verdict = "named" if left else "unknown"
    return replace(found, verdict=verdict, mechanisms=left, withdrawn=(*found.withdrawn, *gone))


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
