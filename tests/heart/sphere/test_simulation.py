"""The compiled beat of spheres equals the beat of the coupled path step by step, including its failures."""

from dataclasses import dataclass, replace

import numpy as np
import pytest

from heartfit.core.arrays import Floats
from heartfit.core.parameter import parameter
from heartfit.heart.beat import Beat
from heartfit.heart.circulation.coupling import Tolerances
from heartfit.heart.circulation.elements import OrificeValve
from heartfit.heart.circulation.network import Circulation
from heartfit.heart.finite_elements import unloading
from heartfit.heart.heart import Heart
from heartfit.heart.simulation import Numerics, simulate
from heartfit.heart.sphere import simulation
from heartfit.heart.sphere.beat import SphereTissue, State, StepInputs, advance
from heartfit.heart.sphere.body import Sphere, SphericalBody
from heartfit.heart.sphere.rows import UNBALANCED
from heartfit.heart.sphere.simulation import FAILURE_REASONS, simulate_spheres
from heartfit.mechanisms.aortic_stenosis import AorticStenosis
from heartfit.mechanisms.arterial_reflection import ArterialReflection
from heartfit.mechanisms.atrial_surge import AtrialSurge
from heartfit.mechanisms.delayed_activation import DelayedActivation
from heartfit.mechanisms.left_atrium import LeftAtrium
from heartfit.mechanisms.mitral_dynamics import MitralDynamics
from heartfit.mechanisms.mitral_regurgitation import MitralRegurgitation
from heartfit.mechanisms.pericardium import Pericardium
from heartfit.mechanisms.right_atrium import RightAtrium
from heartfit.mechanisms.scar import Scar
from heartfit.mechanisms.septal_load import SeptalLoad
from heartfit.mechanisms.slow_relaxation import SlowRelaxation
from heartfit.mechanisms.wall_viscosity import WallViscosity
from heartfit.places import PLACES
from heartfit.roles import Flow, Sensor
from heartfit.roles.laws import Branch
from tests.printed import numbers_in

LEFT, RIGHT = Sphere.from_volumes(80e-6, 130e-6), Sphere.from_volumes(90e-6, 45e-6)
ONE_CLASS = np.array([0.03])
TWO_BEATS = Numerics(time_step=0.01, max_beats=2, drift=0.0)
TIGHT = Tolerances(force=1e-7, volume=1e-14, pressure=1e-4, iterations=60)
BOTH = pytest.mark.parametrize("second_order", [False, True])


@dataclass(frozen=True)
class Shunt(Flow):
    """A hole between the ventricles that opens and closes within the beat."""

    upstream, downstream = "lv", "rv"
    area: float = parameter(1e-5, unit="m^2", symbol="A", meaning="area", off=0.0)

    def law(self, time: Floats) -> Branch:
        area = self.area * np.sin(2.0 * np.pi * time) ** 2
        return Branch(area=area, back_area=area)


@pytest.fixture(scope="module")
def heart(spherical_heart: Heart) -> Heart:
    """Orifices, length dependence and a mechanism of every kind, one between the ventricles and variable in time."""
    circulation = Circulation(mitral=OrificeValve(area=5e-4), aortic=OrificeValve())
    heart = replace(spherical_heart, circulation=circulation) + MitralRegurgitation() + Shunt()
    heart = heart + AorticStenosis() + ArterialReflection() + Pericardium(volume=80e-6) + SeptalLoad()
    for mechanism in (Scar(), DelayedActivation(), SlowRelaxation(), WallViscosity()):
        heart = heart + mechanism
    return heart.with_parameters({"slope": 0.5})


@pytest.fixture(scope="module")
def inviscid() -> Heart:
    """Strong muscle without any viscosity, which long steps do not get through."""
    return Heart().with_parameters({"sigma_0": 400e3, "mu": 0.0, "eta": 0.0})


def departures(beat: Beat, other: Beat) -> dict[str, float]:
    """Largest difference of every curve over its range."""
    signals, others = beat.signals(), other.signals()
    assert beat.completed
    assert other.completed
    assert signals.keys() == others.keys()
    return {name: float(abs(signals[name] - others[name]).max() / np.ptp(others[name])) for name in signals}


@BOTH
def test_the_compiled_beat_is_that_of_the_coupled_path(
    heart: Heart, second_order: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Volumes, pressures and flows of every branch, over three beats; the second shift measures the response."""
    monkeypatch.setattr(unloading, "INFLATION_FORCE_TOLERANCE", 1e-9)
    numerics = replace(TWO_BEATS, max_beats=3, second_order=second_order, tolerances=TIGHT)
    coupled = simulate(heart, SphericalBody(LEFT, RIGHT, heart.muscle), numerics)
    compiled = simulate_spheres(heart, [LEFT, RIGHT], numerics)
    assert max(departures(compiled, coupled).values()) < 1e-7
    assert compiled.diagnostics["drift"] == pytest.approx(coupled.diagnostics["drift"], rel=1e-4)
    assert (compiled.time == coupled.time).all()
    assert (compiled.period, compiled.trigger) == (coupled.period, coupled.trigger)


def test_a_function_at_every_place_acts_alike_on_both_paths(
    spherical_heart: Heart, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The coupled path is that of the 3-D heart: a place acts there as it does in the search."""
    monkeypatch.setattr(unloading, "INFLATION_FORCE_TOLERANCE", 1e-9)
    rng, heart = np.random.default_rng(6), spherical_heart
    for place in PLACES:
        if not issubclass(place, Sensor):
            z = 0.1 * rng.standard_normal(place.size)
            heart = heart + place.from_standardised(abs(z) if place.one_sided else z, heart.period)
    numerics = replace(TWO_BEATS, tolerances=TIGHT)
    coupled = simulate(heart, SphericalBody(LEFT, RIGHT, heart.muscle), numerics)
    compiled = simulate_spheres(heart, [LEFT, RIGHT], numerics)
    assert {"LeakFlow_flow", "BackflowPassage_flow"} <= compiled.signals().keys()
    assert max(departures(compiled, coupled).values()) < 2e-6, "the law of the wall is tabulated"
    plain = simulate_spheres(spherical_heart, [LEFT, RIGHT], numerics)
    assert np.ptp(compiled.volume["lv"] - plain.volume["lv"]) > 1e-6


@BOTH
@pytest.mark.parametrize("veins", [(0.0, 0.0), (8e6, 2e6), (8e6, 0.0)], ids=["open", "closed", "half"])
def test_compiled_atria_are_those_of_the_coupled_path(
    heart: Heart, second_order: bool, veins: tuple[float, float], monkeypatch: pytest.MonkeyPatch
) -> None:
    """Volumes of the atria too, with leaflets, waves, loads and the descent of a plane."""
    monkeypatch.setattr(unloading, "INFLATION_FORCE_TOLERANCE", 1e-9)
    heart = heart + LeftAtrium(descent=0.2, veins=veins[0]) + RightAtrium(veins=veins[1]) + AtrialSurge()
    heart = heart + MitralDynamics()
    numerics = replace(TWO_BEATS, second_order=second_order, tolerances=TIGHT)
    coupled = simulate(heart, SphericalBody(LEFT, RIGHT, heart.muscle), numerics)
    compiled = simulate_spheres(heart, [LEFT, RIGHT], numerics)
    assert {"left_atrium_volume", "right_atrium_volume"} <= compiled.signals().keys()
    assert max(departures(compiled, coupled).values()) < 1e-7
    assert compiled.diagnostics["drift"] == pytest.approx(coupled.diagnostics["drift"], rel=1e-4)


def test_a_single_left_ventricle_beats_as_beside_a_right_one(spherical_heart: Heart) -> None:
    heart = spherical_heart + MitralRegurgitation()
    alone, both = (simulate_spheres(heart, spheres, TWO_BEATS) for spheres in ([LEFT], [LEFT, RIGHT]))
    assert alone.volume.keys() == {"lv"}
    assert alone.pressure.keys() == {"lv", "aorta", "left_atrium"}
    assert alone.flow.keys() == {"mitral", "aortic", "MitralRegurgitation"}
    kept = {name: curve for name, curve in both.signals().items() if name in alone.signals()}
    for name, curve in alone.signals().items():
        assert curve == pytest.approx(kept[name], abs=1e-6 * np.ptp(curve))


def test_one_fibre_class_is_many_of_the_same_time(spherical_heart: Heart) -> None:
    one, many = (
        simulate_spheres(spherical_heart, [LEFT], TWO_BEATS, times)
        for times in (ONE_CLASS, np.repeat(ONE_CLASS, 4))
    )
    assert max(departures(one, many).values()) < 1e-9


@BOTH
def test_blood_is_conserved_step_by_step(heart: Heart, second_order: bool) -> None:
    """The mean flow of a step is (q + b q# of the step before) / (1 + b), whatever the branches."""
    beat = simulate_spheres(heart, [LEFT, RIGHT], replace(TWO_BEATS, max_beats=1, second_order=second_order))
    flow, dt = beat.flow, beat.time[1]
    net = flow["mitral"] - flow["aortic"] - flow["MitralRegurgitation"] - flow["Shunt"]
    right = flow["tricuspid"] - flow["pulmonary"] + flow["Shunt"]
    for side, inflow in (("lv", net), ("rv", right)):
        mean = np.diff(beat.volume[side]) / dt
        expected = (2.0 * inflow[2:] + mean[:-1]) / 3.0 if second_order else inflow[2:]
        assert mean[1:] == pytest.approx(expected, abs=1e-3 * 1e-6)


def test_cut_steps_recover_the_beat(inviscid: Heart) -> None:
    coarse, fine = (
        simulate_spheres(inviscid, [LEFT], replace(TWO_BEATS, time_step=dt)) for dt in (0.02, 0.0025)
    )
    assert coarse.diagnostics["step_cuts"] > 0
    assert fine.diagnostics["step_cuts"] == 0
    assert coarse.volume["lv"].min() == pytest.approx(fine.volume["lv"].min(), rel=0.05)


@pytest.mark.parametrize("failing", [0, 16, 52, 82])
def test_a_step_taken_in_halves_ends_where_the_whole_one_does(
    spherical_heart: Heart, failing: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Except for the error of one step: at its time, 16 in contraction, 52 in relaxation, and in its row."""
    whole = simulate_spheres(spherical_heart, [LEFT], replace(TWO_BEATS, max_beats=1))

    def fails_once(
        tissue: SphereTissue, inputs: StepInputs, state: State, curves: Floats, first: int
    ) -> tuple:
        if len(inputs.rate) == 1 or first > failing:
            return advance(tissue, inputs, state, curves, first)
        short = inputs._replace(rate=inputs.rate[:failing])
        completed, _, iterations = advance(tissue, short, state, curves, first)
        return completed, UNBALANCED, iterations

    monkeypatch.setattr(simulation, "advance", fails_once)
    halved = simulate_spheres(spherical_heart, [LEFT], replace(TWO_BEATS, max_beats=1))
    assert halved.diagnostics["step_cuts"] == 1
    for name in ("lv_volume", "lv_pressure", "aorta_pressure"):
        curve = whole.signals()[name]
        assert halved.signals()[name] == pytest.approx(curve, abs=2e-2 * np.ptp(curve))


def test_a_failing_heart_reports_time_and_reason(inviscid: Heart) -> None:
    beat = simulate_spheres(inviscid, [LEFT], replace(TWO_BEATS, time_step=0.02, cuts=0))
    assert (beat.status, beat.completed) == ("failed", False)
    assert beat.reason.startswith("beat 1: at 0.")
    assert beat.reason.removesuffix(": ").split(": ")[-1] in FAILURE_REASONS
    assert beat.diagnostics["beats"] == 0.0


def test_a_heart_that_cannot_be_filled_fails(spherical_heart: Heart) -> None:
    balloon = spherical_heart.with_parameters({"c_1": 5.0, "c_2": 0.0})
    beat = simulate_spheres(balloon, [LEFT, RIGHT])
    assert beat.reason.startswith("beat 1: ")
    assert numbers_in(beat.reason) == [1.0, 600.0, 2.0]
