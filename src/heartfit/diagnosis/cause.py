"""What a diagnosis says: verdict, causes with their sizes, and what they gain on what was never fitted."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Literal

from heartfit.geometry.arrays import Floats
from heartfit.observation.beat_phases import BeatPhases

Verdict = Literal["none", "named", "two", "group", "unknown", "insufficient"]


@dataclass(frozen=True)
class Cause:
    """A mechanism: ln Bayes factor over none, amplitude with its 95 % interval, SI, and the unit."""

    name: str
    ln_bayes_factor: float
    amplitude: float
    unit: str
    interval: tuple[float, float]


@dataclass(frozen=True)
class Gain:
    """Root mean square errors, SI, of a held-out curve without and with the cause.

    ratio is the second over the first, with a 95 % interval over the phases of the beat; on: what was held out.
    """

    curve: str
    on: str
    none: float
    extended: float
    ratio: float
    interval: tuple[float, float]


@dataclass(frozen=True, eq=False)
class Trace:
    """A measured curve (k,), SI, beside the fitted ones without and with the cause.

    noise (k,): its standard deviation; lacking, band (k,): what the model without the cause lacks, and the standard
    deviation of that.
    """

    curve: str
    times: Floats
    measured: Floats
    none: Floats
    extended: Floats
    noise: Floats
    lacking: Floats
    band: Floats


@dataclass(frozen=True)
class Refitted:
    """The three-dimensional model without and with an extension, both fitted to half of the samples.

    extension: what was added, its sizes found anew; ln_bayes_factor: of the refits; none, extended: parameters, SI, by
    name; simulations: three-dimensional beats; converged: whether both refits came to rest.
    """

    extension: tuple[Cause, ...]
    ln_bayes_factor: float
    none: Mapping[str, float]
    extended: Mapping[str, float]
    simulations: int
    converged: bool


@dataclass(frozen=True, eq=False)
class Attempt:
    """An extension that nobody named, tried all the same: its refit, its gains, and the curves beside both fits."""

    refitted: Refitted
    gain: tuple[Gain, ...]
    traces: tuple[Trace, ...]


@dataclass(frozen=True)
class Tried:
    """A model of these effects after its fit to all samples.

    ln_evidence; negative_ln_likelihood at its most probable coordinates; unknowns: how many coordinates it has.
    """

    effects: tuple[str, ...]
    ln_evidence: float
    negative_ln_likelihood: float
    unknowns: int


@dataclass(frozen=True, eq=False)
class Diagnosis:
    """The verdict and what it rests on.

    mechanisms: what is named, all members of a group; alternatives: sets of mechanisms that the data do not tell from
    the best; threshold: the ln Bayes factor below which there is none; ranking: ln Bayes factors over none of every
    single mechanism and, as "unknown", of a discrepancy without a name; withdrawn: names that did not help on what was
    held out; refitted: the proof in three dimensions, where there was one. Without a name it is a trial of the best of
    the ranking. unsearched: curves that were recorded and not searched, and why; phases: those of the beat without a
    cause, None where a valve of it never moves; self_test: the median of the largest ln Bayes factors in beats of the
    model in which nothing is hidden, None where no sphere was centred or no such beats were at hand; tried: every model
    that was fitted, without effects, with one and with two, and samples: to how many numbers.
    """

    verdict: Verdict
    mechanisms: tuple[Cause, ...]
    alternatives: tuple[tuple[str, ...], ...]
    next_measurement: str
    gain: tuple[Gain, ...]
    simulations: int
    period: float
    threshold: float
    ranking: Mapping[str, float] = field(default_factory=dict)
    withdrawn: tuple[str, ...] = ()
    traces: tuple[Trace, ...] = ()
    refitted: Refitted | None = None
    unsearched: Mapping[str, str] = field(default_factory=dict)
    phases: BeatPhases | None = None
    self_test: float | None = None
    tried: tuple[Tried, ...] = ()
    samples: int = 0
