"""Effect of departures from the paper's unscented step on spheres of known truth, which beat in milliseconds."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np

from benchmarks.deviations_step import ADDITIVE, LOGARITHMIC, take_step, widened
from heartfit.calibration.design import Design
from heartfit.calibration.unscented import STANDARD_DESIGN, CachedForward, Forward, Scaling
from heartfit.study.study import Study
from heartfit.synthetic.known_hearts import KnownHeart, KnownHeartSampler

WIDTHS = (1.0, 2.0)
"""Spreads of hearts and prior, in those of the study: the paper's are not printed."""
SPREADS_OF_POINTS = (1.0, 0.5, 0.1)
"""Values of a, which scales the distance of the sigma points; the paper refers to weights that leave it free."""
SLOPE = 0.3
"""Slope of the length dependence of the hidden hearts of the study."""
LENGTH_DEPENDENCE = "starling.slope"


@dataclass(frozen=True)
class Score:
    """Errors of one-step calibrations of many hearts.

    observations: median and largest over the hearts of the mean unsigned error [%]; parameters: root mean
    square error of ln theta over all hearts and parameters [%]; bias: mean error of ln theta by parameter [%];
    impossible: sigma points that are not positive; lost: hearts without an estimate or without its beat.
    """

    observations: tuple[float, float]
    parameters: float
    bias: dict[str, float]
    impossible: int
    lost: int


def score(
    sampler: KnownHeartSampler,
    hearts: Sequence[KnownHeart],
    forward: Forward,
    scale: str,
    design: Design = STANDARD_DESIGN,
) -> Score:
    """Calibrate each heart by one step, simulate its estimate and compare with its observations and truth."""
    errors, offsets, impossible = [], [], 0
    for heart in hearts:
        step = take_step(sampler.prior, forward, heart.observed, scale, design)
        impossible = step.impossible
        (outcome,) = forward([step.estimate]) if step.estimate else ("no estimate",)
        if not isinstance(outcome, str):
            errors.append(
                np.mean([abs(outcome[name] / value - 1.0) for name, value in heart.observed.items()])
            )
            offsets.append(np.log([step.estimate[name] for name in sampler.prior.names]) - heart.truth)
    offset = 100.0 * np.array(offsets)
    return Score(
        (100.0 * float(np.median(errors)), 100.0 * float(np.max(errors))),
        float(np.sqrt((offset**2).mean())),
        dict(zip(sampler.prior.names, offset.mean(axis=0).tolist(), strict=True)),
        impossible,
        len(hearts) - len(errors),
    )


def scales(study: Study) -> Iterator[tuple[str, float, str, Score]]:
    """Yield observed curves, width of the prior, scale, and score of hearts that the calibrator's model resembles."""
    for observed, standard in study.known_hearts().items():
        for width in WIDTHS:
            sampler = replace(standard, prior=widened(standard.prior, width))
            hearts = [sampler.draw(number, "model") for number in range(study.sphere_study.hearts)]
            forward = CachedForward(sampler.model.observe_all)
            for scale in (LOGARITHMIC, ADDITIVE):
                yield observed, width, scale, score(sampler, hearts, forward, scale)


def weights(study: Study) -> Iterator[tuple[float, Score]]:
    """Yield the spread of the sigma points and its score, volumes observed."""
    sampler = study.known_hearts()["volume"]
    hearts = [sampler.draw(number, "model") for number in range(study.sphere_study.hearts)]
    for a in SPREADS_OF_POINTS:
        forward = CachedForward(sampler.model.observe_all)
        yield a, score(sampler, hearts, forward, LOGARITHMIC, Scaling(a=a))


def length_dependence(study: Study) -> Iterator[tuple[str, float, Score]]:
    """Yield observed curves, slope of the calibrator, and score of hearts with SLOPE; nothing else is unknown."""
    for observed, sampler in study.known_hearts().items():
        heart = sampler.model.heart.with_parameters({LENGTH_DEPENDENCE: SLOPE})
        true = replace(sampler, model=replace(sampler.model, heart=heart))
        hearts = [true.draw(number, "nothing") for number in range(study.sphere_study.hearts)]
        for slope, model in ((0.0, sampler.model), (SLOPE, true.model)):
            yield observed, slope, score(sampler, hearts, CachedForward(model.observe_all), LOGARITHMIC)
