"""Indices of a linear map are its shares of variance; a missing output is excluded."""

from collections.abc import Mapping

import numpy as np
import pytest

from heartfit.calibration.gaussian import Gaussian
from heartfit.calibration.sobol import SobolError, indices_of, sobol_indices
from heartfit.calibration.unscented import Outcome

PRIOR = Gaussian.from_relative({"a": 2.0, "b": 3.0, "K": 1e6}, {"a": 0.2, "b": 0.1, "K": 0.25})
SAMPLES, BLOCK = 128, 5


class Linear:
    """Z = ln a + 4 ln b; one call may return another answer."""

    def __init__(self, at: Mapping[int, Outcome] | None = None) -> None:
        self.at, self.calls = at or {}, 0

    def __call__(self, parameters: Mapping[str, float]) -> Outcome:
        self.calls += 1
        value = float(np.log(parameters["a"]) + 4.0 * np.log(parameters["b"]))
        return self.at.get(self.calls - 1, {"Z": value})


def test_shares_of_a_linear_map() -> None:
    forward = Linear()
    indices = sobol_indices(PRIOR, forward, SAMPLES, seed=0)
    assert forward.calls == SAMPLES * BLOCK
    assert indices.samples == SAMPLES
    assert indices.first[:2, 0] == pytest.approx([0.2, 0.8], abs=0.05)
    assert indices.total[:2, 0] == pytest.approx([0.2, 0.8], abs=0.05)
    assert indices.first[2, 0] == indices.total[2, 0] == 0.0
    assert indices.lost == ()


def test_two_that_act_only_together_have_no_share_alone() -> None:
    mean = PRIOR.mean

    def product(parameters: Mapping[str, float]) -> Outcome:
        return {"Z": float((np.log(parameters["a"]) - mean[0]) * (np.log(parameters["b"]) - mean[1]))}

    indices = sobol_indices(PRIOR, product, 4 * SAMPLES, seed=0)
    assert indices.first[:2, 0] == pytest.approx([0.0, 0.0], abs=0.15)
    assert indices.total[:2, 0] == pytest.approx([1.0, 1.0], abs=0.1)


def test_the_same_seed_gives_the_same_indices() -> None:
    first, second = (sobol_indices(PRIOR, Linear(), 16, seed=3) for _ in range(2))
    assert (first.total == second.total).all()
    assert (first.total_error == second.total_error).all()


@pytest.mark.parametrize(
    ("planted", "reason"), [({"Z": float("nan")}, "Z not finite"), ("no balance", "no balance")]
)
def test_a_lost_output_removes_its_block_and_is_counted(planted: Outcome, reason: str) -> None:
    indices = sobol_indices(PRIOR, Linear({7: planted}), SAMPLES, seed=0)
    assert indices.samples == SAMPLES - 1
    assert indices.lost == (reason,)
    assert indices.total[:2, 0] == pytest.approx([0.2, 0.8], abs=0.06)


def test_many_lost_outputs_are_refused() -> None:
    lost: dict[int, Outcome] = {BLOCK * block: {"Z": float("inf")} for block in range(8)}
    with pytest.raises(SobolError, match=r"8 of 128\b.*Z not finite"):
        sobol_indices(PRIOR, Linear(lost), SAMPLES, seed=0)


def test_an_observation_without_sensitivity_is_refused() -> None:
    with pytest.raises(SobolError, match=r"parameter.*\bZ\b"):
        indices_of(PRIOR, [{"Z": 1.0}] * (16 * BLOCK), seed=0)
