"""Effects hidden in three dimensions: planted from the seed, in a wall that the case passes on."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from heartfit.core.errors import InputError
from heartfit.geometry.cavity import Cavity
from heartfit.heart.simulation import Numerics
from heartfit.imaging.registration.track import FreeForm
from heartfit.io.configuration import read_study
from heartfit.personalise.numerics import Protocol
from heartfit.roles.sides import right_excess
from heartfit.synthetic import ventricles
from heartfit.synthetic.campaign import PlantedPlan
from heartfit.synthetic.scanner import Scanner
from heartfit.synthetic.ventricles import LEFT_ATRIUM, RIGHT_ATRIUM, Imaging, Ventricles
from heartfit.synthetic.volunteer import VolunteerError, generate

CONFIG = Path(__file__).parents[2] / "config"
COARSE = Numerics(time_step=0.02, max_beats=1, drift=1.0)
SOUND = PlantedPlan(5, "none")
LEAK = PlantedPlan(5, "single", ("MitralRegurgitation",), 3.0)


SCANNER = Scanner(voxel=4e-3, slice_thickness=4e-3, subvoxel=2e-3, subframes=1)
REGISTRATION = FreeForm(knots=16e-3, levels=((1, 3),))


@pytest.fixture(scope="module")
def hidden(template):
    observed_by = Imaging(SCANNER, REGISTRATION, template, template.mesh)
    return Ventricles(template, {"sigma_0": 257e3}, Protocol(COARSE, (1300.0, 520.0)), observed_by)


@pytest.fixture(scope="module")
def sound(hidden):
    return hidden.plant(SOUND)


def volumes(case):
    return case.curves["rest"]["lv_volume"].values


def test_a_leak_is_planted_in_the_heart_of_the_seed(hidden, sound):
    _, leaking = hidden.plant(LEAK)
    assert leaking.answer.truth == sound[1].answer.truth
    (effect,) = leaking.answer.effects
    assert (effect.name, effect.scales) == ("MitralRegurgitation", 3.0)
    assert np.ptp(volumes(leaking)) > np.ptp(volumes(sound[1]))
    assert set(leaking.curves["rest"]) == {"lv_volume", "lv_pressure"}


@pytest.fixture(scope="module")
def balanced(hidden):
    """Hearts that a planter of a leak balances, in their order, and what the right side of each pumps more [m^3]."""
    hearts = []

    def observed(*arguments):
        volunteer = generate(*arguments)
        heart = arguments[1][0]
        hearts.append((heart, right_excess(volunteer.beat.flow, heart.mechanisms) * heart.period))
        return volunteer

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(ventricles, "generate", observed)
        replace(hidden, balanced=True).plant(replace(LEAK, scales=1.0))
    return hearts


@pytest.fixture(scope="module")
def balanced_without_leak(balanced):
    """Those without the leak, which are balanced first."""
    fewest = min(len(heart.mechanisms) for heart, _ in balanced)
    return [(heart, excess) for heart, excess in balanced if len(heart.mechanisms) == fewest]


def test_both_sides_of_a_balanced_heart_pump_the_same_volume(balanced_without_leak):
    (_, before), *_, (_, after) = balanced_without_leak
    assert abs(before) > 2e-6
    assert abs(after) < 0.5e-6


def test_blood_that_a_leak_keeps_from_the_body_fills_the_left_atrium(balanced, balanced_without_leak):
    (sound, _), (leaking, excess) = balanced_without_leak[-1], balanced[-1]
    left, right = (
        leaking.parameters()[name] / sound.parameters()[name] for name in (LEFT_ATRIUM, RIGHT_ATRIUM)
    )
    assert abs(excess) < 0.5e-6
    assert left > 1.1
    assert right == pytest.approx(1.0 / left, rel=0.1)


def test_the_volume_is_that_of_the_mesh_that_followed_the_images(sound):
    imaged, case = sound
    volume = case.curves["rest"]["lv_volume"]
    assert len(volume.times) in range(25, 31)
    assert Cavity.from_endocardium(imaged.mesh, "lv_endo").volume(imaged.mesh.points) == pytest.approx(
        volume.values[0]
    )
    assert 0.0 < case.answer.volume_noise < 0.05


def test_a_seed_gives_one_case(hidden, sound):
    assert np.array_equal(volumes(hidden.plant(SOUND)[1]), volumes(sound[1]))


def failing_once(function, failure):
    """The function, whose first call fails."""
    failures = [failure]

    def called(*arguments):
        if failures:
            raise failures.pop()
        return function(*arguments)

    return called


def test_hearts_that_do_not_beat_or_cannot_be_registered_are_counted_and_redrawn(hidden, monkeypatch):
    still, folding = VolunteerError("no beat"), InputError("registration: frames [3] fold the wall")
    monkeypatch.setattr(ventricles, "generate", failing_once(ventricles.generate, still))
    monkeypatch.setattr(ventricles, "track", failing_once(ventricles.track, folding))
    _, case = hidden.plant(SOUND)
    assert case.answer.rejected == {"no beat": 1, "not followed by registration": 1}


def test_the_study_plants_enough_cases_of_every_kind():
    plans = read_study([CONFIG / "config.yaml"]).discovery_benchmark.ventricles.plans()
    assert sum(plan.kind == "single" for plan in plans) >= 20
    assert sum(plan.kind == "none" for plan in plans) >= 5
    assert {plan.kind for plan in plans} == {"none", "single", "outside", "two"}
    assert len({plan.seed for plan in plans}) == len(plans)
