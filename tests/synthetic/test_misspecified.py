"""Misspecified hearts: centres, errors and R wave depart from the search as declared; other hearts keep their draws."""

import numpy as np
import pytest

from heartfit.observation.beat import beat_curves
from heartfit.observation.curve import Curve
from heartfit.synthetic import hidden as module
from heartfit.synthetic.campaign import Inadmissible, PlantedPlan, in_batches, misspecified_plans
from heartfit.synthetic.case import plant
from heartfit.synthetic.hidden import (
    AMOUNT,
    INERTANCE,
    MASS,
    MEMORY,
    RELATIVE,
    TIMES,
    WALL_AMOUNT,
    RecordingProtocol,
    draw_hidden,
    measure_beat,
)
from heartfit.synthetic.misspecified import AS_SEARCHED, SHIFTED, Misspecification

DEPARTURES = [Misspecification.draw(np.random.default_rng(seed)) for seed in range(60)]
PERIOD = 0.86
PHASES = np.arange(86) * PERIOD / 86
STEADY = {
    "lv_volume": Curve(PHASES, np.full(86, 150e-6), PERIOD),
    "lv_pressure": Curve(PHASES, np.full(86, 10e3), PERIOD),
}
RECORDINGS = 400


def errors_of(protocol, monkeypatch):
    """Errors of many recordings of a steady heart: of frames (k, n) and of pressures (k, m), without discrepancy."""
    monkeypatch.setattr(module, "VOLUME_ROUGHNESS", 0.0)
    monkeypatch.setattr(module, "PRESSURE_ROUGHNESS", 0.0)
    monkeypatch.setattr(module, "beat_curves", lambda *_: STEADY)
    rng = np.random.default_rng(0)
    recorded = [measure_beat(None, (), protocol, rng) for _ in range(RECORDINGS)]
    volumes, pressures = (
        np.array([curves[name].values for curves in recorded]) for name in ("lv_volume", "lv_pressure")
    )
    return volumes - 150e-6, pressures - 10e3


def quantities(hidden):
    """Every number that a draw decides, by name."""
    values = hidden.heart.parameters() | {"wall": hidden.sphere.wall, "density": hidden.inertia.density}
    spread = {"spread": float(hidden.activation[-1])}
    return values | spread | {f"{name} inertance": inertance for name, inertance in hidden.inertia.valves}


def test_a_heart_as_searched_keeps_the_draws_that_it_had_before_there_were_others():
    sound = plant(PlantedPlan(7, "none"))
    leaking = plant(PlantedPlan(7, "single", ("MitralRegurgitation",), 2.0))
    volumes, pressures = (sound.curves["rest"][name].values[:3] for name in ("lv_volume", "lv_pressure"))
    exactly = {"rel": 1e-9, "abs": 0.0}
    drawn = [0.00010895898288283095, 0.00010974435555011226, 0.0001087989875954584]
    assert volumes == pytest.approx(drawn, **exactly)
    assert pressures == pytest.approx([4425.039044501424, 5788.550002670711, 7478.567231101978], **exactly)
    assert sound.answer.volume_noise == pytest.approx(0.020282352931990277, **exactly)
    assert sound.answer.truth["sigma_0"] == pytest.approx(0.0012301533574825742, **exactly)
    assert leaking.curves["rest"]["lv_pressure"].values[0] == pytest.approx(3993.4685171837787, **exactly)
    assert (sound.answer.population, sound.answer.misspecification) == ("as searched", AS_SEARCHED)


def test_no_departure_changes_no_bit_of_a_draw():
    plain, same = (np.random.default_rng(3) for _ in range(2))
    assert quantities(AS_SEARCHED.draw_heart(same)) == quantities(draw_hidden(plain))
    assert AS_SEARCHED.draw_protocol(same) == RecordingProtocol.draw(plain)


def test_eight_centres_shift_by_one_to_two_standard_deviations_in_both_directions():
    shifts = np.array([[departure.centres[name] for name in SHIFTED] for departure in DEPARTURES])
    assert shifts.shape == (60, 8)
    assert {"circulation.left_atrium", WALL_AMOUNT} <= set(SHIFTED)
    assert all(set(departure.centres) == set(SHIFTED) for departure in DEPARTURES)
    assert (np.abs(shifts) >= 1.0).all()
    assert (np.abs(shifts) <= 2.0).all()
    assert (shifts.min(axis=0) < -1.0).all()
    assert (shifts.max(axis=0) > 1.0).all()
    assert np.ptp(np.abs(shifts), axis=0).min() > 0.7


@pytest.mark.parametrize("departure", DEPARTURES[:4])
def test_a_heart_follows_its_centres_and_no_other_parameter_does(departure):
    unmoved, shifted = (
        draw_hidden(np.random.default_rng(5), centres) for centres in (None, departure.centres)
    )
    before, after = quantities(unmoved), quantities(shifted)
    changed = {name: (before[name], after[name]) for name in before if before[name] != after[name]}
    heart, centres = shifted.heart, departure.centres
    relative = {name: RELATIVE[name] for name in SHIFTED if name in RELATIVE}
    expected = {heart.parameter_path(name): sd * centres[name] for name, sd in relative.items()}
    expected |= {"wall": AMOUNT * centres["wall"], "density": MASS * centres["wall"]}
    expected["mitral inertance"] = INERTANCE * centres["mitral inertance"]
    first, last = changed.pop(heart.parameter_path("duration"))
    assert last - first == pytest.approx(TIMES["duration"] * centres["duration"])
    assert {name: np.log(b / a) for name, (a, b) in changed.items()} == pytest.approx(expected)
    assert len(expected) == 8, "six logarithms beside the duration, one of them in volume and density"


def test_the_deviates_of_the_answer_scatter_about_the_shifted_centres():
    shift = dict.fromkeys(("sigma_0", "duration"), -1.5)
    drawn = [draw_hidden(np.random.default_rng(seed), shift).deviates for seed in range(300)]
    for name, centre in (*shift.items(), ("tau", 0.0)):
        deviates = np.array([deviate[name] for deviate in drawn])
        assert deviates.mean() == pytest.approx(centre, abs=0.2)
        assert deviates.std() == pytest.approx(1.0, abs=0.15)


@pytest.mark.parametrize("seed", range(4))
def test_the_recorded_pressure_appears_20_to_40_ms_later(seed):
    departure = Misspecification.draw(np.random.default_rng(seed))
    late = Misspecification(trigger_lead=departure.trigger_lead).draw_heart(np.random.default_rng(3))
    usual = AS_SEARCHED.draw_heart(np.random.default_rng(3))
    rng = np.random.default_rng(0)
    recorded = [measure_beat(heart.beat(), (), RecordingProtocol(28, 0.01), rng) for heart in (usual, late)]
    times = np.arange(0.0, usual.heart.period, 1e-3)
    for name in ("lv_pressure", "lv_volume"):
        first, second = (curves[name] for curves in recorded)
        delays = 1e-3 * np.arange(-60, 61)
        misfits = [np.sum((second(times) - first(times - delay)) ** 2) for delay in delays]
        delay = delays[int(np.argmin(misfits))]
        assert delay == pytest.approx(departure.trigger_lead, abs=6e-3)
        assert 0.014 < delay < 0.046
    true = [beat_curves(heart.beat())["lv_pressure"] for heart in (usual, late)]
    assert true[1](times) == pytest.approx(true[0](times - departure.trigger_lead), abs=1.0)
    assert 0.02 <= departure.trigger_lead <= 0.04


def test_an_r_wave_before_the_activation_is_drawn_anew():
    with pytest.raises(Inadmissible, match="R wave"):
        Misspecification(trigger_lead=0.1).draw_heart(np.random.default_rng(0))
    planted = [plant(PlantedPlan(seed, "none", population="misspecified")).answer for seed in range(1, 13)]
    assert sum(answer.rejected.get("R wave before the activation", 0) for answer in planted) > 0


@pytest.mark.parametrize("ratio", [0.5, 2.0])
def test_errors_of_volume_and_catheter_are_twice_or_half_as_large(monkeypatch, ratio):
    usual = AS_SEARCHED.draw_protocol(np.random.default_rng(1))
    louder = Misspecification(volume_noise=ratio).draw_protocol(np.random.default_rng(1))
    catheter = Misspecification(catheter_noise=ratio).draw_protocol(np.random.default_rng(1))
    volume, pressure = (error.std() for error in errors_of(usual, monkeypatch))
    first, second = errors_of(louder, monkeypatch), errors_of(catheter, monkeypatch)
    assert first[0].std() / volume == pytest.approx(ratio, rel=0.02)
    assert first[1].std() / pressure == pytest.approx(1.0, rel=0.02)
    assert second[0].std() / volume == pytest.approx(1.0, rel=0.02)
    assert second[1].std() / pressure == pytest.approx(ratio, rel=0.02)
    assert pressure == pytest.approx(300.0 / np.sqrt(10.0), rel=0.02)


def test_each_ratio_and_each_memory_is_drawn():
    assert {(entry.volume_noise, entry.catheter_noise) for entry in DEPARTURES} == {
        (first, second) for first in (0.5, 2.0) for second in (0.5, 2.0)
    }
    assert {entry.memory for entry in DEPARTURES} == {0.2, 0.85}


@pytest.mark.parametrize("memory", [MEMORY, 0.2, 0.85])
def test_errors_of_successive_frames_have_another_correlation(monkeypatch, memory):
    protocol = Misspecification(memory=memory).draw_protocol(np.random.default_rng(1))
    errors, _ = errors_of(protocol, monkeypatch)
    measured = np.mean(errors[:, 1:] * errors[:, :-1]) / errors.var()
    assert measured == pytest.approx(memory, abs=0.04)


def test_a_seed_plants_the_same_misspecified_case_and_seals_its_departure():
    plan = PlantedPlan(7, "single", ("MitralRegurgitation",), 2.0, population="misspecified")
    first, second = plant(plan), plant(plan)
    assert first.answer == second.answer
    assert (first.curves["rest"]["lv_volume"].values == second.curves["rest"]["lv_volume"].values).all()
    assert first.answer.population == "misspecified"
    departure = first.answer.misspecification
    assert set(departure.centres) == set(SHIFTED)
    assert first.answer.volume_noise <= 0.03 * departure.volume_noise
    assert first.answer.volume_noise >= 0.01 * departure.volume_noise


def test_plans_are_nulls_and_then_each_mechanism_with_consecutive_seeds():
    plans = misspecified_plans(50, 2, 2, 2.5, ("A", "B"))
    assert [plan.seed for plan in plans] == list(range(50, 56))
    assert [plan.kind for plan in plans] == ["none"] * 2 + ["single"] * 4
    assert [plan.names for plan in plans[2:]] == [("A",), ("B",)] * 2
    assert {plan.scales for plan in plans[2:]} == {2.5}
    assert {plan.population for plan in plans} == {"misspecified"}
    assert misspecified_plans(50, 0, 0, 2.5, ("A", "B")) == []
    assert in_batches(plans, 4) == [plans[:4], plans[4:]]
