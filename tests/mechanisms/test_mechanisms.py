"""Contracts of all mechanisms of the folder: one switch that turns it off, and the rules of its role."""

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np
import pytest

from heartfit.core.errors import InputError
from heartfit.core.parameter import parameter, parameters_of
from heartfit.geometry.mesh import VentricularMesh
from heartfit.heart.finite_elements.body import FiniteElementBody
from heartfit.heart.heart import Heart
from heartfit.heart.simulation import Numerics, simulate
from heartfit.heart.sphere.body import Sphere, SphericalBody
from heartfit.heart.sphere.simulation import simulate_spheres
from heartfit.heart.time_step import TimeStep
from heartfit.mechanisms.mitral_regurgitation import MitralRegurgitation
from heartfit.mechanisms.scar import Scar
from heartfit.roles import (
    Amendment,
    Availability,
    Chamber,
    Delay,
    External,
    Flow,
    Mechanism,
    Narrowing,
    Pressure,
    Relaxation,
    Sensor,
    Stress,
    mechanism,
    registered,
    registry,
)
from heartfit.roles.sides import acts_within
from heartfit.synthetic.campaign import plantable

PERIOD = 0.829
SANGUINE = (Flow, Narrowing, Pressure, Chamber, External)
MUSCULAR = (Amendment, Availability, Delay, Relaxation, Stress)
LEFT = Sphere.from_volumes(80e-6, 130e-6)
ONE_BEAT = Numerics(time_step=0.01, max_beats=1)
KINDS = registered()
IN_THE_BLOOD = {name: kind for name, kind in KINDS.items() if issubclass(kind, SANGUINE)}
MUSCLES = {name: kind for name, kind in KINDS.items() if issubclass(kind, MUSCULAR)}
SENSORS = {name: kind for name, kind in KINDS.items() if issubclass(kind, Sensor)}


def parametrize_kinds(kinds: dict[str, type[Mechanism]]) -> pytest.MarkDecorator:
    return pytest.mark.parametrize("kind", kinds.values(), ids=kinds.keys())


def test_the_folder_is_the_registry() -> None:
    assert {"AtrialKick", "MitralRegurgitation", "ImageShrinkage"} <= KINDS.keys()
    assert KINDS.keys() == IN_THE_BLOOD.keys() | MUSCLES.keys() | SENSORS.keys()


@parametrize_kinds(KINDS)
def test_one_parameter_turns_a_mechanism_off(kind: type[Mechanism]) -> None:
    assert sum(declared.off is not None for declared in parameters_of(kind)) == 1
    off = {declared.name: declared.value for declared in parameters_of(kind().turned_off())}
    assert off[kind.switch().name] == kind.switch().off
    assert kind().turned_off() != kind()


def test_a_search_of_the_left_ventricle_tries_all_but_three_valves_and_the_atria() -> None:
    unsearched = {name for name, kind in KINDS.items() if kind.switch().scale is None}
    valves = {"AorticDynamics", "PulmonaryDynamics", "TricuspidDynamics"}
    assert unsearched == valves | {"LeftAtrium", "RightAtrium"}
    assert unsearched.isdisjoint(plantable())
    assert all(acts_within(kind, 1) for kind in plantable().values())


@parametrize_kinds({name: kind for name, kind in KINDS.items() if kind.switch().scale is not None})
def test_a_search_knows_its_size(kind: type[Mechanism]) -> None:
    """One to two scales are an admissible mechanism."""
    switch = kind.switch()
    assert switch.scale > 0.0
    for x in (1.0, 2.0):
        assert replace(kind(), **{switch.name: switch.at(x)}) != kind().turned_off()  # type: ignore[type-var]


def forces(body: FiniteElementBody | SphericalBody, x: np.ndarray) -> np.ndarray:
    """Internal forces of a body that oscillates by ``x`` once in a period, in 20 steps."""
    state, result = body.rest(), []
    for n in range(20):
        step = body.step(
            state, TimeStep(n * PERIOD / 20, PERIOD / 20, PERIOD, True, PERIOD / 20 if n else None)
        )
        displaced = np.sin(2.0 * np.pi * (n + 1) / 20) * x
        result.append(step.forces(displaced))
        state = step.commit(displaced)
    return np.array(result)


def bodies_of(
    hearts: list[Heart], mesh: VentricularMesh
) -> Iterator[tuple[list[FiniteElementBody] | list[SphericalBody], np.ndarray]]:
    """Meshes and spheres made of the muscle of the hearts, and the displacements imposed on them."""
    turn = np.array([[0.0, 0.1, 0.05], [0.05, 0.0, 0.1], [0.1, 0.05, 0.0]])
    x = np.zeros((len(mesh.points), 4))
    x[:, :3] = (mesh.points - mesh.points.mean(axis=0)) @ turn
    yield [FiniteElementBody(mesh, heart.muscle) for heart in hearts], x
    yield [SphericalBody(LEFT, LEFT, heart.muscle) for heart in hearts], np.full((2, 1), 4e-3)


@parametrize_kinds(MUSCLES)
def test_muscle_that_is_switched_off_is_the_same_muscle(
    kind: type[Mechanism], spherical_heart: Heart, ventricle: VentricularMesh
) -> None:
    """Equal to the bit on the mesh, on the spheres and in their compiled beat."""
    hearts = [spherical_heart, spherical_heart + kind().turned_off(), spherical_heart + kind()]
    for bodies, x in bodies_of(hearts, ventricle):
        without, off, on = (forces(body, x) for body in bodies)
        assert (off == without).all()
        assert abs(on - without).max() > 1e-3 * abs(without).max()
    beats = [simulate_spheres(heart, [LEFT, LEFT], ONE_BEAT) for heart in hearts]
    curves = [
        np.array([*beat.volume.values(), *(1e-8 * beat.pressure[side] for side in ("lv", "rv"))])
        for beat in beats
    ]
    assert (curves[1] == curves[0]).all()
    assert abs(curves[2] - curves[0]).max() > 1e-7


@parametrize_kinds({name: kind for name, kind in MUSCLES.items() if issubclass(kind, Availability)})
def test_lost_bridges_are_a_share_and_the_remote_region_keeps_its_own(kind: type[Availability]) -> None:
    lost = kind().lost_share()
    assert lost.shape == (18,)
    assert ((lost >= 0.0) & (lost <= 1.0)).all()
    assert lost[0] == lost.min() == 0.0 < lost.max()


@parametrize_kinds({name: kind for name, kind in MUSCLES.items() if issubclass(kind, Delay)})
def test_a_delay_never_advances_activation_and_keeps_the_earliest_region(kind: type[Delay]) -> None:
    delay = kind().delay()
    assert delay.shape == (18,)
    assert delay[0] == delay.min() == 0.0 < delay.max()


@parametrize_kinds({name: kind for name, kind in MUSCLES.items() if issubclass(kind, Relaxation)})
def test_a_tail_slows_relaxation_and_never_reverses_it(kind: type[Relaxation]) -> None:
    time = np.linspace(0.0, 0.8, 1601)
    share = np.diff(kind().missing_integral(time)) / np.diff(time)
    assert kind().missing_integral(np.zeros(1)) == 0.0
    assert ((share >= 0.0) & (share < 1.0)).all()
    assert share.any()


@parametrize_kinds({name: kind for name, kind in MUSCLES.items() if issubclass(kind, Amendment)})
def test_an_amendment_is_of_a_declared_constant(kind: type[Amendment], spherical_heart: Heart) -> None:
    value = spherical_heart.parameters()[f"tissue.{kind.amends}"]
    assert kind().turned_off().amend(value, PERIOD) == value
    amended = (spherical_heart + kind()).muscle
    for name in kind.amends.split("."):
        amended = getattr(amended, name)
    assert amended == kind().amend(value, PERIOD) != value


def test_a_body_without_the_mechanisms_of_the_heart_is_refused(
    spherical_heart: Heart, spheres: SphericalBody
) -> None:
    with pytest.raises(InputError, match=r"body.*mechanisms"):
        simulate(spherical_heart + Scar(), spheres, ONE_BEAT)


@pytest.fixture(scope="module")
def sampled() -> tuple[np.ndarray, np.ndarray]:
    """Any curve at the times of a beat, the trigger inside a step."""
    return np.arange(166) * PERIOD / 166 - 0.1733, 1e4 * (1.0 + np.random.default_rng(5).random(166))


@parametrize_kinds(SENSORS)
def test_a_sensor_that_is_off_changes_no_curve(
    kind: type[Sensor], sampled: tuple[np.ndarray, np.ndarray]
) -> None:
    times, values = sampled
    assert (kind().turned_off().distort(times, values, PERIOD) == values).all()
    assert abs(kind().distort(times, values, PERIOD) - values).max() > 1e-2 * np.ptp(values)


@parametrize_kinds(SENSORS)
def test_a_sensor_has_the_time_zero_of_its_curve(
    kind: type[Sensor], sampled: tuple[np.ndarray, np.ndarray]
) -> None:
    """Instruments are affine: an offset of the whole curve is an offset of the recorded one."""
    times, values = sampled
    shown, raised = (kind().distort(times, curve, PERIOD) for curve in (values, values + 3e3))
    assert raised - shown == pytest.approx(np.full(166, 3e3), rel=1e-9)


def test_sensors_do_not_change_the_heart(spherical_heart: Heart, spheres: SphericalBody) -> None:
    observed = replace(
        spherical_heart, mechanisms=(*spherical_heart.mechanisms, *(k() for k in SENSORS.values()))
    )
    plain, measured = (simulate(heart, spheres, ONE_BEAT) for heart in (spherical_heart, observed))
    assert [type(sensor) for sensor in observed.sensors] == list(SENSORS.values())
    assert spherical_heart.sensors == ()
    for name, values in plain.signals().items():
        assert (measured.signals()[name] == values).all(), name
    assert {name for kind in SENSORS.values() for name in kind.measures} <= plain.signals().keys()


def test_a_mechanism_without_role_or_with_a_taken_name_is_refused() -> None:
    with pytest.raises(TypeError, match=r"Stray.*\['Amendment', .*'Flow', .*'Sensor'\]"):

        @mechanism
        class Stray(Mechanism):
            pass

    with pytest.raises(TypeError, match=r"MitralRegurgitation.*registered"):
        mechanism(type("MitralRegurgitation", (MitralRegurgitation,), {}))


def test_a_mechanism_without_switch_is_refused() -> None:
    @dataclass(frozen=True)
    class Constant(Pressure):
        height: float = parameter(1.0, unit="Pa", symbol="h", meaning="height")

    with pytest.raises(TypeError, match=r"Constant.*\b0\b"):
        mechanism(Constant)
    assert "Constant" not in registered()


@pytest.fixture
def separate_registry(monkeypatch: pytest.MonkeyPatch) -> None:
    """A registry whose additions end with the test."""
    monkeypatch.setattr(registry, "_REGISTRY", dict(registered()))


def pressure_loss(compartments: object = ("left_atrium",), methods: bool = True) -> type[Pressure]:
    """A mechanism as a notebook defines it, not yet registered."""

    @dataclass(frozen=True)
    class PressureLoss(Pressure):
        loss: float = parameter(300.0, unit="Pa", symbol="a", meaning="loss", off=0.0, scale=750.0)
        if methods:

            def pressure(self, compartment, time, period):  # type: ignore[no-untyped-def]
                return -self.loss + 0.0 * time

    if compartments is not None:
        PressureLoss.compartments = compartments  # type: ignore[assignment]
    return PressureLoss


@pytest.mark.usefixtures("separate_registry")
def test_a_cell_that_is_run_again_replaces_its_mechanism() -> None:
    mechanism(pressure_loss())
    again = mechanism(pressure_loss())
    assert registered()["PressureLoss"] is again


@pytest.mark.parametrize(
    ("compartments", "message"),
    [
        (("la",), r"PressureLoss\.compartments = .*'la' is unknown; expected one of aorta, .*left_atrium"),
        (("lv",), "'lv' is unknown"),
        ("aorta", r"compartments = 'aorta'; expected a tuple: write \('aorta',\)"),
        (None, "PressureLoss states no compartments; expected one of aorta"),
    ],
)
@pytest.mark.usefixtures("separate_registry")
def test_a_compartment_that_does_not_exist_is_refused_at_definition(
    compartments: object, message: str
) -> None:
    with pytest.raises(TypeError, match=message):
        mechanism(pressure_loss(compartments))
    assert "PressureLoss" not in registered()


@pytest.mark.parametrize(
    ("role", "attributes", "message"),
    [
        (Flow, {"upstream": "lv", "downstream": "la"}, r"Wrong\.downstream = 'la'"),
        (Narrowing, {"valve": "bicuspid"}, "expected one of mitral, aortic"),
        (Chamber, {"compartment": "lv"}, "expected one of left_atrium, right_atrium"),
        (Stress, {"acts_on": "fiber"}, "expected one of wall, fibre"),
        (Sensor, {"measures": "lv_volume"}, "expected a tuple"),
        (Amendment, {}, "states no amends"),
    ],
)
@pytest.mark.usefixtures("separate_registry")
def test_every_role_names_what_exists(
    role: type[Mechanism], attributes: dict[str, str], message: str
) -> None:
    methods = dict.fromkeys(role.__abstractmethods__, lambda self, *_: None)
    declared = parameter(1.0, unit="1", symbol="a", meaning="size", off=0.0)
    content = methods | attributes | {"size": declared, "__annotations__": {"size": float}}
    with pytest.raises(TypeError, match=message):
        mechanism(dataclass(frozen=True)(type("Wrong", (role,), content)))


@pytest.mark.usefixtures("separate_registry")
def test_a_role_without_its_method_or_its_fields_is_refused_at_definition() -> None:
    with pytest.raises(TypeError, match=r"PressureLoss lacks pressure\(\): define it"):
        mechanism(pressure_loss(methods=False))
    with pytest.raises(TypeError, match="Undecorated is no dataclass: write @dataclass"):

        @mechanism
        class Undecorated(MitralRegurgitation):
            pass


@pytest.mark.parametrize(
    ("values", "message"),
    [
        ({"area": 0.4}, r"area = 0\.4 m\^2: expected at most 0\.01 m\^2 .*: convert it to m\^2"),
        ({"area": 20.0}, "convert"),
    ],
)
def test_a_number_in_another_unit_is_refused(values: dict[str, float], message: str) -> None:
    with pytest.raises(InputError, match=message):
        MitralRegurgitation(**values)
    with pytest.raises(InputError, match=r"Pericardium\.volume = 150 m\^3: expected at most 0\.01 m\^3"):
        KINDS["Pericardium"](volume=150.0)  # type: ignore[call-arg]
    with pytest.raises(InputError, match=r"AtrialKick\.peak = 140 s: expected at most 60 s"):
        KINDS["AtrialKick"](peak=140.0, end=200.0)  # type: ignore[call-arg]
