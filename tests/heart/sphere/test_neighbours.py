"""A few beats from the limit cycle of a near heart give the limit cycle that a run from relaxed ventricles ends on."""

from dataclasses import replace

import numpy as np
import pytest

from heartfit.core.arrays import Floats
from heartfit.heart.heart import Heart
from heartfit.heart.simulation import Numerics
from heartfit.heart.sphere.body import HEALTHY_ACTIVATION, Sphere
from heartfit.heart.sphere.heart import Inertia, SphericalHeart
from heartfit.heart.sphere.neighbours import Neighbours
from heartfit.heart.sphere.simulation import LimitCycle, SphereRun
from heartfit.mechanisms.aortic_regurgitation import AorticRegurgitation
from heartfit.mechanisms.left_atrium import LeftAtrium
from heartfit.mechanisms.pericardium import Pericardium
from heartfit.mechanisms.scar import Scar

LEFT, RIGHT = Sphere.from_volumes(80e-6, 130e-6), Sphere.from_volumes(90e-6, 45e-6)
SEARCHED = Numerics(time_step=5e-3, max_beats=30, drift=1e-5)
TIGHT = replace(SEARCHED, drift=1e-11, max_beats=90)
CHANGES = ("R_p", "tau", "sigma_0", "k_RS", "c_1", "mu", "left_atrium", "circulation.systemic.Z_c", "extent")
STEP = 2e-3
"""Relative change of a parameter."""


def spheres(heart: Heart, *shapes: Sphere) -> SphericalHeart:
    return SphericalHeart(heart, shapes or (LEFT,), HEALTHY_ACTIVATION, Inertia(density=1060.0), True)


def changed(heart: Heart, name: str, factor: float = 1.0 + STEP) -> Heart:
    path = heart.parameter_path(name)
    return heart.with_parameters({path: factor * heart.parameters()[path]})


def limit_cycle(heart: SphericalHeart, numerics: Numerics) -> LimitCycle:
    return SphereRun(heart, numerics).to_limit_cycle()


def scaled(cycle: LimitCycle) -> Floats:
    """Volumes and pressures of the ventricles over their ranges."""
    curves = [*cycle.beat.volume.values(), *(cycle.beat.pressure[name] for name in cycle.beat.volume)]
    return np.array([curve / np.ptp(curve) for curve in curves])


@pytest.mark.parametrize("shapes", [(LEFT,), (LEFT, RIGHT)], ids=["left", "both"])
@pytest.mark.parametrize("name", CHANGES)
def test_a_neighbour_is_on_its_limit_cycle(spherical_heart: Heart, name: str, shapes: tuple[Sphere, ...]):
    heart = spherical_heart + Pericardium() + AorticRegurgitation(1e-5) + Scar(extent=0.2)
    near = Neighbours(limit_cycle(spheres(heart, *shapes), SEARCHED), SEARCHED)
    cycles = [near.limit_cycle(spheres(changed(heart, name), *shapes))]
    cycles += [limit_cycle(spheres(one, *shapes), TIGHT) for one in (changed(heart, name), heart)]
    neighbour, expected, centre = map(scaled, cycles)
    change = np.abs(expected - centre).max()
    assert change > 10.0 * SEARCHED.drift
    assert np.abs(neighbour - expected).max() < 1e-8
    assert cycles[0].beat.diagnostics["beats"] <= 3


def test_a_neighbour_takes_few_beats_of_one_iteration_a_step(spherical_heart: Heart):
    near = Neighbours(limit_cycle(spheres(spherical_heart), SEARCHED), SEARCHED)
    diagnostics = near.limit_cycle(spheres(changed(spherical_heart, "R_p", 1.0005))).beat.diagnostics
    steps = diagnostics["beats"] * round(spherical_heart.period / SEARCHED.time_step)
    assert diagnostics["beats"] <= 3
    assert steps <= diagnostics["iterations"] < 1.3 * steps


@pytest.mark.parametrize("name", ["k_RS", "c_1"])
def test_walls_that_remember_the_last_beat_take_no_further_one(spherical_heart: Heart, name: str):
    heart = changed(spherical_heart, "mu", 2.0)
    near = Neighbours(limit_cycle(spheres(heart), SEARCHED), SEARCHED)
    assert near.limit_cycle(spheres(changed(heart, name, 1.005))).beat.diagnostics["beats"] <= 3


def test_the_state_of_a_neighbour_beats_on(spherical_heart: Heart):
    near = Neighbours(limit_cycle(spheres(spherical_heart), SEARCHED), SEARCHED)
    neighbour = spheres(changed(spherical_heart, "R_p"))
    cycle = near.limit_cycle(neighbour)
    state, curves = neighbour.take_over(cycle.state), np.full_like(cycle.curves, np.nan)
    SphereRun(neighbour, SEARCHED).run_beat(state, curves)
    volume = cycle.beat.volume["lv"]
    assert curves[:, 0] == pytest.approx(volume, abs=1e-6 * np.ptp(volume))


def test_the_centre_is_its_own_neighbour_and_stays_unchanged(spherical_heart: Heart):
    centre = limit_cycle(spheres(spherical_heart), SEARCHED)
    kept = centre.state.sides.copy()
    near = Neighbours(centre, SEARCHED)
    again = near.limit_cycle(centre.heart)
    assert np.array_equal(centre.state.sides, kept)
    expected = scaled(limit_cycle(centre.heart, TIGHT))
    assert np.abs(scaled(again) - expected).max() < 1e-8 < np.abs(scaled(centre) - expected).max()


def test_a_far_heart_is_no_neighbour(spherical_heart: Heart):
    near = Neighbours(limit_cycle(spheres(spherical_heart), SEARCHED), SEARCHED)
    assert near.limit_cycle(spheres(changed(spherical_heart, "R_p", 3.0))) is None
    assert near.limit_cycle(spheres(changed(spherical_heart, "c_1", 1e-6))) is None


def test_atria_with_a_volume_are_rejected(spherical_heart: Heart):
    centre = limit_cycle(spheres(spherical_heart + LeftAtrium()), replace(SEARCHED, max_beats=2))
    with pytest.raises(ValueError, match=r"an atrium of the centre has a volume, expected prescribed"):
        Neighbours(centre, SEARCHED)
