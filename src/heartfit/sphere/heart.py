"""A heart of one or two spherical ventricles as the arrays of its compiled beat."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.optimize import brentq

from heartfit.circulation.enclosure import VENTRICLES, load_table
from heartfit.circulation.network import ARTERIES, Network, added_pressures, net_outflow
from heartfit.geometry.arrays import Floats
from heartfit.heart import Heart
from heartfit.mechanics.kinematics import StepFailed
from heartfit.mechanics.sphere import LARGEST_STRETCH, Sphere, fibres_of
from heartfit.sphere import rows as at
from heartfit.sphere.beat import Course, State, Tissue
from heartfit.sphere.wall import cavity, passive_stress, tabulated

SMALLEST_FILLED = 0.8
"""Stretch that no atrial pressure holds."""


@dataclass(frozen=True)
class Inertia:
    """What the heart leaves out and another model may have; all zero by default.

    ``density`` of the wall, kg/m^3, ``valves`` the inertances of branches by name, Pa s^2/m^3, and ``arteries`` the
    compliance of each artery beside its Windkessel, m^3/Pa.
    """

    density: float = 0.0
    valves: tuple[tuple[str, float], ...] = ()
    arteries: float = 0.0


class SphericalHeart:
    """Left ventricle, or both, of ``heart`` as spheres; fibres are activated at the times ``activation`` (k,), s."""

    def __init__(
        self,
        heart: Heart,
        spheres: Sequence[Sphere],
        activation: Floats,
        inertia: Inertia,
        second_order: bool,
    ) -> None:
        self.heart, self.spheres, self.inertia, self._second_order = heart, spheres, inertia, second_order
        self.trees = heart.circulation.trees()[: len(spheres)]
        self.muscle = heart.muscle
        self._activation, self._bridges = fibres_of(self.muscle, activation, len(spheres))
        passive, active = self.muscle.passive, self.muscle.active
        self.tissue = Tissue(
            tabulated(passive), active.constants(), active.starling.constants(), passive.eta, inertia.density
        )
        self._network = Network(heart.circulation, heart.mechanisms, len(spheres))
        self.branches = self._network.names

    def course(self, start: Floats, length: float) -> Course:
        """What is prescribed in steps of ``length``, s, that begin at ``start`` (n,)."""
        heart, control, end = self.heart, self.muscle.control, start + length
        rate, attach = control.mean(start[:, None], length, self._activation, heart.period)
        atria = np.ascontiguousarray(self.atria(end).T)
        waves = added_pressures(ARTERIES[: len(self.spheres)], end, heart.period, heart.mechanisms)
        waves = np.ascontiguousarray(waves.T)
        loads = load_table(heart.mechanisms, VENTRICLES[: len(self.spheres)], end, heart.period)
        laws = self._network.laws(end)
        return Course(length, self._second_order, rate, attach, atria, waves, loads, laws, self._network.ends)

    def atria(self, time: Floats) -> Floats:
        """Pressures (v, t) of the atria at ``time`` (t,)."""
        heart = self.heart
        return heart.circulation.atrial(time, heart.period, heart.mechanisms, len(self.spheres))

    def flows(self, p: Floats, held: Floats) -> Floats:
        """Flow (k,) of every branch as a beat starts, at the pressures p (2 v,); ``held`` where it is inert."""
        inertances = dict(self.inertia.valves)
        moving, room, zero = np.zeros((3, len(self.branches))), np.empty((len(p), len(p))), np.zeros(1)
        laws, atria = self._network.laws(zero), np.ascontiguousarray(self.atria(zero).T)
        net_outflow(self._network.ends, laws, moving, atria, 0, p, np.empty((1, len(p))), room)
        massless = [inertances.get(name, 0.0) == 0.0 for name in self.branches]
        return np.where(massless, moving[2], held)

    def start(self) -> State:
        """Relaxed ventricles filled at the resting atrial pressures; raises StepFailed if they balloon."""
        pressures = self.heart.circulation.atrial(self.heart.period, self.heart.period, ())
        sides = np.zeros((at.SIDE_ROWS, len(self.spheres)))
        held = self.heart.circulation.start(self.heart.period)
        for v, (sphere, tree) in enumerate(zip(self.spheres, self.trees, strict=True)):
            sides[[at.RADIUS, at.RATIO, at.WALL], v] = (
                sphere.radius,
                0.5 * sphere.thickness / sphere.radius,
                sphere.wall,
            )
            sides[at.R_P : at.R_P + 5, v], sides[at.OWN_COMPLIANCE, v] = (
                tree.constants(),
                self.inertia.arteries,
            )
            memory = np.zeros(at.REMEMBERED)
            memory[at.STRETCH] = self._filled(sphere, pressures[v])
            memory[[at.ARTERY, at.P_C]] = held[v].P_c
            for row in (at.NOW, at.BEFORE, at.OLDER):
                sides[row : row + at.REMEMBERED, v] = memory
        sides[at.P] = pressures[: len(self.spheres)]
        return State(sides, self._relaxed(sides[at.NOW + at.STRETCH]), self._still(), np.zeros(2))

    def _relaxed(self, stretch: Floats) -> Floats:
        fibres, active = np.zeros((at.FIBRE_ROWS, len(self._activation))), self.muscle.active
        fibres[:4], fibres[at.KEPT] = active.rest(len(self._activation)), self._bridges
        strain = np.repeat(0.5 * (stretch**2 - 1.0), len(self._activation) // len(stretch))
        fibres[at.E_C] = active.unstressed(strain)
        return fibres

    def _still(self) -> Floats:
        branches, inertances = np.zeros((at.BRANCH_ROWS, len(self.branches))), dict(self.inertia.valves)
        branches[at.INERTANCE] = [inertances.get(name, 0.0) for name in self.branches]
        return branches

    def _filled(self, sphere: Sphere, pressure: float) -> float:
        """Stretch at which the relaxed sphere holds the pressure, Pa."""
        table, ratio = self.tissue.passive, 0.5 * sphere.thickness / sphere.radius

        def excess(stretch: float) -> float:
            slope = cavity(sphere.radius, ratio, stretch)[1]
            return float(sphere.wall * passive_stress(table, stretch)[0] - pressure * slope)

        held = next((s for s in np.arange(1.02, LARGEST_STRETCH, 0.02) if excess(s) > 0.0), None)
        if held is None:
            raise StepFailed(
                f"no static equilibrium at {pressure:.0f} Pa below a stretch of {LARGEST_STRETCH:g}"
            )
        return float(brentq(excess, SMALLEST_FILLED, held, xtol=1e-14))
