"""Hearts follow from their seed, and what is unknown of them is what the world says."""

import numpy as np
import pytest

from heartfit.synthetic.known_hearts import WORLDS
from heartfit.synthetic.volunteer import OTHERS
from tests.synthetic.linear import OBSERVED, linear_twins


def test_a_heart_follows_from_its_number_and_has_one_truth_in_all_worlds() -> None:
    twins = linear_twins()
    drawn = [twins.draw(3, world) for world in WORLDS]
    assert twins.draw(3, "model").observed == drawn[2].observed
    assert all((each.truth == drawn[0].truth).all() for each in drawn)
    assert not np.allclose(twins.draw(4, "nothing").truth, drawn[0].truth)
    assert drawn[0].observed != drawn[1].observed


def test_where_nothing_is_unknown_the_observations_are_the_model_s_but_for_noise() -> None:
    twins = linear_twins()
    errors = []
    for number in range(200):
        twin = twins.draw(number, "nothing")
        (true,) = twins.model.observe_all([twins.prior.physical(twin.truth)])
        errors.append([twin.observed[name] / true[name] - 1.0 for name in OBSERVED])
    assert np.std(errors, axis=0) == pytest.approx(0.01, rel=0.12)
    assert np.sqrt(np.diag(twin.noise)) == pytest.approx([0.01 * twin.observed[name] for name in OBSERVED])


def test_truths_scatter_as_the_prior() -> None:
    twins = linear_twins()
    truths = np.array([twins.draw(number, "nothing").truth for number in range(200)])
    assert (truths.mean(axis=0) - twins.prior.mean) / twins.prior.sd == pytest.approx(np.zeros(4), abs=0.2)
    assert truths.std(axis=0) == pytest.approx(twins.prior.sd, rel=0.12)


def test_what_is_fixed_is_what_scatters_and_is_not_estimated() -> None:
    assert linear_twins().fixed == OTHERS
