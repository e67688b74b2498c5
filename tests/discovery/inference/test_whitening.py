"""The likelihood is that of independent blocks of unknown level, and its slope the derivative."""

from dataclasses import replace
from itertools import product

import numpy as np
import pytest
from scipy.linalg import block_diag
from scipy.stats import multivariate_normal

from heartfit.discovery.inference.data import Data, Whitening
from tests.discovery.inference import oscillator

R = oscillator.noise(np.random.default_rng(3))
DATA = Data(R, oscillator.BLOCKS)


def test_levels_are_averaged_block_by_block() -> None:
    density = 1.0
    for block, rows in zip(DATA.blocks, DATA.rows, strict=True):
        levels = [block.noise.covariance(block.times, 1.0, level) for level in block.noise.levels]
        density *= np.mean([multivariate_normal(cov=covariance).pdf(R[rows]) for covariance in levels])
    assert Whitening.from_data(DATA).log_likelihood(R) == pytest.approx(np.log(density), rel=1e-9)


def test_a_discrepancy_adds_its_covariance() -> None:
    (block, *_), rows = DATA.blocks, DATA.rows[0]
    one = Data(R[rows], (block,))
    smooth = 4.0 * block.noise.discrepancy_covariance(block.times, block.times, 1.0)
    levels = [block.noise.covariance(block.times, 1.0, level) + smooth for level in block.noise.levels]
    density = np.mean([multivariate_normal(cov=covariance).pdf(R[rows]) for covariance in levels])
    assert Whitening.from_data(one, 2.0).log_likelihood(R[rows]) == pytest.approx(np.log(density), rel=1e-9)


def structured() -> Data:
    """The data with a structural covariance that ties both blocks, and two scales."""
    shared = np.random.default_rng(5).standard_normal((R.size, 3))
    return replace(DATA, structure=shared @ shared.T, scales=(0.5, 2.0))


def test_a_structural_covariance_ties_the_blocks_at_every_scale_and_level() -> None:
    data = structured()
    blocks = [
        [block.noise.covariance(block.times, 1.0, level) for level in block.noise.levels]
        for block in data.blocks
    ]
    densities = [
        multivariate_normal(cov=block_diag(*levels) + scale**2 * data.structure).pdf(R)
        for levels in product(*blocks)
        for scale in data.scales
    ]
    assert Whitening.from_data(data).log_likelihood(R) == pytest.approx(np.log(np.mean(densities)), rel=1e-9)


def test_the_most_probable_level_and_scale_are_those_of_the_largest_density() -> None:
    data = structured()
    levels, scale = Whitening.from_data(data).most_probable_levels(R)
    best = {
        (places, one): multivariate_normal(
            cov=block_diag(
                *(
                    block.noise.covariance(block.times, 1.0, block.noise.levels[place])
                    for block, place in zip(data.blocks, places, strict=True)
                )
            )
            + one**2 * data.structure
        ).logpdf(R)
        for places in product(*(range(len(block.noise.levels)) for block in data.blocks))
        for one in data.scales
    }
    assert (tuple(levels), scale) == max(best, key=best.__getitem__)


def test_without_structure_the_scale_is_0() -> None:
    assert Whitening.from_data(DATA).most_probable_levels(R)[1] == 0.0


def test_the_normal_equations_are_the_slope_of_the_logarithm() -> None:
    J, whitening = np.random.default_rng(1).standard_normal((R.size, 2)), Whitening.from_data(DATA)
    slope, curvature = whitening.normal(R, J)
    h = 1e-5
    differences = [
        (whitening.log_likelihood(R - J @ shift) - whitening.log_likelihood(R + J @ shift)) / (2 * h)
        for shift in h * np.eye(2)
    ]
    assert slope == pytest.approx(differences, rel=1e-6)
    assert np.linalg.eigvalsh(curvature).min() > 0.0
    assert curvature == pytest.approx(curvature.T)
