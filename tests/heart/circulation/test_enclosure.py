"""Pressure on the outside of the ventricles: closed forms and invariances."""

from dataclasses import dataclass, replace

import numpy as np
import pytest

from heartfit.core.arrays import Floats
from heartfit.heart.circulation.coupling import Coupling, Tolerances
from heartfit.heart.circulation.elements import LinearValve
from heartfit.heart.circulation.enclosure import EnclosedBody, EnclosedStiffness, load_table
from heartfit.heart.circulation.network import Circulation
from heartfit.heart.circulation.state import HeartState
from heartfit.heart.finite_elements.body import FiniteElementBody
from heartfit.heart.finite_elements.unloading import inflate
from heartfit.heart.heart import Heart
from heartfit.heart.simulation import Numerics, simulate
from heartfit.heart.sphere.body import Sphere, SphericalBody, Stiffness
from heartfit.heart.sphere.simulation import simulate_spheres
from heartfit.heart.time_step import TimeStep
from heartfit.mechanisms.pericardium import Pericardium
from heartfit.mechanisms.septal_load import SeptalLoad
from heartfit.roles import COMPARTMENTS, External, Mechanism, Pressure
from heartfit.roles.laws import Load, outside_pressure
from tests.shrinking import assert_derivative

DEPTH = 1500.0
TIGHT = Tolerances(force=1e-7, volume=1e-14, pressure=1e-4, iterations=60)
ONE_BEAT = Numerics(time_step=0.01, max_beats=1, tolerances=TIGHT)


@dataclass(frozen=True)
class Water(External):
    """A uniform constant pressure around the heart."""

    def load(self, ventricle: str, time: Floats, period: float) -> Load:
        return Load(pulse=DEPTH)


@dataclass(frozen=True)
class Depth(Pressure):
    """Adds the same pressure to all vessels."""

    compartments = COMPARTMENTS[2:]

    def pressure(self, compartment: str, time: Floats, period: float) -> Floats:
        return DEPTH + 0.0 * time


DIVING: tuple[Mechanism, ...] = (Water(), Depth())


def test_loads_add_up_with_their_slope() -> None:
    loads = np.array([[[Load(pulse=300.0)], [Load(50.0, 200.0, 1e-4, 2e-5)]]])
    pressure, slope = outside_pressure(loads, 0, 0, 1.3e-4)
    assert pressure == pytest.approx(350.0 + 200.0 * np.exp(1.5))
    assert slope == pytest.approx(200.0 * np.exp(1.5) / 2e-5)
    x, step = np.array([1.3e-4]), np.array([1e-5])
    assert_derivative(lambda V: np.array([outside_pressure(loads, 0, 0, V[0])[0]]), slope * step, x, step)


def test_a_septal_load_acts_on_the_left_ventricle_only() -> None:
    time = np.linspace(0.0, 0.8, 9)
    table = load_table((SeptalLoad(), Pericardium()), ("lv", "rv"), time, 0.8)
    assert table.shape == (9, 2, 2, 4)
    assert table[:, 0, 0, 0].max() > 0.5 * SeptalLoad().pressure
    assert not table[:, 0, 1, 0].any()
    assert (table[:, 1, 0] == table[:, 1, 1]).all()


def test_the_enclosed_stiffness_is_inverted_exactly() -> None:
    rng = np.random.default_rng(3)
    diagonal, u, w = rng.uniform(1.0, 2.0, (3, 5))
    right, full = rng.standard_normal((5, 3)), np.diag(diagonal) + np.outer(u, w)
    stiffness = EnclosedStiffness(Stiffness(diagonal), u, w)
    assert stiffness.solve(right) == pytest.approx(np.linalg.solve(full, right))
    assert stiffness.solve(right[:, 0]) == pytest.approx(np.linalg.solve(full, right[:, 0]))


def test_the_enclosed_sphere_resists_with_its_wall_and_its_load(spheres: SphericalBody) -> None:
    """Forces over the gradient of the volume are pressures; the load's exponential is that of the mean volume."""
    sac = Pericardium(pressure=900.0, volume=80e-6)
    x, step = np.array([[1e-3], [2e-3]]), TimeStep(0.0, 0.01, 0.8)
    bare = spheres.step(spheres.rest(), step).forces(x)
    enclosed = EnclosedBody(spheres, (sac,)).step(spheres.rest(), step).forces(x)
    outer = 900.0 * np.exp((spheres.volumes(x).mean() - 80e-6) / sac.growth)
    assert (enclosed - bare) / spheres.volume_gradients(x).diagonal() == pytest.approx([outer, outer])


@pytest.mark.parametrize("coupled", [True, False])
def test_a_uniform_external_pressure_does_not_change_the_beat(spherical_heart: Heart, coupled: bool) -> None:
    """The same pressure outside the walls and in all vessels leaves every volume, and raises every pressure by it."""
    left, right = Sphere.from_volumes(80e-6, 130e-6), Sphere.from_volumes(90e-6, 45e-6)
    diver = replace(spherical_heart, mechanisms=(*spherical_heart.mechanisms, *DIVING))
    body = SphericalBody(left, right, spherical_heart.tissue)
    on_land, below = (
        simulate(heart, body, ONE_BEAT) if coupled else simulate_spheres(heart, [left, right], ONE_BEAT)
        for heart in (spherical_heart, diver)
    )
    for side in ("lv", "rv"):
        assert below.volume[side] == pytest.approx(on_land.volume[side], abs=1e-11)
    for name, pressure in on_land.pressure.items():
        assert below.pressure[name][1:] - pressure[1:] == pytest.approx(DEPTH, abs=0.1), name


def test_a_uniform_external_pressure_does_not_change_the_beat_of_elements(
    coarse_body: FiniteElementBody,
) -> None:
    heart = Heart()
    atria, trees = heart.circulation.atrial(0.0, heart.period, ()), heart.circulation.start(heart.period)
    filled = inflate(coarse_body, atria)
    first = np.array([*atria, *(tree.P_c for tree in trees)])
    states = []
    for mechanisms in (heart.mechanisms, (*heart.mechanisms, *DIVING)):
        coupling = Coupling(coarse_body, heart.circulation, mechanisms, Tolerances(force=1e-5))
        state = HeartState(filled, first, coarse_body.volumes(filled.x), trees)
        for n in range(3):
            state = coupling.advance(state, TimeStep(0.01 * n, 0.01, heart.period, last=state.last))
        states.append(state)
    on_land, below = states
    assert below.volumes == pytest.approx(on_land.volumes, abs=1e-10)
    assert below.pressures - on_land.pressures == pytest.approx(DEPTH, abs=1.0)
    assert abs(on_land.volumes - coarse_body.volumes(filled.x)).min() > 1e-7, "the ventricle fills"


def test_a_variable_load_keeps_second_order(spherical_heart: Heart) -> None:
    """The volume of a ventricle that fills through a tight valve, under a sac and a pulse."""
    slow = replace(spherical_heart, circulation=Circulation(mitral=LinearValve(open=1e-7)), period=0.8)
    heart = slow + Pericardium(pressure=100.0, volume=80e-6) + SeptalLoad(200.0, peak=0.06, width=0.24)

    def filled(dt: float) -> float:
        beat = simulate_spheres(
            heart, [Sphere.from_volumes(80e-6, 130e-6)], Numerics(time_step=dt, max_beats=1)
        )
        return float(beat.volume["lv"][round(0.08 / dt)])

    fine = filled(0.08 / 512)
    errors = [abs(filled(0.08 / n) - fine) for n in (8, 16, 32)]
    assert errors[-1] > 1e-9
    assert np.log2(np.divide(errors[:-1], errors[1:])) == pytest.approx([2.0, 2.0], abs=0.3)
