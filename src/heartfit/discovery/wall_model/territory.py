r"""The part of the wall in which an effect of a region acts, given the data.

Fits of one effect from several angles are local maxima of one posterior. Each counts by its evidence Z,

.. math:: p(\text{segment } s \text{ affected}) = \sum_j \frac{Z_j}{\sum Z}\;
          P_j\big(w_s(\varphi, s) > \tfrac12\big),

with the angle and the share of the wall drawn from Laplace's approximation about the fit j, and w the weight of the
segment in the territory that they give.
"""

from collections.abc import Sequence

import numpy as np
from scipy.special import softmax

from heartfit.core.arrays import Floats
from heartfit.discovery.inference.evidence import Explanation
from heartfit.discovery.sphere_model.forward_model import Candidate
from heartfit.geometry.territory import territory_weights
from heartfit.roles import registered

DRAWS, SEED = 400, 20
"""Draws from the posterior of each fit, and their seed."""
AFFECTED = 0.5
"""Least weight of an affected segment."""
SHARES = ("extent", "share")
"""Names of the parameter that is the affected share of the ventricle."""


def affected_segments(angle: float, share: float) -> np.ndarray:
    """Mask (17,) of the AHA segments in a territory about an angle [rad] with a share of the ventricle."""
    affected: np.ndarray = territory_weights(angle, share)[1:] > AFFECTED
    return affected


def probability_of_segments(fits: Sequence[Explanation], name: str) -> Floats:
    """Probability (17,) that each AHA segment is affected, given that the effect ``name`` of a region is present.

    Raises KeyError if none of the fits is one of that effect.
    """
    own = [fitted for fitted in fits if fitted.effects == (name,)]
    if not own:
        raise KeyError(f"{name}: no fit of it among those of {[fitted.effects for fitted in fits]}")
    weights = softmax([fitted.log_evidence for fitted in own])
    return np.asarray(
        np.sum([w * _probability(one, name) for w, one in zip(weights, own, strict=True)], axis=0)
    )


def most_probable_angle(fits: Sequence[Explanation], name: str) -> float:
    """Angle [rad] of the best fit of an effect of a region, in [0, 2 pi)."""
    best = max((one for one in fits if one.effects == (name,)), key=lambda one: one.log_evidence)
    return _territory(best, name, best.fit.x)[0] % (2.0 * np.pi)


def _probability(fitted: Explanation, name: str) -> Floats:
    places = [fitted.fit.hypothesis.names.index(f"{name}.{unknown}") for unknown in _unknowns(name)]
    covariance = fitted.posterior.covariance[np.ix_(places, places)]
    rng = np.random.default_rng(SEED)
    x = np.tile(fitted.fit.x, (DRAWS, 1))
    x[:, places] = rng.multivariate_normal(fitted.fit.x[places], covariance, DRAWS, method="eigh")
    inside = [affected_segments(*_territory(fitted, name, draw)) for draw in x]
    return np.asarray(np.mean(inside, axis=0), np.float64)


def _territory(fitted: Explanation, name: str, x: Floats) -> tuple[float, float]:
    """Angle [rad] and share [1] of the territory at the coordinates x (d,)."""
    unknowns = _unknowns(name)
    values = {
        unknown: parameter.at(float(x[fitted.fit.hypothesis.names.index(f"{name}.{unknown}")]))
        for unknown, parameter in unknowns.items()
    }
    share = next(values[part] for part in SHARES if part in values)
    return values["angle"], float(np.clip(share, 0.0, 1.0))


def _unknowns(name: str):  # type: ignore[no-untyped-def]
    return {unknown.name: unknown for unknown in Candidate.from_mechanism(registered()[name]).unknowns}
