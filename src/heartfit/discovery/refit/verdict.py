"""The refitted model without and with an extension, judged by samples that the refit did not use."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from heartfit.core.arrays import Floats
from heartfit.discovery.inference.decide import Verdict
from heartfit.discovery.refit.model import Extension, ObservedBeat
from heartfit.discovery.refit.refit import Refit
from heartfit.discovery.refit.target import MeasuredCase
from heartfit.discovery.sphere_model.cause import Cause, Diagnosis, Gain, Refitted, Trace
from heartfit.discovery.sphere_model.held_out import error_ratio
from heartfit.geometry.mesh import Motion, VentricularMesh
from heartfit.observation.curve import Curve
from heartfit.observation.strain import DIRECTIONS, segment_strain
from heartfit.personalise.setting import Setting

HELD_OUT_NOTES = {
    "lv_volume": "frames that were not fitted",
    "lv_pressure": "every other 40 ms, which were not fitted",
    "rv_volume": "never fitted",
}
STRAINS = ("circumferential", "longitudinal")


@dataclass(frozen=True, eq=False)
class Proof:
    """A measured case, its mesh and registered motion, beside the refitted model without and with the extension."""

    case: MeasuredCase
    mesh: VentricularMesh
    measured: Motion
    none: ObservedBeat
    extended: ObservedBeat

    def gains(self) -> list[Gain]:
        """One for each curve of which something was not fitted, and one for the strain."""
        return [*curve_gains(self.case, self.none.curves, self.extended.curves), *self._strain_gains()]

    def _strain_gains(self) -> Iterator[Gain]:
        """Error ratio of the strain of all segments in all frames, circumferential and longitudinal."""
        times = self.measured.times
        motions = (self.measured, *(item.motion.resample(times) for item in (self.none, self.extended)))
        measured, *fits = (segment_strain(self.mesh, motion) for motion in motions)
        phase = np.repeat(times / self.measured.period, measured.shape[2])
        for name in STRAINS:
            direction = DIRECTIONS.index(name)
            before, after = ((measured - item)[:, direction].ravel() for item in fits)
            yield _gain(f"{name} strain", "never fitted", phase, before, after)

    def helps(self) -> bool:
        """Return True if the extension is nearer to all held-out curves together, in units of noise."""
        return self._unseen(self.extended) < self._unseen(self.none)

    def _unseen(self, shown: ObservedBeat) -> float:
        return sum(
            float((((held.values - shown.curves[name](held.times)) / self.case.deviation(name)) ** 2).sum())
            for name, held in self.case.split.held.items()
        )

    def traces(self) -> tuple[Trace, ...]:
        """Every measured curve beside both fits; what the model lacks is the residual of the one without."""
        return tuple(self._trace(name) for name in self.case.curves)

    def _trace(self, name: str) -> Trace:
        curve, noise = self.case.curves[name], self.case.noise[name]
        none, extended = (item.curves[name](curve.times) for item in (self.none, self.extended))
        return Trace(name, curve.times, curve.values, none, extended, noise, curve.values - none, noise)


def curve_gains(
    case: MeasuredCase, none: Mapping[str, Curve], extended: Mapping[str, Curve]
) -> Iterator[Gain]:
    """One for each curve of which something was not fitted."""
    period = case.curves["lv_volume"].period
    for name, held in case.split.held.items():
        before, after = (held.values - item[name](held.times) for item in (none, extended))
        yield _gain(name, HELD_OUT_NOTES[name], held.times / period, before, after)


def _gain(name: str, on: str, phase: Floats, before: Floats, after: Floats) -> Gain:
    ratio, interval = error_ratio(phase, before, after)
    none, extended = (float(np.sqrt(np.mean(item**2))) for item in (before, after))
    return Gain(name, on, none, extended, ratio, interval)


Z_95 = 1.96


@dataclass(frozen=True, eq=False)
class TriedExtension:
    """An extension beside none, refitted; kept: what of it helped; simulations: beats of all refits."""

    extension: Extension
    none: Refit
    extended: Refit
    kept: tuple[str, ...]
    simulations: int

    def refitted(self, ranking: Mapping[str, float]) -> Refitted:
        """As a diagnosis tells it."""
        return Refitted(
            tuple(causes_of(self.extension, self.extended, ranking)),
            self.extended.log_evidence - self.none.log_evidence,
            {name: self.none.parameters[name] for name in self.extension.base.estimate},
            {name: self.extended.parameters[name] for name in self.extension.base.estimate},
            self.simulations,
            self.none.converged and self.extended.converged,
        )


def propose_extensions(diagnosis: Diagnosis, base: Setting) -> list[Extension]:
    """Extensions to try in three dimensions, each of which contains the one before.

    What is named; of two the stronger alone at first, for a companion may be false; the best of a group; and where
    nothing is named the best of all, as a trial.
    """
    named = sorted(
        (item.name for item in diagnosis.mechanisms), key=lambda name: -diagnosis.ranking.get(name, np.inf)
    )
    if diagnosis.verdict == "two":
        return [Extension.from_names(base, *named[:count]).with_free_parameters() for count in (1, 2)]
    best = [item.name for item in diagnosis.mechanisms] or [
        item for item in diagnosis.ranking if item != "unknown"
    ]
    return [Extension.from_names(base, best[0]).with_free_parameters()]


def apply_proof(diagnosis: Diagnosis, tried: TriedExtension, proof: Proof) -> Diagnosis:
    """The diagnosis with sizes and gains of the three-dimensional model, without the names that do not help."""
    refitted = tried.refitted(diagnosis.ranking) if tried.extension.added else None
    sizes = {item.name: item for item in refitted.extension} if refitted else {}
    known = replace(
        diagnosis,
        mechanisms=tuple(sizes.get(item.name, item) for item in diagnosis.mechanisms),
        gain=tuple(proof.gains()) if refitted else (),
        simulations=diagnosis.simulations + tried.simulations,
        traces=proof.traces(),
        refitted=refitted,
    )
    return withdraw_unhelpful(known, tried.kept)


def withdraw_unhelpful(diagnosis: Diagnosis, kept: Sequence[str]) -> Diagnosis:
    """The diagnosis with the names alone that helped; a group stands with the one of it that was tried.

    Without any something is lacking, but nothing of the library: unknown.
    """
    names = [item.name for item in diagnosis.mechanisms]
    if not names or set(names) <= set(kept) or (diagnosis.verdict == "group" and kept):
        return diagnosis
    left = tuple(item for item in diagnosis.mechanisms if item.name in kept)
    withdrawn_names = (
        names[:1] if diagnosis.verdict == "group" else [name for name in names if name not in kept]
    )
    verdict: Verdict = "named" if left else "unknown"
    return replace(
        diagnosis, verdict=verdict, mechanisms=left, withdrawn=(*diagnosis.withdrawn, *withdrawn_names)
    )


def causes_of(extension: Extension, fitted: Refit, ranking: Mapping[str, float]) -> list[Cause]:
    """The amplitudes of an extension, with their 95 % intervals, and the evidence that the search gave each."""
    diagnosis = []
    for item in extension.added:
        switch = item.unknowns[0]
        place = fitted.names.index(f"{item.name}.{switch.name}")
        x, reach = float(fitted.estimate[place]), Z_95 * float(fitted.sd[place])
        amplitude, low, high = (switch.at(value) for value in (x, x - reach, x + reach))
        diagnosis.append(
            Cause(item.name, ranking.get(item.name, np.nan), amplitude, switch.unit, (low, high))
        )
    return diagnosis
