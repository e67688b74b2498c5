"""Hearts with and without extended filling: their indices against normal ranges, and the prior of their mechanisms.

The spheres are the nominal heart of the search, with its twenty-three unknowns drawn from their prior. The mechanisms
keep their declared values in these draws. For the prior of the mechanisms, slowness, slackening and closing rate are
drawn as well, from wide distributions; hearts whose indices all lie in their normal ranges are kept.
"""

import time
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from heartfit.calibration.plausible import Limit
from heartfit.core.arrays import Floats
from heartfit.discovery.sphere_model.forward_model import NUMERICS, Candidate
from heartfit.discovery.sphere_model.free_parameters import FREE_PARAMETERS
from heartfit.discovery.sphere_model.nominal_heart import ADULT, perturb
from heartfit.heart.beat import Beat
from heartfit.mechanisms.mitral_dynamics import MitralDynamics
from heartfit.mechanisms.relaxed_friction import RelaxedFriction
from heartfit.observation.beat import beat_curves
from heartfit.observation.curve import Curve
from heartfit.observation.filling import filling_indices
from heartfit.observation.operator import cavity_indices
from heartfit.roles import Mechanism

HEARTS: dict[str, tuple[Mechanism, ...]] = {
    "as it is": (),
    "MitralDynamics": (MitralDynamics(),),
    "RelaxedFriction": (RelaxedFriction(),),
    "both": (MitralDynamics(), RelaxedFriction()),
}
DRAWS, PRIOR_DRAWS, SEED = 200, 2000, 27
LARGEST_SLOWNESS, LARGEST_SLACKENING, CLOSING_SPREAD = 3.0, 3.0, 1.5
DECLARED = {
    "slowness": (MitralDynamics.slowness, 0.5),
    "ln closing rate": (0.0, 1.0),
    "slackening": (RelaxedFriction.slackening, 0.8),
}
"""Mean and deviation of the declared priors; of the closing rate, the logarithm over its declared value."""
REPEATS = 40
"""Beats of a sphere whose CPU times give a median."""

Indices = Mapping[str, float]


def indices(curves: Mapping[str, Curve]) -> dict[str, float]:
    """Filling indices, cavity indices and E/EDV of a beat; raises ValueError where a beat lacks one."""
    known = filling_indices(curves) | cavity_indices(curves)
    return known | {
        "E/EDV": known["E"] / known["EDV"],
        "P_max": float(curves["lv_pressure"].values.max()),
    }


def sphere_curves() -> dict[str, dict[str, Curve]]:
    """Curves of the nominal heart with each set of mechanisms."""
    return {
        name: beat_curves(ADULT.with_mechanisms(mechanisms).beat(NUMERICS))
        for name, mechanisms in HEARTS.items()
    }


def drawn_indices(count: int = DRAWS) -> dict[str, list[Indices | None]]:
    """Indices of the same draws for each set of mechanisms; None where a beat fails or lacks a phase."""
    draws = np.random.default_rng(SEED).standard_normal((count, len(FREE_PARAMETERS)))
    return {name: [_indices_at(x, mechanisms) for x in draws] for name, mechanisms in HEARTS.items()}


def _indices_at(x: Floats, mechanisms: Iterable[Mechanism]) -> Indices | None:
    try:
        return indices(beat_curves(perturb(ADULT, x).with_mechanisms(mechanisms).beat(NUMERICS)))
    except ValueError:
        return None


def holds(entry: Indices | None, limits: Sequence[Limit]) -> bool:
    """True if a beat has all its indices within the limits."""
    return entry is not None and all(limit.holds(entry[limit.quantity]) for limit in limits)


def unknowns(mechanisms: Iterable[Mechanism]) -> int:
    """Number of unknowns that mechanisms add to a hypothesis of the search."""
    return sum(len(Candidate.from_mechanism(type(mechanism)).unknowns) for mechanism in mechanisms)


Moments = tuple[float, float]
"""Mean and standard deviation."""


@dataclass(frozen=True)
class Kept:
    """A parameter as declared, in all draws and in the kept ones, and the share kept in each third of its draws."""

    parameter: str
    declared: Moments
    drawn: Moments
    kept: Moments
    shares: tuple[float, ...]

    @property
    def shift(self) -> float:
        """Distance of the kept mean from the declared one, in declared deviations."""
        return (self.kept[0] - self.declared[0]) / self.declared[1]

    @classmethod
    def from_draws(cls, parameter: str, declared: Moments, values: Floats, keep: np.ndarray) -> "Kept":
        """Summarise the values (n,) of all draws, of which ``keep`` (n,) are kept."""
        thirds = np.array_split(keep[np.argsort(values)], 3)
        shares = tuple(float(third.mean()) for third in thirds)
        return cls(parameter, declared, _moments(values), _moments(values[keep]), shares)


@dataclass(frozen=True)
class KeptPrior:
    """Parameters of the extended filling in the hearts that were kept, their number, and the correlation between the
    slowness of the valve and the slackening of the muscle.
    """

    parameters: Sequence[Kept]
    hearts: int
    correlation: float


def kept_prior(limits: Sequence[Limit], count: int = PRIOR_DRAWS) -> KeptPrior:
    """Return the parameters of the extended filling in drawn hearts whose indices lie within the limits."""
    rng = np.random.default_rng(SEED)
    draws = rng.standard_normal((count, len(FREE_PARAMETERS)))
    slowness = rng.uniform(0.0, LARGEST_SLOWNESS, count)
    closing = CLOSING_SPREAD * rng.standard_normal(count)
    slackening = rng.uniform(0.0, LARGEST_SLACKENING, count)
    values = np.column_stack([slowness, closing, slackening])
    keep = np.array(
        [holds(_indices_at(x, _mechanisms(row)), limits) for x, row in zip(draws, values, strict=True)]
    )
    parameters = [
        Kept.from_draws(name, prior, column, keep)
        for (name, prior), column in zip(DECLARED.items(), values.T, strict=True)
    ]
    return KeptPrior(parameters, int(keep.sum()), float(np.corrcoef(slowness[keep], slackening[keep])[0, 1]))


def _moments(values: Floats) -> Moments:
    return float(values.mean()), float(values.std())


def _mechanisms(row: Floats) -> tuple[Mechanism, ...]:
    slowness, closing, slackening = row.tolist()
    valve = MitralDynamics(slowness=slowness, closing=MitralDynamics.closing * float(np.exp(closing)))
    return valve, RelaxedFriction(slackening)


def sphere_costs() -> dict[str, float]:
    """CPU time [s] of the nominal heart's way to its limit cycle, alternated between the sets of mechanisms."""
    hearts = {name: ADULT.with_mechanisms(mechanisms) for name, mechanisms in HEARTS.items()}
    work = {name: lambda heart=heart: heart.beat(NUMERICS) for name, heart in hearts.items()}
    return alternated_costs(work, REPEATS)


def alternated_costs(work: Mapping[str, Callable[[], Beat]], repeats: int) -> dict[str, float]:
    """Median CPU time [s] of each simulation over the number of its beats, in turn; the first turn does not count."""
    times: dict[str, list[float]] = {name: [] for name in work}
    for turn in range(repeats + 1):
        for name, run in work.items():
            begin = time.process_time()
            beat = run()
            if turn:
                times[name].append((time.process_time() - begin) / beat.diagnostics["beats"])
    return {name: float(np.median(entries)) for name, entries in times.items()}
