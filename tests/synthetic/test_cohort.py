"""Virtual volunteers: drawn from their seed, imaged by their scanner, different from the calibrator's model."""

import numpy as np
import pytest

from heartfit.heart.activation.conduction import CONDUCTIONS
from heartfit.heart.beat import Beat, nodal_motion
from heartfit.heart.circulation.elements import OrificeValve
from heartfit.heart.heart import PAPER_PARAMETERS, Heart
from heartfit.synthetic.volunteer import ESTIMATED, OTHER_CONDUCTIONS, draw_anatomy, draw_heart, hide_heart

PERIOD, FRAMES = 0.8, 25
STANDARD = {"sigma_0": 200e3, "mu": 8e3}


@pytest.fixture
def beat() -> Beat:
    """A cloud of nodes that swells and shifts with the beat, sampled finely."""
    time = np.linspace(0.0, PERIOD, 801)
    cloud = 0.03 * np.random.default_rng(0).standard_normal((200, 3))
    phase = 2.0 * np.pi * time[:, None, None] / PERIOD
    positions = cloud * (1.0 + 0.2 * np.cos(phase)) + 0.01 * np.sin(phase)
    return Beat(time, {}, {}, {}, PERIOD, trigger=0.195, positions=positions)


def test_the_same_seed_draws_the_same_heart() -> None:
    first, second, other = (draw_heart(STANDARD, PERIOD, seed) for seed in (3, 3, 4))
    assert first == second
    assert first != other


def test_the_hidden_heart_is_another_model() -> None:
    heart, _ = draw_heart(STANDARD, PERIOD, 1)
    valves = [getattr(heart.circulation, name) for name in ("mitral", "aortic", "tricuspid", "pulmonary")]
    assert all(isinstance(valve, OrificeValve) for valve in valves)
    assert heart.tissue.active.starling.slope > 0.0 == Heart().tissue.active.starling.slope
    assert heart.trigger != Heart().trigger
    assert heart.period == PERIOD


def test_the_truth_is_the_heart_s_value_of_the_paper_s_parameters() -> None:
    heart, truth = draw_heart(STANDARD, PERIOD, 1)
    assert tuple(truth) == PAPER_PARAMETERS
    assert heart.with_parameters(truth) == heart


def test_the_hidden_hearts_scatter_about_the_standard() -> None:
    drawn = np.log([draw_heart(STANDARD, PERIOD, seed)[1]["sigma_0"] / 200e3 for seed in range(150)])
    assert drawn.mean() == pytest.approx(0.0, abs=0.04)
    assert drawn.std() == pytest.approx(0.15, rel=0.2)


def test_a_hidden_heart_has_its_ratios_to_the_standard_and_other_parameters_scatter() -> None:
    ratios = {"sigma_0": 0.6, "mu": 1.1, "c_1": 1.48, "R_p": 0.9}
    first, second = (hide_heart(STANDARD, ratios, PERIOD, seed)[1] for seed in (1, 2))
    standard = {name: Heart().parameters()[Heart().parameter_path(name)] for name in ESTIMATED} | STANDARD
    for name, ratio in ratios.items():
        assert first[name] == second[name] == pytest.approx(ratio * standard[name])
    assert first["k_RS"] != second["k_RS"]


def test_a_hidden_block_starts_where_the_calibrator_s_does_but_runs_at_other_speeds() -> None:
    assert OTHER_CONDUCTIONS["healthy"] == CONDUCTIONS["healthy"]
    hidden, known = OTHER_CONDUCTIONS["lbbb"], CONDUCTIONS["lbbb"]
    assert hidden.sites == known.sites
    assert (hidden.speed, hidden.ratio) != (known.speed, known.ratio)


def test_the_motion_begins_at_the_trigger_and_is_interpolated_between_steps(beat: Beat) -> None:
    motion = nodal_motion(beat)
    steps = np.asarray(beat.positions)
    for time in np.linspace(0.0, PERIOD, FRAMES, endpoint=False):
        sample = ((time + beat.trigger) % PERIOD) / PERIOD * 800
        before, share = int(sample), sample - int(sample)
        expected = (1.0 - share) * steps[before] + share * steps[before + 1]
        assert motion.at(time) == pytest.approx(expected, abs=1e-12)


def test_drawn_anatomies_are_consistent_and_those_of_healthy_adults() -> None:
    drawn = [draw_anatomy(seed) for seed in range(60)]
    assert draw_anatomy(3) == drawn[3] != drawn[4]
    volumes = 1e6 * np.array([volunteer.shape.edv for volunteer in drawn])
    assert volumes.mean() == pytest.approx(148.0, abs=3.0 * 24.0 / np.sqrt(60))
    assert ((volumes >= 100.0) & (volumes <= 196.0)).all()
    assert np.std([volunteer.period for volunteer in drawn]) == pytest.approx(0.07, rel=0.35)
    for volunteer in drawn[:2]:
        volunteer.shape.surface()  # the right cavity fits beside the left one
