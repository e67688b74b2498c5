"""Probability that a segment is affected, and its bull's-eye."""

import numpy as np
import pytest

from heartfit.discovery.inference.evidence import Explanation, Fit, LaplacePosterior
from heartfit.discovery.inference.hypothesis import Hypothesis
from heartfit.discovery.sphere_model.forward_model import Candidate
from heartfit.discovery.wall_model.territory import (
    affected_segments,
    most_probable_angle,
    probability_of_segments,
)
from heartfit.mechanisms.scar import Scar
from heartfit.results.bullseye import plot_bullseye

COORDINATES = Candidate.from_mechanism(Scar).coordinates()


def scar_fit(angle: float, extent: float, log_evidence: float, sd: float = 1e-4) -> Explanation:
    hypothesis = Hypothesis(("Scar",), COORDINATES, lambda x: x)
    x = np.array([extent / 0.12, (angle - 1.05) / 1.5])
    fit = Fit(hypothesis, x, np.zeros(1), np.zeros((1, 2)), 0.0, converged=True)
    return Explanation(fit, LaplacePosterior(log_evidence, x, sd**2 * np.eye(2)))


def test_a_certain_scar_is_its_territory() -> None:
    probability = probability_of_segments([scar_fit(1.05, 0.41, 0.0)], "Scar")
    assert probability == pytest.approx(affected_segments(1.05, 0.41).astype(float))
    assert set(np.flatnonzero(probability) + 1) == {1, 2, 7, 8, 13, 14, 17}


def test_fits_count_by_their_evidence() -> None:
    fits = [scar_fit(1.05, 0.3, np.log(3.0)), scar_fit(4.19, 0.3, 0.0)]
    probability = probability_of_segments(fits, "Scar")
    assert probability[6] == pytest.approx(0.75, abs=0.01)
    assert probability[9] == pytest.approx(0.25, abs=0.01)
    assert most_probable_angle(fits, "Scar") == pytest.approx(1.05)


def test_an_uncertain_angle_spreads_over_neighbours() -> None:
    sharp, blurred = (probability_of_segments([scar_fit(1.05, 0.3, 0.0, sd)], "Scar") for sd in (1e-4, 0.5))
    assert ((blurred > 0.02) & (blurred < 0.98)).sum() > ((sharp > 0.02) & (sharp < 0.98)).sum()


def test_an_effect_that_was_not_fitted_is_an_error() -> None:
    with pytest.raises(KeyError, match="DelayedActivation: no fit of it"):
        probability_of_segments([scar_fit(1.0, 0.2, 0.0)], "DelayedActivation")


def test_the_bullseye_numbers_every_segment() -> None:
    figure = plot_bullseye([("planted", np.linspace(0.0, 1.0, 17))], "lost share")
    numbers = sorted(int(text.get_text()) for text in figure.axes[0].texts)
    assert numbers == list(range(1, 18))
