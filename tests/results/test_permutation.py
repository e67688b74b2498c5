"""The exact permutation test of small groups, counted by hand."""

import numpy as np
import pytest

from heartfit.results.specificity import permutation_test


def test_two_patients_below_seven_volunteers_are_one_of_thirty_six():
    test = permutation_test([-2.0, -1.5], [0.1, 0.2, -0.3, 0.0, 0.4, -0.1, 0.3])
    assert test.labelings == 36
    assert test.p == test.less == pytest.approx(1 / 36)
    assert test.greater == 1.0
    assert test.difference == pytest.approx(-1.75 - 0.6 / 7)


def test_labelings_that_are_as_extreme_count():
    test = permutation_test([1.0], [2.0, 3.0, 4.0])
    assert (test.less, test.greater, test.p) == (0.25, 1.0, 0.5), "4 is as far above as 1 is below"


def test_equal_members_give_a_p_value_of_one():
    test = permutation_test([0.1, 0.1], [0.1] * 5)
    assert (test.p, test.less, test.greater) == (1.0, 1.0, 1.0)


def test_p_values_of_random_labels_are_uniform():
    random = np.random.default_rng(5)
    p_values = [permutation_test(x[:2], x[2:]).p for x in random.standard_normal((300, 6))]
    assert np.mean(np.array(p_values) <= 0.2) == pytest.approx(0.2, abs=0.07)


def test_an_empty_group_is_refused():
    with pytest.raises(ValueError, match=r"\b0 and 3\b"):
        permutation_test([], [1.0, 2.0, 3.0])
