r"""The search on a sphere that is centred on a 3-D beat, and the self-test of that sphere.

A sphere differs from ventricles in structure, and this difference looks like a damped catheter or a stiff pericardium.
Fitted once to the beat at the prior mean, without noise and with everything free, the sphere follows the beats of that
model at other parameters as well, and the search finds effects that both of them lack. A beat that the sphere cannot
follow is refused. Besides the parameters that the search leaves free, the volume of the wall and some constants of the
law are fitted, which the search then keeps.

The self-test measures the effects that a centred sphere invents in beats of the very model on which it was centred.
Nothing is hidden in the beats of sigma points, which a calibration has anyway. Recorded with noise of the middle level
at the times of the recording, they are searched:

.. math:: b = \mathrm{median}_i \max_m \ln B_m(y_i) ,

every mechanism m fitted once from the end of the baseline's fit. The number of false positives is a later and hence
poorer indicator of a badly centred sphere.
"""

from collections.abc import Collection, Mapping, Sequence
from dataclasses import replace
from functools import partial
from math import exp

import numpy as np

from heartfit.core.arrays import Floats
from heartfit.core.errors import InputError
from heartfit.discovery.inference.context import FitContext
from heartfit.discovery.inference.data import Block, Data, Noise
from heartfit.discovery.inference.decide import CENTRED_RULES, STRICT_RULES
from heartfit.discovery.inference.hypothesis import Coordinate, Hypothesis
from heartfit.discovery.inference.search import fit_from_baseline
from heartfit.discovery.sphere_model.cause import Diagnosis
from heartfit.discovery.sphere_model.diagnose import diagnose
from heartfit.discovery.sphere_model.forward_model import (
    BASE_COORDINATES,
    SphereForwardModel,
    candidates,
    hypothesis,
)
from heartfit.discovery.sphere_model.nominal_heart import ADULT, NominalHeart, perturb
from heartfit.discovery.sphere_model.recording import Recording, search_data
from heartfit.heart.heart import Heart
from heartfit.heart.sphere.heart import Inertia
from heartfit.observation.curve import Curve
from heartfit.places import Place

LARGEST_RMSE = {"lv_volume": 0.7e-6, "lv_pressure": 100.0}
"""Largest root mean square error of a sphere that follows the beat [m^3] and [Pa]."""
WALL_SD = 0.3
CONSTANT_SDS = {"c_2": 0.5, "E_s": 0.5}
"""Standard deviations of the logarithms of the wall volume and of constants of the law."""
SPHERE_CONTRACTILITY_RATIO = 0.6
"""Contractility of a sphere over that of a mesh: all fibres of a sphere pull in the plane of its wall."""
SAMPLES, ROUNDS = 60, 3
"""Samples of each curve; number of fits, each of which starts where the one before ended."""


def fit_nominal_heart(
    heart: Heart, beat: Mapping[str, Curve], recorded: Collection[str] = tuple(LARGEST_RMSE)
) -> NominalHeart:
    """Fit a nominal heart to "lv_volume" and "lv_pressure" of a beat of the heart, time zero at its trigger.

    Raises InputError where the sphere does not follow a ``recorded`` curve.
    """
    curves = {name: beat[name].resampled(SAMPLES) for name in LARGEST_RMSE}
    recording = Recording.from_curves(curves)
    data, nominal = _data(recording), _start(heart, recording)
    for _ in range(ROUNDS):  # restarts remove the shrinkage by the prior
        nominal, predicted = _fit(nominal, data)
    for block, rows in zip(data.blocks, data.rows, strict=True):
        if block.curve in recorded:
            _require_followed(block.curve, (predicted - data.values)[rows])
    return nominal


def _start(heart: Heart, recording: Recording) -> NominalHeart:
    """The heart as a sphere of an adult's proportions."""
    ratio = recording.end_diastolic_volume() / ADULT.filled
    weaker = heart.with_parameters({"sigma_0": SPHERE_CONTRACTILITY_RATIO * heart.tissue.active.sigma_0})
    return NominalHeart(weaker, ratio * ADULT.cavity, ratio * ADULT.wall, ratio * ADULT.filled, Inertia())


def _data(recording: Recording) -> Data:
    blocks = tuple(
        Block(name, "SI", samples.times, recording.period, Noise((0.5 * LARGEST_RMSE[name],), 0.0, 0.0, 0.0))
        for name, samples in recording.curves.items()
    )
    return Data(np.concatenate([samples.values for samples in recording.curves.values()]), blocks)


def _fit(nominal: NominalHeart, data: Data) -> tuple[NominalHeart, Floats]:
    times = {block.curve: block.times for block in data.blocks}
    count = len(BASE_COORDINATES)

    def forward(x: Floats) -> Floats | None:
        return hypothesis(SphereForwardModel(_with_constants(nominal, x[count:]), times)).forward(x[:count])

    more = tuple(Coordinate(name) for name in ("wall", *CONSTANT_SDS))
    with_all = Hypothesis((), BASE_COORDINATES + more, forward)
    explanation = FitContext(data).explain(with_all, with_all.at(0.0))
    if explanation is None:
        raise InputError(
            "nominal heart: the sphere does not beat about the three-dimensional heart's parameters"
        )
    x = explanation.fit.x
    return perturb(_with_constants(nominal, x[count:]), x[:count]), explanation.fit.predicted


def _with_constants(nominal: NominalHeart, x: Floats) -> NominalHeart:
    values = nominal.heart.parameters()
    pairs = zip(CONSTANT_SDS.items(), x[1:].tolist(), strict=True)
    changed = {name: values[nominal.heart.parameter_path(name)] * exp(sd * z) for (name, sd), z in pairs}
    wall = nominal.wall * exp(WALL_SD * float(x[0]))
    return replace(nominal, heart=nominal.heart.with_parameters(changed), wall=wall)


def _require_followed(curve: str, error: Floats) -> None:
    left = float(np.sqrt(np.mean(error**2)))
    if left > LARGEST_RMSE[curve]:
        raise InputError(
            f"nominal heart: the sphere leaves {left:.3g} of the beat's {curve} (root mean square, SI); "
            "expected at most "
            f"{LARGEST_RMSE[curve]:g}: it stands for another heart than this one"
        )


SELF_TEST_LIMIT = 1.5
"""ln Bayes factor of the self-test beyond which the sphere takes differences of structure for effects."""


def self_test(recording: Recording, nominal: NominalHeart, beats: Sequence[Mapping[str, Curve]]) -> float:
    """Median of the largest ln Bayes factors in beats without an effect, time zero at their triggers."""
    like, random = search_data(recording), np.random.default_rng(0)
    return float(
        np.median([largest_log_bayes_factor(recorded(like, beat, random), nominal) for beat in beats])
    )


def recorded(like: Data, beat: Mapping[str, Curve], random: np.random.Generator) -> Data:
    """Sample a beat at the times of other data and add the noise of their instruments only."""
    values = [beat[block.curve](block.times) + _noise(block, random) for block in like.blocks]
    return Data(np.concatenate(values), like.blocks)


def _noise(block: Block, random: np.random.Generator) -> Floats:
    roughness = block.noise.covariance(block.times, block.period, 0.0)
    instrument = block.noise.covariance(block.times, block.period, block.noise.middle) - roughness
    noise: Floats = np.linalg.cholesky(instrument) @ random.standard_normal(block.times.size)
    return noise


def largest_log_bayes_factor(data: Data, nominal: NominalHeart) -> float:
    """The largest ln Bayes factor of any mechanism over the baseline; infinite where the sphere does not beat."""
    model, context = (
        SphereForwardModel.at_samples(nominal, data.blocks),
        FitContext(data),
    )
    baseline = context.explain(hypothesis(model), np.zeros(len(BASE_COORDINATES)))
    if baseline is None:
        return np.inf
    fits = [
        fit_from_baseline(context, baseline, hypothesis(model, (candidate,)))
        for candidate in candidates(model).values()
    ]
    return max(single.log_evidence for single in fits if single is not None) - baseline.log_evidence


def centred_search(
    recording: Recording,
    heart: Heart,
    beats: Sequence[Mapping[str, Curve]],
    unseen: Recording | None = None,
    places: Sequence[type[Place]] = (),
    left_out: Collection[str] = (),
) -> Diagnosis:
    """The diagnosis of a recording, the sphere centred on the first of the ``beats``, which is the ``heart``'s.

    The others are of the same model at other parameters: a sphere that finds effects in them fails its self-test, and
    the threshold of a detection is raised. The same holds where the sphere does not follow the first beat well: a heart
    without an effect gave an ln Bayes factor of 6 about a sphere that followed only to 0.13 kPa, and of 15 about the
    adult's sphere. Beats without curves failed; where no sphere beats like the first one, the adult's is used. unseen,
    places, left_out: see :func:`heartfit.discovery.sphere_model.diagnose.diagnose`.
    """
    first, *others = beats
    search = partial(diagnose, recording, unseen=unseen, places=places, left_out=left_out)
    for followed, rules in ((recording.searched, CENTRED_RULES), ((), STRICT_RULES)):
        try:
            nominal = fit_nominal_heart(heart, first, followed)
        except InputError:
            continue
        sound = [beat for beat in others if beat]
        result = self_test(recording, nominal, sound) if sound else None
        applied = rules if result is None or result <= SELF_TEST_LIMIT else STRICT_RULES
        return replace(search(nominal=nominal, rules=applied), self_test=result)
    return search(rules=STRICT_RULES)
