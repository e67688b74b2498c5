"""Heart of one or two spherical ventricles, as the arrays of its compiled beat."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np
from scipy.optimize import brentq

from heartfit.core.arrays import Floats
from heartfit.heart.circulation.atria import fill_atria, sides_filling_veins
from heartfit.heart.circulation.enclosure import VENTRICLES, load_table
from heartfit.heart.circulation.network import (
    ARTERIES,
    Circulation,
    Network,
    atrial_walls,
    mechanism_pressures,
)
from heartfit.heart.circulation.network_step import net_outflow
from heartfit.heart.finite_elements.kinematics import StepFailed
from heartfit.heart.heart import Heart
from heartfit.heart.muscle.control import Control
from heartfit.heart.sphere import rows
from heartfit.heart.sphere.beat import SphereTissue, State, StepInputs
from heartfit.heart.sphere.body import LARGEST_STRETCH, Sphere, fibre_activation, wall_stiffenings
from heartfit.heart.sphere.wall import cavity, passive_stress, tabulate
from heartfit.roles import Mechanism
from heartfit.roles.chamber import ACTIVE, VEIN_END, VOLUME
from heartfit.roles.laws import FLOW, STATE_ROWS

START = np.zeros(1).tobytes()
"""The start of a beat [s], as a key."""

SMALLEST_FILLING_STRETCH = 0.8
"""Lower bound of the stretch of a filled sphere; no atrial pressure reaches it."""


@dataclass(frozen=True)
class Inertia:
    """Inertia and arterial compliance that the standard heart neglects; zero by default.

    ``density`` of the wall [kg/m^3], inertances ``valves`` of branches by name [Pa s^2/m^3], and compliance
    ``arteries`` of every artery in addition to its Windkessel [m^3/Pa].
    """

    density: float = 0.0
    valves: tuple[tuple[str, float], ...] = ()
    arteries: float = 0.0


@lru_cache(maxsize=64)
def _drive(
    control: Control, start: bytes, length: float, activation: bytes, period: float
) -> tuple[Floats, Floats]:
    """Means (n, k) of the drive over steps, see :meth:`Control.mean`; kept, since many hearts of a search share it."""
    return control.mean(np.frombuffer(start)[:, None], length, np.frombuffer(activation), period)


@lru_cache(maxsize=64)
def _network(circulation: Circulation, mechanisms: tuple[Mechanism, ...], sides: int) -> Network:
    """The network; kept like the drive."""
    return Network(circulation, mechanisms, sides)


@lru_cache(maxsize=64)
def _prescribe(network: Network, time: bytes, period: float) -> tuple[Floats, Floats, Floats, Floats]:
    """Pressures (n, v) of atria and waves [Pa], and tables of loads and branches at n times; kept like the drive."""
    at, mechanisms, sides = np.frombuffer(time), network.mechanisms, network.sides
    atria = network.circulation.atrial(at, period, mechanisms, sides)
    waves = mechanism_pressures(ARTERIES[:sides], at, period, mechanisms)
    loads = load_table(mechanisms, VENTRICLES[:sides], at, period)
    return np.ascontiguousarray(atria.T), np.ascontiguousarray(waves.T), loads, network.laws(at)


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
        self._network = _network(heart.circulation, heart.mechanisms, len(spheres))
        self.branches = self._network.names
        self.atria = self._network.atria
        self._leaflets, inertances = self._network.leaflets.copy(), dict(inertia.valves)
        self._leaflets[:, 0] += [inertances.get(name, 0.0) for name in self.branches]

    @property
    def fibres(self) -> int:
        """Number of fibres of all spheres."""
        return len(self._activation)

    def inputs(self, start: Floats, length: float) -> StepInputs:
        """Inputs of steps of ``length`` [s] that begin at ``start`` (n,) [s]."""
        control, end = self.muscle.control, start + length
        rate, attach = _drive(control, start.tobytes(), length, self._activation.tobytes(), self.heart.period)
        atria, waves, loads, laws = _prescribe(self._network, end.tobytes(), self.heart.period)
        walls, ends = self._walls(end), self._network.ends
        return StepInputs(length, self._second_order, rate, attach, atria, walls, waves, loads, laws, ends)

    def _walls(self, time: Floats) -> Floats:
        """Active elastances [Pa/m^3] and outside pressures [Pa] (t, 2, v) of atria with a volume."""
        heart, sides = self.heart, len(self.spheres)
        if self.atria is None:
            return np.empty((len(time), 2, 0))
        contraction, outside = atrial_walls(time, heart.period, heart.mechanisms, sides)
        return np.stack([contraction[:, None] * self.atria[ACTIVE], outside.T], axis=1)

    def atria_at_start(self) -> Floats:
        """Pressures (1, v) of atria without a volume as a beat starts [Pa]."""
        return _prescribe(self._network, START, self.heart.period)[0]

    def flows(self, p: Floats, inert: Floats) -> Floats:
        """Flows (k,) [m^3/s] as a beat starts at the pressures p (n,) [Pa]; ``inert`` in branches with a state."""
        moving, work = np.zeros((STATE_ROWS, len(self.branches))), np.empty((len(p), len(p)))
        atria, _, _, laws = _prescribe(self._network, START, self.heart.period)
        net_outflow(self._network.ends, laws, moving, atria, 0, p, np.empty((1, len(p))), work)
        return np.where(self._leaflets.any(axis=1), inert, moving[FLOW])

    def start(self) -> State:
        """State of relaxed ventricles, filled at the resting atrial pressures; raises StepFailed if there is none."""
        pressures = self.heart.circulation.atrial(self.heart.period, self.heart.period, ())
        sides = np.zeros((rows.SIDE_ROWS, len(self.spheres)))
        windkessels = self.heart.circulation.start(self.heart.period)
        self._set_constants(sides)
        for v in range(len(self.spheres)):
            memory = np.zeros(rows.REMEMBERED)
            memory[rows.STRETCH] = self._filling_stretch(v, pressures[v])
            memory[[rows.ARTERY, rows.P_C]] = windkessels[v].P_c
            for row in (rows.NOW, rows.BEFORE, rows.OLDER):
                sides[row : row + rows.REMEMBERED, v] = memory
        sides[rows.P] = pressures[: len(self.spheres)]
        fibres, branches = self._relaxed_fibres(sides[rows.NOW + rows.STRETCH]), self._resting_branches()
        return State(sides, fibres, branches, np.zeros(2), *self._filled_atria(sides, pressures))

    def take_over(self, state: State) -> State:
        """State of this heart where a heart with the same branches is in ``state``; no atrium may have a volume."""
        sides, fibres, branches, last = (table.copy() for table in state[:4])
        self._set_constants(sides)
        fibres[rows.KEPT] = self._bridges
        branches[rows.INERTANCE : rows.CLOSES + 1] = self._leaflets.T
        return State(sides, fibres, branches, last, None, None)

    def _set_constants(self, sides: Floats) -> None:
        """Fill the constants of the spheres and of their arteries."""
        filling = sides_filling_veins(self.atria)
        for v, (sphere, tree) in enumerate(zip(self.spheres, self.trees, strict=True)):
            ratio = 0.5 * sphere.thickness / sphere.radius
            sides[[rows.RADIUS, rows.RATIO, rows.WALL], v] = sphere.radius, ratio, sphere.wall
            constants = (replace(tree, P_ve=0.0) if v in filling else tree).constants()
            sides[rows.R_P : rows.R_P + 5, v], sides[rows.OWN_COMPLIANCE, v] = (
                constants,
                self.inertia.arteries,
            )

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
