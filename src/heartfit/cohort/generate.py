"""From a volunteer's shape and seed to what a scanner would see of the beat, and the truth, kept apart."""

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np

from heartfit.beat import Beat
from heartfit.cohort.hidden_heart import draw_heart
from heartfit.cohort.protocol import Protocol as Protocol
from heartfit.electrophysiology.onset import assign_activation
from heartfit.geometry.arrays import Floats
from heartfit.geometry.mesh import VentricularMesh
from heartfit.geometry.mesher import fill_wall
from heartfit.geometry.motion import Motion
from heartfit.geometry.parametric import ParametricVentricles
from heartfit.geometry.prepare import prepare
from heartfit.mechanics.body import FiniteElementBody
from heartfit.mechanics.unloading import unload
from heartfit.simulation import simulate


@dataclass(frozen=True, eq=False)
class Volunteer:
    """The wall at end diastole and its motion, as acquired, and the truth that only the evaluation may see."""

    mesh: VentricularMesh
    motion: Motion
    truth: dict[str, float]


class VolunteerError(RuntimeError):
    """The hidden heart did not beat: choose another seed or shape."""


def generate(
    shape: ParametricVentricles, standard: Mapping[str, float], period: float, seed: int, protocol: Protocol
) -> Volunteer:
    """The volunteer of this shape whose hidden heart is scattered about the ``standard`` parameters."""
    heart, truth = draw_heart(standard, period, seed)
    bare = fill_wall(shape.surface(), protocol.edge_length, protocol.tolerance)
    mesh = assign_activation(prepare(bare))
    reference = unload(mesh, heart.tissue, np.array(protocol.end_diastolic_pressure))
    body = FiniteElementBody(reference, heart.tissue)
    beat = simulate(heart, body, replace(protocol.numerics, keep_positions=True))
    if not beat.completed:
        raise VolunteerError(f"volunteer of seed {seed}: {beat.reason}; choose another seed or shape")
    motion = acquire(beat, protocol.frames, protocol.noise, np.random.default_rng(seed))
    return Volunteer(bare.with_points(motion.positions[0]), motion, truth)


def acquire(beat: Beat, frames: int, noise: float, rng: np.random.Generator) -> Motion:
    """The wall at equidistant times from the trigger, with a dilation and a shift of size ``noise`` per frame."""
    times = np.linspace(0.0, beat.period, frames, endpoint=False)
    clean = np.array([_at(beat, (time + beat.trigger) % beat.period) for time in times])
    centre = clean.mean(axis=1, keepdims=True)
    radius = float(np.sqrt(((clean - centre) ** 2).sum(axis=2).mean()))
    dilation = 1.0 + noise / radius * rng.standard_normal((frames, 1, 1))
    shift = noise * rng.standard_normal((frames, 1, 3))
    return Motion(times, beat.period, centre + dilation * (clean - centre) + shift)


def _at(beat: Beat, time: float) -> Floats:
    """Nodal positions (n, 3) at a time within the beat, linear between its samples."""
    positions = np.asarray(beat.positions)
    before = min(int(np.searchsorted(beat.time, time, side="right")) - 1, len(beat.time) - 2)
    share = (time - beat.time[before]) / (beat.time[before + 1] - beat.time[before])
    result: Floats = (1.0 - share) * positions[before] + share * positions[before + 1]
    return result
