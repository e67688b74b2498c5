"""The fibre law against the closed forms of its equations, its energy balance and its own tangent."""

from dataclasses import replace

import numpy as np
import pytest

from heartfit.heart.finite_elements.kinematics import StepFailed
from heartfit.heart.muscle.bcs import BestelClementSorine, Drive, tension
from heartfit.heart.muscle.control import Starling
from heartfit.heart.muscle.fibre_equation import BRIDGE_FLOOR, LARGEST_INCREMENT, STRAIN_TOLERANCE
from heartfit.heart.time_step import TimeStep
from tests.shrinking import assert_derivative

LAW = BestelClementSorine(sigma_0=280e3)
ADDITIVE = replace(LAW, additive=True)
SLACK = replace(LAW, relaxed_friction=0.2)
UNIT = np.ones(1)
BOTH = pytest.mark.parametrize("second_order", [False, True])
RHEOLOGIES = pytest.mark.parametrize("law", [LAW, ADDITIVE, SLACK], ids=["A", "B", "slack"])


def drive(attach: float, detach: float, dt: float, n_0: float = 0.8, second_order: bool = True) -> Drive:
    return Drive((attach + detach) * UNIT, attach * UNIT, n_0 * UNIT, dt, second_order)


def hold_length(state: np.ndarray, step: Drive, duration: float) -> np.ndarray:
    """State after ``duration`` at constant length of the sarcomere."""
    for _ in range(round(duration / step.dt)):
        state = LAW.advance(step, state, np.zeros(1))
    return state


def orders(errors: list[float]) -> np.ndarray:
    """Observed orders of errors whose step is halved each time."""
    return np.log2(np.array(errors[:-1]) / np.array(errors[1:]))


def random_steps(
    count: int, seed: int, second_order: bool = True
) -> tuple[Drive, np.ndarray, np.ndarray, np.ndarray]:
    """Drives, old and new strains and states of fibres: shortening and stretched, slack and tense."""
    rng = np.random.default_rng(seed)
    active = rng.random(count) < 0.5
    attach = np.where(active, rng.uniform(1.0, 30.0, count), 0.0)
    rate = attach + np.where(active, 0.0, rng.uniform(1.0, 30.0, count))
    e_c = rng.uniform(-0.2, 0.3, count)
    k_c = 10 ** rng.uniform(0.0, 5.5, count)
    state = np.array([e_c, k_c, rng.uniform(0.0, 1.0, count) * np.sqrt(k_c), np.zeros(count)])
    e_old = e_c + rng.uniform(-2e-3, 4e-3, count)
    e_new = e_old + rng.choice([-1.0, 1.0], count) * rng.uniform(5e-4, 3e-2, count)
    dt = 10 ** rng.uniform(-4.0, -1.5)
    return Drive(rate, attach, rng.uniform(0.0, 1.0, count), dt, second_order), e_old, e_new, state


def strain(law: BestelClementSorine, e: np.ndarray) -> np.ndarray:
    """Green-Lagrange strain of the strain ``e`` in the measure of the rheology."""
    return e * (1.0 + 0.5 * e) if law.additive else e


def respond(
    law: BestelClementSorine, step: Drive, e_old: np.ndarray, e_new: np.ndarray, state: np.ndarray
) -> np.ndarray:
    """Stress, slope and increment, after two evaluations: the slope belongs to the last but one Newton iteration."""
    out = law.begin(e_old, state)
    for _ in range(2):
        law.respond(step, e_old, e_new, state, out)
    return out[:3]


SCHEMES = pytest.mark.parametrize(("second_order", "order", "error"), [(False, 1, 1e-2), (True, 2, 2e-5)])


@SCHEMES
def test_isometric_tension_rises_to_the_available_contractility(
    second_order: bool, order: int, error: float
) -> None:
    """From no bridges at all, where tau_c / sqrt(k_c) starts like a root of time."""
    exact = 0.8 * LAW.sigma_0 * (1.0 - np.exp(-6.0 * 0.2))
    steps = [drive(6.0, 0.0, dt, second_order=second_order) for dt in (4e-3, 2e-3, 1e-3)]
    errors = [abs(tension(hold_length(LAW.rest(1), step, 0.2))[0] - exact) for step in steps]
    assert (orders(errors) > order - 0.15).all()
    assert errors[-1] < error * exact


@SCHEMES
def test_isometric_tension_decays_with_the_rate_of_relaxation(
    second_order: bool, order: int, error: float
) -> None:
    tense = hold_length(LAW.rest(1), drive(6.0, 0.0, 1e-3), 0.3)
    exact = tension(tense)[0] * np.exp(-14.0 * 0.1)
    steps = [drive(0.0, 14.0, dt, second_order=second_order) for dt in (4e-3, 2e-3, 1e-3)]
    errors = [abs(tension(hold_length(tense, step, 0.1))[0] - exact) for step in steps]
    assert (orders(errors) > order - 0.15).all()
    assert errors[-1] < error * exact


def shortened(second_order: bool, dt: float, length: float = 0.32) -> float:
    """Bridge stress of a fibre that activates and shortens ever more slowly, at the time ``length``."""
    law = replace(LAW, starling=Starling(slope=1.0))
    state, strain = law.rest(1), np.zeros(1)
    for n in range(round(length / dt)):
        following = -0.1 * np.sin(4.0 * (n + 1) * dt) * UNIT
        step = TimeStep(n * dt, dt, 1.0, second_order)
        driven = law.drive(step, (6.0 * UNIT, 6.0 * UNIT), state)
        out = law.begin(strain, state)
        law.respond(driven, strain, following, state, out)
        state, strain = law.advance(driven, state, out[2]), following
    return float(tension(state)[0])


@pytest.mark.parametrize(("second_order", "order"), [(False, 1), (True, 2)])
def test_moving_fibres_converge_with_the_order_of_the_scheme(second_order: bool, order: int) -> None:
    """Length dependence, series spring and destruction by motion included."""
    stresses = np.array([shortened(second_order, 8e-3 / 2**i) for i in range(5)])
    assert orders(abs(np.diff(stresses)).tolist())[1:] == pytest.approx(order, abs=0.15)


@pytest.mark.parametrize("velocity", [0.3, 1.0, 3.0])
@pytest.mark.parametrize("dt", [1e-3, 2e-2])
@BOTH
def test_steady_shortening_follows_the_force_velocity_relation(
    velocity: float, dt: float, second_order: bool
) -> None:
    """The scheme holds the steady state of the equations exactly, with any step."""
    u, n_0 = 10.0, 0.7
    state, step = LAW.rest(1), drive(u, 0.0, dt, n_0, second_order)
    for _ in range(4000):
        state = LAW.advance(step, state, np.array([-velocity * dt]))
    turnover = u + LAW.alpha * velocity
    k_c = n_0 * LAW.k_0 * u / turnover
    assert state[1, 0] == pytest.approx(k_c, rel=1e-9)
    assert tension(state)[0] == pytest.approx((n_0 * LAW.sigma_0 * u - velocity * k_c) / turnover, rel=1e-9)


@BOTH
@RHEOLOGIES
@pytest.mark.parametrize("seed", range(3))
def test_every_step_balances_its_energy(seed: int, law: BestelClementSorine, second_order: bool) -> None:
    """Energy stored in spring and bridges is work and attachment less friction and detachment."""
    step, *strains, state = random_steps(2000, seed, second_order)
    e_old, e_new = (strain(law, e) for e in strains)
    stress, _, d = respond(law, step, e_old, e_new, state)
    new = law.advance(step, state, d)

    def energy(e: np.ndarray, fibres: np.ndarray) -> np.ndarray:
        multiplied = (e - fibres[0]) / (1.0 + 2.0 * fibres[0])
        spring = np.sqrt(1.0 + 2.0 * e) - 1.0 - fibres[0] if law.additive else multiplied
        return 0.5 * LAW.E_s * spring**2 + 0.5 * fibres[2] ** 2

    mean, attached = 0.5 * (state[2] + new[2]), step.dt * step.n_0 * step.attach
    root = 0.5 * (np.sqrt(state[1]) + np.sqrt(new[1])) if second_order else np.sqrt(new[1])
    detached = 0.5 * (step.dt * step.rate + LAW.alpha * abs(d)) + 0.5 * attached * LAW.k_0 / root**2
    terms = np.array(
        [
            energy(e_old, state) - energy(e_new, new),
            stress * (e_new - e_old),
            -law.friction(root**2) * d * d / step.dt,
            -detached * mean**2,
            attached * LAW.sigma_0 / root * mean,
        ]
    )
    assert (abs(terms.sum(axis=0)) <= 1e-9 * abs(terms).sum(axis=0)).all()


def away_from_kinks(law: BestelClementSorine, state: np.ndarray, new: np.ndarray) -> np.ndarray:
    """Fibres whose bridges are above their floor and not near the number that carries the whole friction."""
    doubled = 2.0 * (0.5 * (np.sqrt(state[1]) + np.sqrt(new[1]))) ** 2 / law.k_0
    return (new[1] > 1.5 * BRIDGE_FLOOR) & (abs(doubled - 1.0) > 0.05)


@BOTH
@pytest.mark.parametrize("seed", range(5))
def test_tangent_is_the_derivative_of_the_stress(seed: int, second_order: bool) -> None:
    step, e_old, e_new, state = random_steps(400, seed, second_order)
    _, slope, d = respond(LAW, step, e_old, e_new, state)
    smooth = (abs(d) > 2e-4) & (LAW.advance(step, state, d)[1] > 1.5 * BRIDGE_FLOOR)
    assert (d[smooth] > 0).any()
    assert (d[smooth] < 0).any()
    direction = np.where(smooth, 1e-4, 0.0)
    for i in np.flatnonzero(smooth):
        inputs = (values[i : i + 1] for values in (step.rate, step.attach, step.n_0))
        one = Drive(*inputs, step.dt, second_order)

        def stress(e: np.ndarray, i: int = i, one: Drive = one) -> np.ndarray:
            return respond(LAW, one, e_old[i : i + 1], e, state[:, i : i + 1])[0]

        assert_derivative(stress, slope[i : i + 1] * 1e-4, e_new[i : i + 1], direction[i : i + 1])


@BOTH
@pytest.mark.parametrize("law", [ADDITIVE, SLACK], ids=["B", "slack"])
def test_other_tangents_are_derivatives_of_their_stresses(
    law: BestelClementSorine, second_order: bool
) -> None:
    """Central differences of one length: roots of the strain and slow iterations add round-off to shorter ones."""
    step, *strains, state = random_steps(2000, 3, second_order)
    e_old, e_new = (strain(law, e) for e in strains)
    _, slope, d = respond(law, step, e_old, e_new, state)
    h = 1e-5
    upper, lower = (respond(law, step, e_old, e_new + sign * h, state)[0] for sign in (1.0, -1.0))
    smooth = (abs(d) > 2e-4) & (abs(d) < 0.9 * LARGEST_INCREMENT)
    smooth &= away_from_kinks(law, state, law.advance(step, state, np.clip(d, -0.099, 0.099)))
    assert slope[smooth] == pytest.approx(((upper - lower) / (2.0 * h))[smooth], rel=1e-4, abs=1.0)


@BOTH
@RHEOLOGIES
@pytest.mark.parametrize("seed", [1, 2])
def test_fibres_that_step_together_are_all_solved(
    seed: int, law: BestelClementSorine, second_order: bool
) -> None:
    """Another Newton step moves none of them, and alone a fibre ends where it ends among others."""
    step, e_old, e_new, state = random_steps(500, seed, second_order)
    together = law.begin(e_old, state)
    law.respond(step, e_old, e_new, state, together)
    once_more = together.copy()
    law.correct(step, e_old, e_new, state, once_more)
    np.testing.assert_allclose(once_more[2], together[2], rtol=0, atol=STRAIN_TOLERANCE)
    for i in (slice(k, k + 1) for k in range(20)):
        alone, own = (
            law.begin(e_old[i], state[:, i]),
            replace(step, rate=step.rate[i], attach=step.attach[i], n_0=step.n_0[i]),
        )
        law.respond(own, e_old[i], e_new[i], state[:, i], alone)
        np.testing.assert_allclose(alone[2], together[2, i], rtol=0, atol=STRAIN_TOLERANCE)


def test_friction_falls_with_the_bridges_to_the_share_of_a_relaxed_sarcomere() -> None:
    """The whole friction from half the maximum stiffness on, the stated share without bridges."""
    k_c = SLACK.k_0 * np.array([0.0, 0.25, 0.5, 0.8])
    assert SLACK.friction(k_c) == pytest.approx(SLACK.mu * np.array([0.2, 0.6, 1.0, 1.0]))
    assert (LAW.friction(k_c) == LAW.mu).all()


@pytest.mark.parametrize("share", [1.0, 0.5, 0.1])
def test_a_relaxed_sarcomere_creeps_with_its_own_friction(share: float) -> None:
    """Few bridges, small strains: the spring of a stretched fibre relaxes with the time constant r mu / E_s."""
    law = replace(LAW, relaxed_friction=share, E_s=3e5)
    duration, steps, strain = share * law.mu / law.E_s, 400, 1e-4
    rest, e = law.rest(1), np.full(1, strain)
    step = drive(0.0, 1e-6, duration / steps)
    state = rest
    for _ in range(steps):
        state = law.advance(step, state, respond(law, step, e, e, state)[2])
    assert 1.0 - state[0, 0] / strain == pytest.approx(np.exp(-1.0), rel=5e-3)


def test_both_rheologies_agree_at_small_strains() -> None:
    """The relative difference of the stresses is of first order in the strain."""
    drawn, _, _, state = random_steps(200, seed=9)
    step = replace(drawn, attach=np.zeros(200))

    def relative_difference(scale: float) -> float:
        scaled = np.array([scale * state[0], state[1], scale * state[2], state[3]])
        old, new = scaled[0] + 1e-3 * scale, scaled[0] + 0.01 * scale
        one, other = (respond(law, step, old, new, scaled)[0] for law in (LAW, ADDITIVE))
        return float(np.linalg.norm(one - other) / np.linalg.norm(one))

    assert relative_difference(1e-3) / relative_difference(1e-4) == pytest.approx(10.0, rel=0.1)


def test_the_length_dependence_of_the_additive_rheology_is_in_engineering_strain() -> None:
    law, state = BestelClementSorine(additive=True, starling=Starling(1.0, 0.0)), LAW.rest(1)
    state[0] = 0.0969
    step = law.drive(TimeStep(0.0, 5e-3, 1.0), (UNIT, UNIT), state)
    assert step.n_0 == pytest.approx([0.8933])
    assert law.unstressed(np.array([0.105])) == pytest.approx([0.1])


def test_a_stiff_spring_passes_the_strain_to_the_sarcomere() -> None:
    """The strain of the spring vanishes as 1/E_s."""
    step, _, e_new, state = random_steps(200, seed=7)
    e_old = state[0]
    e_new = e_old + 0.1 * (e_new - e_old)

    def kept(E_s: float) -> float:
        return float(abs(e_new - e_old - respond(replace(LAW, E_s=E_s), step, e_old, e_new, state)[2]).max())

    assert kept(1e11) / kept(1e10) == pytest.approx(0.1, rel=0.02)
    assert kept(1e11) < 0.01 * abs(e_new - e_old).max()


def test_a_static_step_leaves_relaxed_fibres_without_stress() -> None:
    _, e_old, e_new, state = random_steps(50, seed=1)
    zeros = np.zeros(50)
    static = Drive(zeros, zeros, zeros, np.inf)
    stress, slope, d = respond(LAW, static, e_old, e_new, state)
    assert not stress.any()
    assert not slope.any()
    assert LAW.advance(static, state, d) == pytest.approx(np.vstack([e_new, LAW.rest(50)[1:]]))


def test_a_step_beyond_the_bound_of_the_increment_fails() -> None:
    rest, step = LAW.rest(1), drive(0.0, 14.0, 5e-3)
    d = respond(LAW, step, np.zeros(1), np.array([0.3]), rest)[2]
    with pytest.raises(StepFailed, match=rf"e_c\b.*{LARGEST_INCREMENT}.*0.005 s"):
        LAW.advance(step, rest, d)


def test_bridges_never_lose_their_stiffness() -> None:
    rng = np.random.default_rng(3)
    state, strain = LAW.rest(100), np.zeros(100)
    for n in range(300):
        following = np.clip(strain + rng.uniform(-0.02, 0.02, 100), -0.1, 0.2)
        step = random_steps(100, n)[0]
        d = respond(LAW, step, strain, following, state)[2]
        state, strain = LAW.advance(step, state, d), following
        assert (state[1] >= BRIDGE_FLOOR).all()
        assert np.isfinite(state).all()
