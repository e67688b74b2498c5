"""Whether blood is conserved, from the states of a beat alone: what flows out of one place arrives in another."""

from collections.abc import Sequence
from itertools import pairwise

import numpy as np

from heartfit.beat import Beat
from heartfit.circulation.coupling import HeartState
from heartfit.circulation.network import NetworkStep
from heartfit.geometry.arrays import Floats
from heartfit.heart import Heart
from heartfit.mechanics.time_step import TimeStep

VALVES = {"lv": ("mitral", "aortic"), "rv": ("tricuspid", "pulmonary")}


def lost_blood(heart: Heart, history: Sequence[HeartState], second_order: bool = True) -> Floats:
    """What both ventricles and both arterial trees (4,) gained less what flowed in, m^3, over a first beat from rest.

    The flows are taken at the ends of the steps; their means over a step follow as the time scheme takes them,
    q# = (q + b q#_before) / (1 + b), b being 0 in the first step.
    """
    dt, total, mean = heart.period / (len(history) - 1), np.zeros(4), np.zeros(4)
    for n, (before, state) in enumerate(pairwise(history)):
        step = TimeStep(n * dt, dt, heart.period, second_order, before.last)
        mean = (_outflow(heart, state, step) + step.memory * mean) / (1.0 + step.memory)
        total += dt * mean
    return _contents(heart, history[-1]) - _contents(heart, history[0]) + total


def _outflow(heart: Heart, state: HeartState, step: TimeStep) -> Floats:
    """Out of the ventricles, and out of the arteries through valves and periphery, m^3/s."""
    network = NetworkStep(heart.circulation, heart.mechanisms, step.end, step.effective, heart.period)
    sides = zip(heart.circulation.trees(), state.trees, strict=True)
    periphery = [(held.P_c - tree.P_ve) / tree.R_p for tree, held in sides]
    flow: Floats = network.outflow(state.pressures)[0] + [0.0, 0.0, *periphery]
    return flow


def _contents(heart: Heart, state: HeartState) -> Floats:
    sides = zip(heart.circulation.trees(), state.trees, strict=True)
    return np.array([*state.volumes, *(tree.tau / tree.R_p * held.P_c for tree, held in sides)])


def isovolumic_drift(beat: Beat) -> float:
    """Largest volume, m^3, that a ventricle gains or loses in a phase in which both its valves are closed."""
    return max(_drift(beat, side, *valves) for side, valves in VALVES.items())


def _drift(beat: Beat, side: str, inlet: str, outlet: str) -> float:
    closed = (beat.flow[inlet] <= 0.0) & (beat.flow[outlet] <= 0.0)
    steps = np.flatnonzero(closed[1:] & closed[:-1])
    phases = np.split(steps, np.flatnonzero(np.diff(steps) > 1) + 1)
    volume = beat.volume[side]
    return max((float(abs(volume[p[-1] + 1] - volume[p[0]])) for p in phases if p.size), default=0.0)
