r"""A heart at an earlier time: the sphere with free functions inside its equations, fitted to its recording.

The parameters x alone leave of other people's hearts what the law of the muscle and of the circulation lacks. Functions
of time at the places of :mod:`heartfit.places`, with coordinates z, take it up where it acts:

.. math:: y = f(x, z) + \epsilon, \qquad x \sim N(0, I), \quad z \sim N(0, I) .

Later the same heart has the same functions up to small changes, of which the data see

.. math:: f(x, z + s\, \zeta) \approx f(x, z) + s J \zeta, \quad \zeta \sim N(0, I), \qquad S = J J^T,
          \quad J = \partial f / \partial z ,

a structural covariance with the scales s. At another rate the functions follow the phases of the beat: those of systole
are stretched as the action potential, that of relaxation is not, and diastole takes the rest. The instruments are the
same, and so is the level of their noise.

References: Alvarez, Luengo and Lawrence 2013, doi:10.1109/TPAMI.2013.86; Kennedy and O'Hagan 2001,
doi:10.1111/1467-9868.00294.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from heartfit.core.arrays import Floats
from heartfit.core.errors import InputError
from heartfit.discovery.inference.context import FitContext
from heartfit.discovery.inference.data import Block, Data, Whitening
from heartfit.discovery.inference.evidence import Explanation
from heartfit.discovery.inference.hypothesis import Coordinate, CountedHypothesis, Hypothesis
from heartfit.discovery.sphere_model.forward_model import (
    BASE_COORDINATES,
    SphereForwardModel,
    model_hypothesis,
)
from heartfit.discovery.sphere_model.nominal_heart import PEOPLE, NominalHeart, perturb
from heartfit.discovery.sphere_model.problem import NO_BEAT, SphereProblem
from heartfit.discovery.sphere_model.recording import Recording
from heartfit.heart.heart import Heart
from heartfit.places import EARLIER_PLACES
from heartfit.places.periodic import COEFFICIENTS, PeriodicFunction
from heartfit.places.place import FunctionOfTime
from heartfit.roles import Mechanism

CHANGE_SCALES = (0.05, 0.1, 0.2)
"""s: standard deviations of a change of the functions over those of the functions, equally likely."""
FINE_LEVELS = 3
"""Number of the lowest levels of noise with which an earlier recording is fitted: at the higher ones what the law lacks
counts as noise, and the functions stay zero."""
RELAXATION = 0.12
"""Longest time after the action potential [s] at which a function keeps its course at any rate."""
SAMPLES = 400
"""Equidistant times between which a function is carried to another rate."""
FIT_LIMIT = 3000
"""Simulations after which a fit of the functions is given up."""
BASE = len(BASE_COORDINATES)


@dataclass(frozen=True, eq=False)
class EarlierHeart:
    """The fitted heart, its functions among its mechanisms.

    levels: standard deviations [SI] of the noise that are possible later, by curve.
    """

    nominal: NominalHeart
    levels: Mapping[str, tuple[float, ...]]

    @classmethod
    def from_recording(cls, recording: Recording) -> "EarlierHeart":
        """Fit the heart to a recording; raises InputError where the sphere does not beat."""
        problem = SphereProblem.from_recording(recording, PEOPLE.scaled_to(recording))
        fitted = _fit(replace(problem, data=_with_fine_levels(problem.data))).fit
        x, z = np.split(fitted.x, [BASE])
        levels, _ = Whitening.from_data(problem.data).most_probable_levels(
            problem.data.values - fitted.predicted
        )
        blocks = zip(problem.data.blocks, levels, strict=True)
        heart = perturb(problem.model.nominal, x)
        placed = heart.with_mechanisms(_standardised_places(z, heart.heart.period))
        return cls(
            replace(placed, stands_for="change"),
            {block.curve: block.noise.levels[level : level + 2] for block, level in blocks},
        )

    def at_period(self, period: float) -> NominalHeart:
        """Return the heart at another period [s], its functions stretched with the phases of the beat."""
        nominal = self.nominal.at_period(period)
        if period == self.nominal.heart.period:
            return nominal
        times = _phase_times(nominal.heart, self.nominal.heart, period * np.arange(SAMPLES) / SAMPLES)
        carried = (_carried(place, times, period) for place in _places(nominal.heart))
        return nominal.with_mechanisms(carried)

    def enter(self, problem: SphereProblem) -> SphereProblem:
        """Return the problem of a later recording, whose data may hold changes of the functions."""
        model = CountedHypothesis(_hypothesis(problem.model))
        at = np.concatenate([np.zeros(BASE), _coordinates(problem.model.nominal.heart)])
        predicted = model(at)
        if predicted is None:
            raise InputError(NO_BEAT)
        jacobian = model.jacobian(at, predicted, BASE)
        blocks = tuple(map(self._at_earlier_level, problem.data.blocks))
        data = replace(problem.data, blocks=blocks, structure=jacobian @ jacobian.T, scales=CHANGE_SCALES)
        return replace(problem, data=data)

    def _at_earlier_level(self, block: Block) -> Block:
        levels = self.levels.get(block.curve, block.noise.levels)
        return _with_levels(block, levels)


def _fit(problem: SphereProblem) -> Explanation:
    """Fit parameters and functions, from the fit of the parameters alone and from the prior mean."""
    context, hypothesis = FitContext(problem.data), _hypothesis(problem.model)
    alone, mean = problem.fit().fit.x, hypothesis.at(0.0)
    starts = (np.concatenate([alone, mean[BASE:]]), mean)
    fits = [context.explain(hypothesis, start, limit=FIT_LIMIT) for start in starts]
    completed = [explained for explained in fits if explained is not None]
    if not completed:
        raise InputError(NO_BEAT)
    return min(completed, key=lambda explained: explained.fit.objective)


def _with_fine_levels(data: Data) -> Data:
    fine = (_with_levels(block, block.noise.levels[:FINE_LEVELS]) for block in data.blocks)
    return replace(data, blocks=tuple(fine))


def _with_levels(block: Block, levels: tuple[float, ...]) -> Block:
    return replace(block, noise=replace(block.noise, levels=levels))


def _hypothesis(model: SphereForwardModel) -> Hypothesis:
    """Return the hypothesis without a mechanism whose coordinates are those of the parameters and of the functions."""
    period = model.nominal.heart.period
    functions = tuple(
        Coordinate(f"{place.__name__}.{index}") for place in EARLIER_PLACES for index in range(COEFFICIENTS)
    )

    def split(x: Floats) -> tuple[Floats, Sequence[Mechanism]]:
        return x[:BASE], _standardised_places(x[BASE:], period)

    return model_hypothesis(model, (), functions, split)


def _standardised_places(z: Floats, period: float) -> Sequence[FunctionOfTime]:
    parts = np.split(z, len(EARLIER_PLACES))
    return [place.from_standardised(part, period) for place, part in zip(EARLIER_PLACES, parts, strict=True)]


def _places(heart: Heart) -> Sequence[FunctionOfTime]:
    """Return the places of a heart in the order of EARLIER_PLACES."""
    present = {type(one): one for one in heart.mechanisms if isinstance(one, FunctionOfTime)}
    return [present[place] for place in EARLIER_PLACES]


def _coordinates(heart: Heart) -> Floats:
    return np.concatenate([place.standardised() for place in _places(heart)])


def _carried(place: FunctionOfTime, times: Floats, period: float) -> FunctionOfTime:
    """Return a place of a period [s] with the values that its function has at ``times`` of its own period [s]."""
    return type(place)(PeriodicFunction.from_samples(place.function.at(times), period))


def _phase_times(heart: Heart, other: Heart, times: Floats) -> Floats:
    """Times (k,) [s] at which another heart is at the phases of a heart at ``times`` (k,) [s]."""
    return np.interp(times, _phase_bounds(heart), _phase_bounds(other))


def _phase_bounds(heart: Heart) -> Floats:
    """Begin of atrial systole, activation, end of the action potential, of relaxation, and of the beat [s]."""
    control = heart.tissue.control
    end = control.onset + control.duration
    relaxed = end + min(RELAXATION, 0.5 * (heart.period - end))
    return np.array([0.0, control.onset, end, relaxed, heart.period])
