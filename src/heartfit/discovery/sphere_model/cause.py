"""The result of a diagnosis: verdict, causes with their sizes, and their gains on held-out samples."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Literal

from heartfit.core.arrays import Floats
from heartfit.discovery.inference.decide import BesideProcess, Verdict
from heartfit.discovery.inference.margin import Margin
from heartfit.discovery.sphere_model.strokes import Strokes
from heartfit.observation.beat import BeatPhases
from heartfit.places import Region


@dataclass(frozen=True)
class Cause:
    """A mechanism: ln Bayes factor over the baseline, amplitude [unit] and its 95 % interval."""

    name: str
    ln_bayes_factor: float
    amplitude: float
    unit: str
    interval: tuple[float, float]

    def __str__(self) -> str:
        low, high = self.interval
        return (
            f"{self.name} {self.amplitude:.3g} {self.unit} ({low:.3g} to {high:.3g}), "
            f"ln Bayes factor {self.ln_bayes_factor:.1f}"
        )

    def __repr__(self) -> str:
        return f"Cause({self})"


@dataclass(frozen=True)
class UnnamedCandidate:
    """The leading explanation, one mechanism or two, that is detected but not better enough than the process."""

    causes: tuple[Cause, ...]
    beside_process: BesideProcess


@dataclass(frozen=True)
class Gain:
    """Root mean square errors [SI] of a held-out curve: ``none`` without and ``extended`` with the cause.

    ratio: extended over none, with its 95 % interval; on: description of the held-out data.
    """

    curve: str
    on: str
    none: float
    extended: float
    ratio: float
    interval: tuple[float, float]

    @property
    def objects(self) -> bool:
        """True if the cause makes the curve worse beyond chance."""
        return self.interval[0] > 1.0


SMALLEST_P = 0.01
"""Probability of a larger chi-squared below which a model misses a curve by more than its noise."""


@dataclass(frozen=True)
class CurveFit:
    """Chi-squared of all samples of a curve about a refit, its degrees of freedom, and the probability p of more."""

    curve: str
    chi_squared: float
    freedom: float
    p: float

    @property
    def within_noise(self) -> bool:
        """True if the model misses the curve by no more than its noise."""
        return self.p > SMALLEST_P


@dataclass(frozen=True, eq=False)
class Trace:
    """A measured curve (k,) [SI] and the fitted ones: ``none`` without and ``extended`` with the cause.

    noise (k,): standard deviation of the samples; lacking, band (k,): GP discrepancy that the search fits in place of
    the cause, and its standard deviation, no residual of a curve shown; None where none was fitted; structure (k,):
    standard deviation that the structural covariance allows the model, at the most probable scale, None where the model
    is trusted; mean_noise (k,): standard deviation of the mean over all samples in the phase of each, None where the
    samples err independently.
    """

    curve: str
    times: Floats
    measured: Floats
    none: Floats
    extended: Floats
    noise: Floats
    lacking: Floats | None
    band: Floats | None
    structure: Floats | None = None
    mean_noise: Floats | None = None


@dataclass(frozen=True)
class RankedLaw:
    """A law that the function of a place may follow: its size [unit], its shape and formula (LaTeX).

    ln_likelihood: minus that of the best law, along the posterior of the function.
    """

    name: str
    formula: str
    size: float
    unit: str
    ln_likelihood: float
    shape: Mapping[str, float]


@dataclass(frozen=True)
class ActingPlace:
    """A region on which something acts that the library lacks, by its best place.

    slot: words for the slot of that place; ln_bayes_factor: over the model without it; spans: phases in which the
    function of time is clear; laws: what it may follow, the best first.
    """

    region: Region
    place: str
    slot: str
    ln_bayes_factor: float
    spans: "tuple[ClearSpan, ...]" = ()
    laws: tuple[RankedLaw, ...] = ()


@dataclass(frozen=True)
class ClearSpan:
    """A span [s after the trigger] in which a function is clear, with its largest value there and its deviation."""

    start: float
    end: float
    size: float
    sd: float
    unit: str


@dataclass(frozen=True, eq=False)
class PlaceFunction:
    """A function at a place [unit] at ``times`` (k,) [s after the trigger]: mean, deviation and best law (k,)."""

    region: Region
    unit: str
    times: Floats
    mean: Floats
    sd: Floats
    law: Floats


@dataclass(frozen=True)
class Change:
    """A parameter after over before, with its 95 % interval: a ratio or, in s or 1, a difference."""

    name: str
    value: float
    interval: tuple[float, float]
    unit: Literal["ratio", "s", "1"]


@dataclass(frozen=True)
class Refitted:
    """The 3-D model without (``none``) and with an extension (``extended``), both fitted to half of the samples.

    extension: the added causes with refitted amplitudes; ln_bayes_factor: of the two refits; none, extended: parameters
    [SI] by name; simulations: number of 3-D beats; converged: both refits converged; from_all_samples: the added causes
    with their amplitudes given both halves of the samples, after the second has judged; empty where not computed. fits:
    of the curves about the extended model, empty where not all slopes are known.
    """

    extension: tuple[Cause, ...]
    ln_bayes_factor: float
    none: Mapping[str, float]
    extended: Mapping[str, float]
    simulations: int
    converged: bool
    from_all_samples: tuple[Cause, ...] = ()
    fits: tuple[CurveFit, ...] = ()


@dataclass(frozen=True, eq=False)
class Attempt:
    """A trial of an extension that the search did not name: its refit, its gains, and the curves with both fits."""

    refitted: Refitted
    gain: tuple[Gain, ...]
    traces: tuple[Trace, ...]


@dataclass(frozen=True)
class FittedModel:
    """A model of these effects after its fit to the searched samples.

    negative_ln_likelihood: at its most probable coordinates; unknowns: number of coordinates.
    """

    effects: tuple[str, ...]
    ln_evidence: float
    negative_ln_likelihood: float
    unknowns: int


ShownModel = Literal["sphere", "3-D heart"]
"""The model of the search, or the refitted one."""


@dataclass(frozen=True, eq=False, repr=False)
class Diagnosis:
    """The verdict and its grounds.

    - mechanisms: the named causes, all members of a group, with their sizes in the samples that chose them;
      alternatives: sets of mechanisms that the data cannot tell from the best; withdrawn: names that did not help on
      held-out data.
    - threshold: the least ln Bayes factor of a detection; ranking: ln Bayes factors over the baseline of every single
      mechanism and, as "unknown", of a GP discrepancy.
    - candidate: the leading explanation where it is detected but not named, None otherwise.
    - refitted: the proof in three dimensions, if there is one; without a named cause, a trial of the candidate or, if
      there is none, of the best of the ranking.
    - unsearched: recorded curves that are not searched, with the reason; phases: of the beat without a cause,
      None where one of its valves never moves.
    - self_test: median of the largest ln Bayes factors in beats of the model without a hidden effect, None where no
      sphere was centred or no such beats exist.
    - tried: every fitted model, without effects, with one and with two; samples: number of data that they were fitted
      to.
    - from_all_samples: the mechanisms with their amplitudes given both halves of the recording, after the second has
      judged; empty where there is one half only.
    - structural_scale: the most probable scale of the structural covariance given the baseline, 0 where the model is
      trusted; changes: parameters that changed since an earlier recording of the same heart, empty without one.
    - acting: of an unknown effect the regions on which it may act, the most probable first; functions: what acts there,
      one for each; both empty where no place is detected.
    - strokes: of both ventricles, None without a right volume.
    - read_twice: standard deviation of the noise [SI] of curves that were read twice.
    - model, free_parameters: whose curves the traces show, and how many parameters it has free without a cause, 0 where
      it is not told.
    - warnings: numbers of the recording outside the range of living ventricles, and parameters that were fitted far
      outside their priors, and scales that decide the finding, one sentence each.
    - margin: the smallest change of one ln Z that changes the decision of the search; None if it is not close.
    - fits: of the curves about the 3-D model without a cause, empty where none was refitted.
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
    tried: tuple[FittedModel, ...] = ()
    samples: int = 0
    from_all_samples: tuple[Cause, ...] = ()
    warnings: tuple[str, ...] = ()
    structural_scale: float = 0.0
    changes: tuple[Change, ...] = ()
    acting: tuple[ActingPlace, ...] = ()
    functions: tuple[PlaceFunction, ...] = ()
    strokes: Strokes | None = None
    read_twice: Mapping[str, float] = field(default_factory=dict)
    model: ShownModel = "sphere"
    free_parameters: int = 0
    candidate: UnnamedCandidate | None = None
    fits: tuple[CurveFit, ...] = ()
    margin: Margin | None = None

    @property
    def named(self) -> tuple[Cause, ...]:
        """The mechanisms with the one size that the card states of each: from all samples where it was computed."""
        return self.with_stated_sizes(self.mechanisms)

    def with_stated_sizes(self, causes: Sequence[Cause]) -> tuple[Cause, ...]:
        """Return causes with the size of the 3-D model where there was a refit, from all samples where computed."""
        stated = {cause.name: cause for cause in (self.refitted or self).from_all_samples}
        return tuple(stated.get(cause.name, cause) for cause in causes)

    def __repr__(self) -> str:
        return f"Diagnosis({', '.join([self.verdict, *map(str, self.named)])})"


CLEAR_DEVIATIONS = 2.0
"""Standard deviations from which a change or a function of time is clear."""
