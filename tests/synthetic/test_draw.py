"""Hearts follow from their seed; the world defines their unknown parameters."""

import numpy as np
import pytest

from heartfit.synthetic.known_hearts import WORLDS
from heartfit.synthetic.volunteer import OTHERS
from tests.synthetic.linear import OBSERVED, linear_hearts


def test_a_heart_follows_from_its_number_and_has_one_truth_in_all_worlds() -> None:
    hearts = linear_hearts()
    drawn = [hearts.draw(3, world) for world in WORLDS]
    assert hearts.draw(3, "model").observed == drawn[2].observed
    assert all((heart.truth == drawn[0].truth).all() for heart in drawn)
    assert not np.allclose(hearts.draw(4, "nothing").truth, drawn[0].truth)
    assert drawn[0].observed != drawn[1].observed


def test_without_unknown_parameters_the_observations_are_the_model_s_plus_noise() -> None:
    hearts = linear_hearts()
    errors = []
    for number in range(200):
        drawn = hearts.draw(number, "nothing")
        (true,) = hearts.model.observe_all([hearts.prior.physical(drawn.truth)])
        errors.append([drawn.observed[name] / true[name] - 1.0 for name in OBSERVED])
    assert np.std(errors, axis=0) == pytest.approx(0.01, rel=0.12)
    assert np.sqrt(np.diag(drawn.noise)) == pytest.approx([0.01 * drawn.observed[name] for name in OBSERVED])


def test_truths_scatter_as_the_prior() -> None:
    hearts = linear_hearts()
    truths = np.array([hearts.draw(number, "nothing").truth for number in range(200)])
    assert (truths.mean(axis=0) - hearts.prior.mean) / hearts.prior.sd == pytest.approx(np.zeros(4), abs=0.2)
    assert truths.std(axis=0) == pytest.approx(hearts.prior.sd, rel=0.12)


def test_fixed_parameters_are_those_that_scatter_and_are_not_estimated() -> None:
    assert linear_hearts().fixed == OTHERS
