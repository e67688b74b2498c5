"""Heart of one or two spherical ventricles, as the arrays of its compiled beat."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from scipy.optimize import brentq

from heartfit.core.arrays import Floats
from heartfit.heart.circulation.atria import fill_atria, sides_filling_veins
from heartfit.heart.circulation.enclosure import VENTRICLES, load_table
from heartfit.heart.circulation.network import ARTERIES, Network, atrial_walls, mechanism_pressures
from heartfit.heart.circulation.network_step import net_outflow
from heartfit.heart.finite_elements.kinematics import StepFailed
from heartfit.heart.heart import Heart
from heartfit.heart.sphere import rows
from heartfit.heart.sphere.beat import SphereTissue, State, StepInputs
from heartfit.heart.sphere.body import LARGEST_STRETCH, Sphere, fibre_activation, wall_stiffenings
from heartfit.heart.sphere.wall import cavity, passive_stress, tabulate
from heartfit.roles.chamber import ACTIVE, VEIN_END, VOLUME
from heartfit.roles.laws import FLOW, STATE_ROWS

SMALLEST_FILLING_STRETCH = 0.8
"""Lower bound of the stretch of a filled sphere; no atrial pressure reaches it."""


@dataclass(frozen=True)
class Inertia:
    """Inertia and arterial compliance that the standard heart neglects; zero by default.

    ``density`` of the wall [kg/m^3], inertances ``valves`` of branches by name [Pa s^2/m^3], and compliance
    ``arteries`` of every artery beside its Windkessel [m^3/Pa].
    """

    density: float = 0.0
    valves: tuple[tuple[str, float], ...] = ()
    arteries: float = 0.0


class SphericalHeart:
    """Left ventricle, or both, of ``heart`` as spheres, with the activation times (k,) [s] of the fibre classes."""

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
        self._activation, self._bridges = fibre_activation(self.muscle, activation, len(spheres))
        passive, active = self.muscle.passive, self.muscle.active
        shares = wall_stiffenings(self.muscle, len(spheres)).tolist()
        tables = np.concatenate([tabulate(passive, share) for share in shares])
        self.tissue = SphereTissue(
            tables, active.constants(), active.starling.constants(), passive.eta, inertia.density
        )
        self._network = Network(heart.circulation, heart.mechanisms, len(spheres))
        self.branches = self._network.names
        self.atria = self._network.atria
        self._leaflets, inertances = self._network.leaflets.copy(), dict(inertia.valves)
        self._leaflets[:, 0] += [inertances.get(name, 0.0) for name in self.branches]

    def inputs(self, start: Floats, length: float) -> StepInputs:
        """Inputs of steps of ``length`` [s] that begin at ``start`` (n,) [s]."""
        heart, control, end = self.heart, self.muscle.control, start + length
        rate, attach = control.mean(start[:, None], length, self._activation, heart.period)
        atria = np.ascontiguousarray(self.prescribed(end).T)
        waves = mechanism_pressures(ARTERIES[: len(self.spheres)], end, heart.period, heart.mechanisms)
        waves = np.ascontiguousarray(waves.T)
        loads = load_table(heart.mechanisms, VENTRICLES[: len(self.spheres)], end, heart.period)
        laws, walls = self._network.laws(end), self._walls(end)
        return StepInputs(
            length, self._second_order, rate, attach, atria, walls, waves, loads, laws, self._network.ends
        )

    def _walls(self, time: Floats) -> Floats:
        """Active elastances [Pa/m^3] and outside pressures [Pa] (t, 2, v) of atria with a volume."""
        heart, sides = self.heart, len(self.spheres)
        if self.atria is None:
            return np.empty((len(time), 2, 0))
        contraction, outside = atrial_walls(time, heart.period, heart.mechanisms, sides)
        return np.stack([contraction[:, None] * self.atria[ACTIVE], outside.T], axis=1)

    def prescribed(self, time: Floats) -> Floats:
        """Pressures (v, t) of atria without a volume [Pa] at ``time`` (t,) [s]."""
        heart = self.heart
        return heart.circulation.atrial(time, heart.period, heart.mechanisms, len(self.spheres))

    def flows(self, p: Floats, inert: Floats) -> Floats:
        """Flows (k,) [m^3/s] as a beat starts at the pressures p (n,) [Pa]; ``inert`` in branches with a state."""
        moving, work, zero = (
            np.zeros((STATE_ROWS, len(self.branches))),
            np.empty((len(p), len(p))),
            np.zeros(1),
        )
        laws, atria = self._network.laws(zero), np.ascontiguousarray(self.prescribed(zero).T)
        net_outflow(self._network.ends, laws, moving, atria, 0, p, np.empty((1, len(p))), work)
        return np.where(self._leaflets.any(axis=1), inert, moving[FLOW])

    def start(self) -> State:
        """State of relaxed ventricles, filled at the resting atrial pressures; raises StepFailed if there is none."""
        pressures = self.heart.circulation.atrial(self.heart.period, self.heart.period, ())
        sides = np.zeros((rows.SIDE_ROWS, len(self.spheres)))
        windkessels = self.heart.circulation.start(self.heart.period)
        filling = sides_filling_veins(self.atria)
        for v, (sphere, tree) in enumerate(zip(self.spheres, self.trees, strict=True)):
            sides[[rows.RADIUS, rows.RATIO, rows.WALL], v] = (
                sphere.radius,
                0.5 * sphere.thickness / sphere.radius,
                sphere.wall,
            )
            sides[rows.R_P : rows.R_P + 5, v], sides[rows.OWN_COMPLIANCE, v] = (
                replace(tree, P_ve=0.0).constants() if v in filling else tree.constants(),
                self.inertia.arteries,
            )
            memory = np.zeros(rows.REMEMBERED)
            memory[rows.STRETCH] = self._filling_stretch(v, pressures[v])
            memory[[rows.ARTERY, rows.P_C]] = windkessels[v].P_c
            for row in (rows.NOW, rows.BEFORE, rows.OLDER):
                sides[row : row + rows.REMEMBERED, v] = memory
        sides[rows.P] = pressures[: len(self.spheres)]
        fibres, branches = self._relaxed_fibres(sides[rows.NOW + rows.STRETCH]), self._resting_branches()
        return State(sides, fibres, branches, np.zeros(2), *self._filled_atria(sides, pressures))

    def _filled_atria(self, sides: Floats, pressures: Floats) -> tuple[Floats | None, Floats | None]:
        """Table of the relaxed atria, and their volumes and veins now and one step before."""
        if self.atria is None:
            return None, None
        atria, stretch = self.atria.copy(), sides[rows.NOW + rows.STRETCH]
        volumes = [cavity(*sides[[rows.RADIUS, rows.RATIO], v], x)[0] for v, x in enumerate(stretch)]  # type: ignore[call-arg]
        fill_atria(atria, pressures, np.array(volumes))
        return atria, atria[[VOLUME, VEIN_END, VOLUME, VEIN_END]]

    def _relaxed_fibres(self, stretch: Floats) -> Floats:
        fibres, active = np.zeros((rows.FIBRE_ROWS, len(self._activation))), self.muscle.active
        fibres[:4], fibres[rows.KEPT] = active.rest(len(self._activation)), self._bridges
        strain = np.repeat(0.5 * (stretch**2 - 1.0), len(self._activation) // len(stretch))
        fibres[rows.E_C] = active.unstressed(strain)
        return fibres

    def _resting_branches(self) -> Floats:
        branches = np.zeros((rows.BRANCH_ROWS, len(self.branches)))
        branches[rows.INERTANCE : rows.CLOSES + 1] = self._leaflets.T
        return branches

    def _filling_stretch(self, v: int, pressure: float) -> float:
        """Stretch at which the relaxed sphere of side v holds the pressure [Pa]."""
        tables, sphere = self.tissue.passive, self.spheres[v]
        ratio = 0.5 * sphere.thickness / sphere.radius

        def excess(stretch: float) -> float:
            slope = cavity(sphere.radius, ratio, stretch)[1]
            return float(sphere.wall * passive_stress(tables, v, stretch)[0] - pressure * slope)

        upper = next((s for s in np.arange(1.02, LARGEST_STRETCH, 0.02) if excess(s) > 0.0), None)
        if upper is None:
            raise StepFailed(
                f"no static equilibrium at {pressure:.0f} Pa below a stretch of {LARGEST_STRETCH:g}"
            )
        return float(brentq(excess, SMALLEST_FILLING_STRETCH, upper, xtol=1e-14))
