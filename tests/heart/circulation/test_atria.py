"""Atria with a volume: law, closed forms, orders, limits and the conservation of blood."""

from dataclasses import dataclass, replace

import numpy as np
import pytest

from heartfit.core.errors import InputError
from heartfit.heart import simulation
from heartfit.heart.circulation.atria import chamber_table
from heartfit.heart.circulation.coupling import Tolerances
from heartfit.heart.circulation.elements import LinearValve, Windkessel
from heartfit.heart.circulation.network import Circulation, atrial_walls
from heartfit.heart.circulation.state import HeartState
from heartfit.heart.finite_elements.kinematics import StepFailed
from heartfit.heart.heart import Heart
from heartfit.heart.simulation import Numerics, Recurrence, simulate
from heartfit.heart.sphere import rows
from heartfit.heart.sphere import simulation as spheres
from heartfit.heart.sphere.beat import State, StepInputs
from heartfit.heart.sphere.body import Sphere, SphericalBody
from heartfit.heart.sphere.heart import Inertia
from heartfit.heart.sphere.simulation import simulate_spheres
from heartfit.mechanisms.atrial_kick import AtrialKick
from heartfit.mechanisms.atrial_surge import AtrialSurge
from heartfit.mechanisms.left_atrium import LeftAtrium
from heartfit.mechanisms.mitral_dynamics import MitralDynamics
from heartfit.mechanisms.mitral_regurgitation import MitralRegurgitation
from heartfit.mechanisms.right_atrium import RightAtrium
from heartfit.roles.chamber import ACTIVE, DESCENT, STIFFENING, VENTRICLE, stretched_volume, wall_pressure
from tests.shrinking import assert_derivative
from verification.elastance import Elastance, ElastanceBody

TIGHT = Tolerances(force=1e-7, volume=1e-17, pressure=1e-7, iterations=60)
LEFT, RIGHT = Sphere.from_volumes(80e-6, 130e-6), Sphere.from_volumes(90e-6, 45e-6)
VENTRICLES = ElastanceBody(Elastance(4e8, 2e7, 20e-6), Elastance(8e7, 1e7, 20e-6))
SHUT = LinearValve(open=1e-30, closed=1e-30)
CLOSED = LeftAtrium(veins=8.3e6), RightAtrium(veins=2.2e6)


def beat_history(
    heart: Heart, body: ElastanceBody | SphericalBody = VENTRICLES, **numerics
) -> list[HeartState]:
    """States of the last beat."""
    histories: list = []
    settings = Numerics(**({"max_beats": 1, "tolerances": TIGHT} | numerics))
    beat = simulate(heart, body, settings, watch=histories.append)  # type: ignore[arg-type]
    assert beat.completed, beat.reason
    return histories[-1]


def contents(heart: Heart, state: HeartState) -> np.ndarray:
    """Blood [m^3] in ventricles, atria, arteries and veins (8,)."""
    table = chamber_table(heart.mechanisms)
    arteries = [
        tree.tau / tree.R_p * held.P_c
        for tree, held in zip(heart.circulation.trees(), state.trees, strict=True)
    ]
    return np.array([*state.volumes, *state.atria[0], *arteries, *(state.atria[1] / table[8])])  # type: ignore[index]


@pytest.mark.parametrize("active", [0.0, 3e7])
def test_the_inverse_of_the_law_returns_the_volume(active: float) -> None:
    """On both sides of the unstressed volume, with the slope of the inverse."""
    table = chamber_table([LeftAtrium()])
    table[STIFFENING] = active
    for x in 1e-6 * np.array([-5.0, 12.0, 20.0, 20.01, 35.0, 60.0, 140.0]):
        pressure, slope = wall_pressure(table, 0, x)
        volume, inverse = stretched_volume(table, 0, pressure)
        assert volume == pytest.approx(x, rel=1e-13)
        assert inverse == pytest.approx(1.0 / slope)
        if abs(x - 20e-6) > 1e-12:
            step = np.array([1e-7])
            assert_derivative(
                lambda y: np.array([wall_pressure(table, 0, y[0])[0]]), slope * step, np.array([x]), step
            )


def test_the_law_is_its_formula() -> None:
    table = chamber_table([LeftAtrium(unstressed=20e-6, passive=1e7, scale=50e-6)])
    table[STIFFENING] = 2e7
    assert wall_pressure(table, 0, 45e-6)[0] == pytest.approx(1e7 * 50e-6 * np.expm1(0.5) + 2e7 * 25e-6)
    assert wall_pressure(table, 0, 15e-6)[0] == pytest.approx(3e7 * -5e-6)


def test_a_passive_linear_atrium_fills_exponentially() -> None:
    """V = V_end + (V_start - V_end) exp(-E t / R_v) behind a shut valve, to second order in the step."""
    E, R, end = 2e7, 6e6, 0.8
    atrium = LeftAtrium(resistance=R, reservoir=1500.0, unstressed=20e-6, passive=E, scale=1e3)
    heart = Heart(circulation=Circulation(mitral=SHUT), mechanisms=(atrium,), period=end)
    filled = 20e-6 + 1500.0 / E
    start = 20e-6 + heart.circulation.left_atrium / E
    exact = filled + (start - filled) * np.exp(-E / R * end)
    errors = [
        abs(beat_history(heart, time_step=end / n)[-1].atria[0, 0] - exact)  # type: ignore[index]
        for n in (40, 80, 160)
    ]
    assert np.log2(np.divide(errors[:-1], errors[1:])) == pytest.approx(2.0, abs=0.15)
    assert errors[-1] < 1e-3 * (filled - start)


@pytest.mark.parametrize("second_order", [True, False])
@pytest.mark.parametrize("body", ["elastances", "spheres"])
def test_a_closed_circuit_keeps_its_blood(body: str, second_order: bool) -> None:
    """To 1e-12 with a leak, leaflets and the descent of a plane, over every step of a beat."""
    heart = Heart().with_parameters({"sigma_0": 150e3}) + MitralRegurgitation() + MitralDynamics()
    heart = heart + replace(CLOSED[0], descent=0.2) + CLOSED[1]
    ventricles = SphericalBody(LEFT, RIGHT, heart.muscle) if body == "spheres" else VENTRICLES
    states = beat_history(heart, ventricles, second_order=second_order)
    blood = np.array([contents(heart, state) for state in states])
    assert abs(blood.sum(axis=1) / blood[0].sum() - 1.0).max() < 1e-12
    assert np.ptp(blood, axis=0).min() > 1e-6


def test_pressures_agree_with_the_laws() -> None:
    """Laws of the walls at the volumes, and of the arteries at their inflow, in a closed circuit with a plane."""
    heart = Heart() + AtrialSurge() + replace(CLOSED[0], descent=0.2) + CLOSED[1]
    table = chamber_table(heart.mechanisms)
    assert table is not None
    states = beat_history(heart)
    for n, state in enumerate(states[2:], start=2):
        contraction, outside = atrial_walls(
            n * heart.period / (len(states) - 1), heart.period, heart.mechanisms
        )
        table[STIFFENING] = contraction * table[ACTIVE]
        x = state.atria[0] + table[DESCENT] * (state.volumes - table[VENTRICLE])  # type: ignore[index]
        laws = [outside[s] + wall_pressure(table, s, x[s])[0] for s in range(2)]
        assert state.pressures[4:] == pytest.approx(laws, abs=1e-5)
        inflow = state.branches[0, [1, 3]]  # type: ignore[index]
        for u, (tree, held) in enumerate(zip(heart.circulation.trees(), state.trees, strict=True)):
            across = tree.Z_c * (inflow[u] - held.q_L)
            assert state.pressures[2 + u] == pytest.approx(held.P_c + across, abs=1e-6)


@dataclass
class HalvedCoupling:
    """Coupling that fails at its first attempt at some whole steps."""

    coupling: object
    length: float

    def advance(self, state: HeartState, step, expected=None) -> HeartState:
        if step.length == self.length and round(step.start / step.length) % 7 == 3:
            raise StepFailed("cut")
        return self.coupling.advance(state, step, expected)  # type: ignore[attr-defined]

    def __getattr__(self, name: str):
        return getattr(self.coupling, name)


def test_halved_steps_keep_the_blood(monkeypatch: pytest.MonkeyPatch) -> None:
    whole = simulation.Coupling
    heart = Heart(mechanisms=(AtrialKick(), *CLOSED), period=0.8)
    monkeypatch.setattr(simulation, "Coupling", lambda *args: HalvedCoupling(whole(*args), 0.8 / 160))
    states = beat_history(heart)
    blood = np.array([contents(heart, state).sum() for state in states])
    assert abs(blood / blood[0] - 1.0).max() < 1e-12


@pytest.mark.parametrize(
    "atria",
    [[LeftAtrium(R, 900.0, active=0.0) for R in (1e4, 1e3)],
     [LeftAtrium(1e30, 900.0, passive=E, scale=1e3, active=0.0) for E in (1e5, 1e4)]],
    ids=["resistance", "elastance"],
)  # fmt: skip
def test_the_limit_of_a_large_atrium_is_the_prescribed_pressure(atria: list[LeftAtrium]) -> None:
    """First order in the venous resistance, and in the elastance behind shut veins."""
    prescribed = Heart(circulation=Circulation(left_atrium=900.0), mechanisms=(), period=0.8)
    without, larger, largest = (
        simulate_spheres(heart, [LEFT, RIGHT], Numerics(max_beats=1)).pressure["left_atrium"]
        for heart in (prescribed, *(prescribed + atrium for atrium in atria))
    )
    assert abs(largest - without).max() < 1.0
    assert abs(larger - without).max() == pytest.approx(10.0 * abs(largest - without).max(), rel=0.02)


def test_switched_off_atria_are_the_prescribed_pressure_to_the_bit() -> None:
    off = Heart() + LeftAtrium().turned_off() + RightAtrium().turned_off()
    for sides in ([LEFT], [LEFT, RIGHT]):
        beats = [simulate_spheres(heart, sides, Numerics(max_beats=1)) for heart in (Heart(), off)]
        without, with_them = (beat.signals() for beat in beats)
        assert without.keys() == with_them.keys()
        assert all((with_them[name] == curve).all() for name, curve in without.items())


def test_an_atrium_beside_a_prescribed_one_leaves_it_its_pressure() -> None:
    for atrium, other in ((LeftAtrium(), "right_atrium"), (RightAtrium(), "left_atrium")):
        alone = simulate_spheres(Heart(), [LEFT, RIGHT], Numerics(max_beats=1))
        beside = simulate_spheres(Heart() + atrium, [LEFT, RIGHT], Numerics(max_beats=1))
        assert beside.volume.keys() == {"lv", "rv", atrium.compartment}
        assert beside.pressure[other][1:] == pytest.approx(alone.pressure[other][1:], rel=1e-12)


def test_a_plane_that_descends_takes_blood_from_the_veins() -> None:
    """The stretched volume loses kappa of the stroke: the pressure falls in systole, the atrium fills more."""
    beats = [
        simulate_spheres(Heart() + LeftAtrium(descent=kappa), [LEFT, RIGHT], Numerics(max_beats=1))
        for kappa in (0.0, 0.3)
    ]
    x_descent = [beat.pressure["left_atrium"][60:90].min() for beat in beats]
    assert x_descent[1] < x_descent[0] - 100.0
    assert np.ptp(beats[1].volume["left_atrium"]) > np.ptp(beats[0].volume["left_atrium"])


def test_a_contraction_acts_by_the_elastance_and_other_pressures_on_the_wall() -> None:
    kick, surge = AtrialKick(rise=850.0), AtrialSurge(rise=300.0)
    contraction, outside = atrial_walls(kick.peak, 0.8, (kick, surge))
    assert contraction == pytest.approx(0.5)
    assert outside == pytest.approx([float(surge.pressure(name, kick.peak, 0.8)) for name in
                                     ("left_atrium", "right_atrium")])  # fmt: skip


def test_without_a_kick_the_atrium_does_not_contract() -> None:
    passive, contracting, lamed = (
        simulate_spheres(replace(Heart(), mechanisms=kick) + atrium, [LEFT], Numerics(max_beats=2))
        for kick, atrium in (
            ((), LeftAtrium()),
            ((AtrialKick(),), LeftAtrium()),
            ((AtrialKick(),), LeftAtrium(active=0.0)),
        )
    )
    assert (lamed.pressure["left_atrium"] == passive.pressure["left_atrium"]).all()
    rises = contracting.pressure["left_atrium"] - passive.pressure["left_atrium"]
    assert 10 < np.argmax(rises) < 30
    assert rises.max() > 200.0


def test_veins_of_a_single_ventricle_have_no_arteries() -> None:
    with pytest.raises(InputError, match="LeftAtrium: veins of elastance"):
        simulate_spheres(Heart() + CLOSED[0], [LEFT])


def test_a_closed_circuit_takes_no_shift() -> None:
    volumes = 1e-6 * np.array([[100.0, 80.0], [50.0, 40.0], [101.0, 80.1]])
    states = [Windkessel().periodic_start(stroke, 0.8) for stroke in (9e-5, 1e-4)]
    atria = 1e-6 * np.array([[50.0], [30.0], [54.0]])
    closed = Recurrence(volumes, states, states, atria, closed=True)
    assert closed.shifts(Circulation().trees(), 0.8) == [0.0, 0.0]
    assert closed.drift() == pytest.approx(4.0 / 24.0)


@pytest.mark.parametrize("failing", [0, 16, 52, 82])
def test_halved_steps_of_spheres_keep_the_blood(failing: int, monkeypatch: pytest.MonkeyPatch) -> None:
    """Arteries, atria and veins gain what the ventricles lose."""
    heart, states, advance = Heart() + CLOSED[0] + CLOSED[1], [], spheres.advance

    def fails_once(tissue, inputs: StepInputs, state: State, curves: np.ndarray, first: int) -> tuple:
        states.append(state)
        if len(inputs.rate) == 1 or first > failing:
            return advance(tissue, inputs, state, curves, first)
        completed, _, iterations = advance(
            tissue, inputs._replace(rate=inputs.rate[:failing]), state, curves, first
        )
        return completed, rows.UNBALANCED, iterations

    monkeypatch.setattr(spheres, "advance", fails_once)
    beat = simulate_spheres(heart, [LEFT, RIGHT], Numerics(max_beats=1, time_step=0.01))
    assert beat.diagnostics["step_cuts"] == 1
    begin, end = (blood_of_spheres(heart, beat, state, n) for state, n in ((None, 0), (states[-1], -1)))
    assert end == pytest.approx(begin, rel=1e-10)


def test_arteries_with_a_compliance_of_their_own_keep_the_blood(monkeypatch: pytest.MonkeyPatch) -> None:
    """The Windkessel, and through it the veins, take in what the artery does not store."""
    heart, stiff, states, advance = Heart() + CLOSED[0] + CLOSED[1], 4e-10, [], spheres.advance

    def remembering(tissue, inputs: StepInputs, state: State, curves: np.ndarray, first: int) -> tuple:
        states.append(state)
        return advance(tissue, inputs, state, curves, first)

    monkeypatch.setattr(spheres, "advance", remembering)
    beat = simulate_spheres(heart, [LEFT, RIGHT], Numerics(max_beats=1), inertia=Inertia(arteries=stiff))
    begin, end = (blood_of_spheres(heart, beat, state, n) for state, n in ((None, 0), (states[-1], -1)))
    arteries = [beat.pressure[name] for name in ("aorta", "pulmonary_artery")]
    swollen = stiff * sum(curve[-1] - curve[0] for curve in arteries)
    assert end + swollen == pytest.approx(begin, rel=1e-10)
    assert abs(swollen) > 1e-8


def blood_of_spheres(heart: Heart, beat, state: State | None, n: int) -> float:
    """Blood [m^3] at the start (no state) or in a state."""
    table = chamber_table(heart.mechanisms)
    if state is None:
        held = [start.P_c for start in heart.circulation.start(heart.period)]
        veins = table[7]
    else:
        held, veins = state.sides[rows.NOW + rows.P_C], state.reservoirs[1]
    arteries = sum(t.tau / t.R_p * p for t, p in zip(heart.circulation.trees(), held, strict=True))
    cavities = sum(curve[n] for curve in beat.volume.values())
    return float(cavities + arteries + (veins / table[8]).sum())
