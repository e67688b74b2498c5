"""The refitted model without and with an extension, judged by what was never fitted."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

import numpy as np

from heartfit.diagnosis.cause import Gain, Trace
from heartfit.diagnosis.held_out import error_ratio
from heartfit.geometry.arrays import Floats
from heartfit.geometry.mesh import VentricularMesh
from heartfit.geometry.motion import Motion
from heartfit.observation.curve import Curve
from heartfit.observation.strain import DIRECTIONS, segment_strain
from heartfit.proof.model import Shown
from heartfit.proof.target import MeasuredCase

UNSEEN = {
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
    none: Shown
    extended: Shown

    def gains(self) -> list[Gain]:
        """One for each curve of which something was not fitted, and one for the strain."""
        return [*curve_gains(self.case, self.none.curves, self.extended.curves), *self._strain_gains()]

    def _strain_gains(self) -> Iterator[Gain]:
        """Of the strain of all segments in all frames, round the heart and along it."""
        times = self.measured.times
        motions = (self.measured, *(each.motion.sampled(times) for each in (self.none, self.extended)))
        measured, *fits = (segment_strain(self.mesh, motion) for motion in motions)
        phase = np.repeat(times / self.measured.period, measured.shape[2])
        for name in STRAINS:
            direction = DIRECTIONS.index(name)
            before, after = ((measured - each)[:, direction].ravel() for each in fits)
            yield _gain(f"{name} strain", "never fitted", phase, before, after)

    def helps(self) -> bool:
        """Whether the extension comes nearer to all curves together, in units of noise, where nothing was fitted."""
        return self._unseen(self.extended) < self._unseen(self.none)

    def _unseen(self, shown: Shown) -> float:
        return sum(
            float((((held.values - shown.curves[name](held.times)) / self.case.deviation(name)) ** 2).sum())
            for name, held in self.case.split.held.items()
        )

    def traces(self) -> tuple[Trace, ...]:
        """Every measured curve beside both fits; what the model lacks is the residual of the one without."""
        return tuple(self._trace(name) for name in self.case.curves)

    def _trace(self, name: str) -> Trace:
        curve, noise = self.case.curves[name], self.case.noise[name]
        none, extended = (each.curves[name](curve.times) for each in (self.none, self.extended))
        return Trace(name, curve.times, curve.values, none, extended, noise, curve.values - none, noise)


def curve_gains(
    case: MeasuredCase, none: Mapping[str, Curve], extended: Mapping[str, Curve]
) -> Iterator[Gain]:
    """One for each curve of which something was not fitted."""
    period = case.curves["lv_volume"].period
    for name, held in case.split.held.items():
        before, after = (held.values - each[name](held.times) for each in (none, extended))
        yield _gain(name, UNSEEN[name], held.times / period, before, after)


def _gain(name: str, on: str, phase: Floats, before: Floats, after: Floats) -> Gain:
    ratio, interval = error_ratio(phase, before, after)
    none, extended = (float(np.sqrt(np.mean(each**2))) for each in (before, after))
    return Gain(name, on, none, extended, ratio, interval)
