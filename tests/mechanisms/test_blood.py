"""Contracts of the roles that act on the blood, on spheres and on elements."""

from dataclasses import replace

import numpy as np
import pytest

from heartfit.heart.finite_elements.body import FiniteElementBody
from heartfit.heart.heart import Heart
from heartfit.heart.simulation import Numerics, simulate
from heartfit.heart.sphere.body import Sphere, SphericalBody
from heartfit.heart.sphere.simulation import simulate_spheres
from heartfit.mechanisms.mitral_regurgitation import MitralRegurgitation
from heartfit.roles import COMPARTMENTS, External, Flow, Mechanism, Narrowing, Pressure, registered
from heartfit.roles.laws import BLOOD_DENSITY
from heartfit.roles.sides import VALVES
from tests.shrinking import assert_derivative

PERIOD = 0.829
LEFT, RIGHT = Sphere.from_volumes(80e-6, 130e-6), Sphere.from_volumes(90e-6, 45e-6)
ONE_BEAT = Numerics(time_step=0.01, max_beats=1)


def kinds_with_role(role: type[Mechanism]) -> dict[str, type]:
    return {name: kind for name, kind in registered().items() if issubclass(kind, role)}


FLOWS, NARROWINGS, PRESSURES, EXTERNALS = map(kinds_with_role, (Flow, Narrowing, Pressure, External))
ALL = FLOWS | NARROWINGS | PRESSURES | EXTERNALS


def parametrize_kinds(kinds: dict[str, type]) -> pytest.MarkDecorator:
    return pytest.mark.parametrize("kind", kinds.values(), ids=kinds.keys())


@parametrize_kinds(ALL)
@pytest.mark.parametrize("compiled", [True, False])
def test_a_mechanism_that_is_off_changes_no_bit(
    kind: type[Mechanism], compiled: bool, spherical_heart: Heart, spheres: SphericalBody
) -> None:
    """Equal to the bit in every curve; a mechanism that is on changes a curve."""
    others = tuple(m for m in spherical_heart.mechanisms if type(m) is not kind)
    without, off, on = (
        simulate_spheres(heart, [LEFT, RIGHT], ONE_BEAT) if compiled else simulate(heart, spheres, ONE_BEAT)
        for heart in (
            replace(spherical_heart, mechanisms=(*others, *added))
            for added in ((), (kind().turned_off(),), (kind(),))
        )
    )
    for name, curve in without.signals().items():
        assert (off.signals()[name] == curve).all(), name
    assert any(not np.allclose(on.pressure[v], without.pressure[v], rtol=1e-3) for v in ("lv", "rv"))


def test_mechanisms_that_are_off_do_not_change_elements(coarse_body: FiniteElementBody) -> None:
    """All mechanisms together, over a beat of long steps, equal to the bit."""
    few = replace(ONE_BEAT, time_step=0.02)
    heart = replace(Heart(), mechanisms=())
    plain, off = (
        simulate(case, coarse_body, few)
        for case in (heart, replace(heart, mechanisms=tuple(kind().turned_off() for kind in ALL.values())))
    )
    for name, curve in plain.signals().items():
        assert (off.signals()[name] == curve).all(), name


@parametrize_kinds(NARROWINGS)
def test_a_narrowing_grows_with_its_switch_and_names_a_valve(kind: type[Narrowing]) -> None:
    switch = kind.switch()
    size = switch.scale or switch.value
    widths = [replace(kind(), **{switch.name: x * size}).inverse_square() for x in (0.0, 1.0, 2.0)]
    assert kind.valve in VALVES
    assert widths[0] == 0.0 < widths[1] < widths[2]


@parametrize_kinds(EXTERNALS)
def test_loads_are_continuous_periodic_and_grow_with_volume(kind: type[External]) -> None:
    """At least one of the ventricles has a nonzero load."""
    time, nonzero = np.linspace(0.0, PERIOD, 4001), False
    for ventricle in COMPARTMENTS[:2]:
        pulse, rise, volume, scale = (
            np.broadcast_to(coefficient, 4001) for coefficient in kind().load(ventricle, time, PERIOD)
        )
        later = kind().load(ventricle, time + PERIOD, PERIOD)
        assert np.broadcast_to(later.pulse, 4001) == pytest.approx(pulse, abs=1e-6)
        assert abs(np.diff(pulse, append=pulse[0])).max() <= 0.01 * np.ptp(pulse)
        assert (rise >= 0.0).all()
        assert (scale > 0.0).all()
        nonzero = nonzero or bool((pulse + rise * (volume >= 0.0)).any())
    assert nonzero


@parametrize_kinds(PRESSURES)
def test_pressures_are_continuous_and_periodic(kind: type[Pressure]) -> None:
    time = np.linspace(0.0, PERIOD, 4001)
    for compartment in kind.compartments:
        curve = kind().pressure(compartment, time, PERIOD)
        again = np.array([kind().pressure(compartment, t + PERIOD, PERIOD) for t in time])
        assert again == pytest.approx(curve, abs=1e-6)
        assert abs(np.diff(curve)).max() <= 0.01 * np.ptp(curve)
        assert curve[-1] == pytest.approx(curve[0], abs=1e-6)


@parametrize_kinds(PRESSURES)
def test_pressures_act_on_atria_and_arteries(kind: type[Pressure]) -> None:
    """The ventricles' pressure follows from their walls; pressure on the walls is an External."""
    assert set(kind.compartments) <= set(COMPARTMENTS[2:])
    for compartment in kind.compartments:
        assert kind().pressure(compartment, np.linspace(0.0, PERIOD, 100), PERIOD).any()


@parametrize_kinds(FLOWS)
def test_flows_follow_the_gradient_with_their_slope(kind: type[Flow]) -> None:
    assert {kind.upstream, kind.downstream} <= set(COMPARTMENTS)
    drops = np.linspace(-1e4, 1e4, 2001)
    flows = np.array([kind().flow(0.3, drop)[0] for drop in drops])
    assert (flows * drops >= 0.0).all()
    assert (np.diff(flows) >= 0.0).all()
    assert flows.any()
    for drop in (5.0, 80.0, 7e3):
        x, step = np.array([drop]), np.array([0.1 * drop])
        slope = kind().flow(0.3, drop)[1] * step
        assert_derivative(lambda p: np.array([kind().flow(0.3, p[0])[0]]), slope, x, step)


@parametrize_kinds(FLOWS)
def test_blood_is_conserved_with_another_branch(
    kind: type[Flow], spherical_heart: Heart, spheres: SphericalBody
) -> None:
    """Volumes of the ventricles change by the flow of their branches in every step."""
    beat = simulate(spherical_heart + kind(), spheres, replace(ONE_BEAT, max_beats=2))
    net = {
        "lv": beat.flow["mitral"] - beat.flow["aortic"],
        "rv": beat.flow["tricuspid"] - beat.flow["pulmonary"],
    }
    for name in (kind.upstream, kind.downstream):
        sign = -1.0 if name == kind.upstream else 1.0
        if name in net:
            net[name] = net[name] + sign * beat.flow[kind.__name__]
    dt = beat.time[1] - beat.time[0]
    for side, inflow in net.items():
        V = beat.volume[side]
        assert 1.5 * V[2:] - 2.0 * V[1:-1] + 0.5 * V[:-2] == pytest.approx(dt * inflow[2:], abs=1e-9)


def test_leaks_act_on_finite_elements(coarse_body: FiniteElementBody) -> None:
    """Mitral regurgitation takes from the forward stroke volume what it gives back to the atrium."""
    healthy, leaking = (
        simulate(heart, coarse_body, ONE_BEAT)
        for heart in (Heart(), Heart() + MitralRegurgitation(area=0.4e-4))
    )
    assert (healthy.reason, leaking.reason) == ("", "")
    forward = [np.trapezoid(beat.flow["aortic"], beat.time) for beat in (healthy, leaking)]
    assert forward[1] < 0.9 * forward[0]
    assert np.trapezoid(leaking.flow["MitralRegurgitation"], leaking.time) > 10e-6


def test_the_mitral_leak_is_an_orifice_between_left_ventricle_and_left_atrium(
    spherical_heart: Heart, spheres: SphericalBody
) -> None:
    beat = simulate(spherical_heart + MitralRegurgitation(area=0.4e-4), spheres, ONE_BEAT)
    drop = beat.pressure["lv"] - beat.pressure["left_atrium"]
    systole = drop > 1e3
    jet = 0.4e-4 * np.sqrt(2.0 * drop[systole] / BLOOD_DENSITY)
    assert beat.flow["MitralRegurgitation"][systole] == pytest.approx(jet, rel=1e-3)
    assert not beat.flow["MitralRegurgitation"][drop < 0.0].any()
