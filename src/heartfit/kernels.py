"""Compiles the numerical kernels, which numba keeps on disk, before many jobs would at the same time."""

from dataclasses import replace

import numpy as np

from heartfit.beat import Beat
from heartfit.electrophysiology.eikonal import activation_times
from heartfit.heart import Heart
from heartfit.mechanics.body import FiniteElementBody
from heartfit.simulation import Numerics, simulate
from heartfit.verification.block import cube


def compile_kernels() -> Beat:
    """The beat of a cube of muscle between two cavities, which runs every kernel of activation and beat."""
    block, heart = cube(2, 0.02), Heart()
    times = activation_times(block.points, block.tets, np.asarray(block.fibres), {0: 0.0})
    block = replace(block, activation=times[block.tets].mean(axis=1))
    return simulate(heart, FiniteElementBody(block, heart.tissue), Numerics(time_step=1e-2, max_beats=1))
