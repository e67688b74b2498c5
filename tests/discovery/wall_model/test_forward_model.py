"""Predictions of a measured wall: their slopes, their samples and the unknowns that move the reference."""

from collections.abc import Callable
from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np
import pytest

from heartfit.core.arrays import Floats
from heartfit.discovery.sphere_model.forward_model import Candidate
from heartfit.discovery.wall_model.forward_model import WallForwardModel
from heartfit.discovery.wall_model.hypotheses import candidates, placements
from heartfit.discovery.wall_model.unknowns import (
    CONTRACTILITY_SD,
    NAMES,
    HeartInWall,
    WallVariation,
    heart_at,
)
from heartfit.geometry.mesh import VentricularMesh
from heartfit.heart.beat import Beat
from heartfit.heart.circulation.coupling import Tolerances
from heartfit.heart.heart import Heart
from heartfit.heart.simulation import Numerics, simulate
from heartfit.mechanisms.image_trigger_delay import ImageTriggerDelay
from heartfit.mechanisms.left_atrium import LeftAtrium
from heartfit.mechanisms.mitral_regurgitation import MitralRegurgitation
from heartfit.mechanisms.scar import Scar
from heartfit.observation.regional import strain_name
from heartfit.roles import Mechanism, registered

TIMES = np.linspace(0.0, 0.75, 16)
FRAMES = np.linspace(0.0, 0.75, 16)
STRAIN = strain_name("circumferential", 9)
DISTANCE = 0.05
"""Distance of the converged beats to the centre [prior sd]: further away, valves open at other times."""
CONVERGED: dict[str, Any] = {
    "drift": 1e-6,
    "max_beats": 60,
    "tolerances": Tolerances(force=1e-3, volume=1e-12, pressure=1e-2, iterations=60),
}
CURVES = {"lv_volume": TIMES, "rv_volume": TIMES, "lv_pressure": TIMES, STRAIN: FRAMES[1:]}


@pytest.fixture(scope="module")
def model(ventricle: VentricularMesh) -> WallForwardModel:
    numerics = Numerics(time_step=10e-3, max_beats=10, drift=1e-3, keep_positions=True)
    return WallForwardModel(ventricle, HeartInWall.loaded(Heart(), 1000.0, 500.0), CURVES, FRAMES, numerics)


@pytest.fixture(scope="module")
def centre(model: WallForwardModel) -> tuple[Floats, Floats]:
    slopes = replace(model).slopes(np.zeros(len(NAMES)))
    assert slopes is not None
    return slopes


@pytest.fixture(scope="module")
def alone(model: WallForwardModel) -> Callable[..., Floats]:
    """Prediction of effects by a model that has predicted nothing before, made once."""

    @cache
    def predict(*effects: Mechanism) -> Floats:
        predicted = replace(model).predict(np.zeros(len(NAMES)), effects)
        assert predicted is not None
        return predicted

    return predict


def part(values: Floats, name: str) -> Floats:
    ends = np.cumsum([0, *(times.size for times in CURVES.values())])
    place = list(CURVES).index(name)
    return values[ends[place] : ends[place + 1]]


@pytest.mark.long
def test_the_prediction_of_the_slopes_is_that_of_the_beat(
    model: WallForwardModel, centre: tuple[Floats, Floats]
) -> None:
    alone = replace(model).predict(np.zeros(len(NAMES)))
    assert alone == pytest.approx(centre[0], rel=1e-9, abs=1e-12)


@pytest.mark.long
@pytest.mark.parametrize("name", ["tissue.active.sigma_0", "load.lv", "helix.endo", "segment.09"])
def test_slopes_are_those_of_beats_nearby(
    model: WallForwardModel, centre: tuple[Floats, Floats], name: str
) -> None:
    x, converged = np.zeros(len(NAMES)), replace(model, numerics=replace(model.numerics, **CONVERGED))
    x[NAMES.index(name)] = DISTANCE
    above, below = converged.predict(x), converged.predict(-x)
    assert above is not None
    assert below is not None
    expected, slope = (above - below) / (2.0 * DISTANCE), centre[1][:, NAMES.index(name)]
    for curve, floor in {"lv_volume": 1e-6, "lv_pressure": 150.0, STRAIN: 0.004}.items():
        error = np.sqrt(np.mean((part(slope, curve) - part(expected, curve)) ** 2))
        assert error < 0.05 * max(np.sqrt(np.mean(part(expected, curve) ** 2)), floor), curve


def test_a_scar_takes_the_strain_of_its_segment(alone: Callable[..., Floats]) -> None:
    sound, scarred = alone(), alone(Scar(extent=0.25, angle=0.0))
    assert part(sound, STRAIN).min() < -0.08
    assert part(scarred, STRAIN).min() > 0.6 * part(sound, STRAIN).min()


def test_late_images_delay_strain_as_they_delay_the_volume(alone: Callable[..., Floats]) -> None:
    true, late = alone(), alone(ImageTriggerDelay(delay=FRAMES[1]))
    for name in ("lv_volume", STRAIN):
        before, after = part(true, name), part(late, name)
        if name == STRAIN:  # the late first frame is the reference
            before = before - before[3:9].mean() + after[4:10].mean()
        assert after[4:10] == pytest.approx(before[3:9], abs=0.12 * np.ptp(before))
        assert np.abs(after[4:10] - before[4:10]).max() > 0.12 * np.ptp(before)


@pytest.mark.parametrize(
    ("before", "effect"),
    [
        ([], []),
        ([], [MitralRegurgitation()]),
        ([MitralRegurgitation()], [MitralRegurgitation()]),
        ([], [LeftAtrium()]),
    ],
    ids=["sound", "leak after", "leak before and after", "atrium after"],
)
def test_a_prediction_does_not_depend_on_the_heart_before(
    model: WallForwardModel,
    alone: Callable[..., Floats],
    before: list[Mechanism],
    effect: list[Mechanism],
) -> None:
    x, following = np.zeros(len(NAMES)), replace(model)
    assert following.predict(0.3 + x, before) is not None
    predicted = following.predict(x, effect)
    assert predicted is not None
    errors = {"lv_volume": 0.2e-6, "rv_volume": 0.2e-6, "lv_pressure": 60.0, STRAIN: 1e-3}
    for curve, error in errors.items():
        assert part(predicted, curve) == pytest.approx(part(alone(*effect), curve), abs=error), curve


def test_the_beats_of_a_similar_heart_start_with_the_measured_responses(
    model: WallForwardModel, monkeypatch: pytest.MonkeyPatch
) -> None:
    beats: list[Beat] = []

    def recorded(*arguments: Any, **keywords: Any) -> Beat:
        beats.append(simulate(*arguments, **keywords))
        return beats[-1]

    monkeypatch.setattr("heartfit.discovery.wall_model.forward_model.simulate", recorded)
    following = replace(model)
    for distance in (0.0, 0.3, 0.0):
        following.predict(np.full(len(NAMES), distance))
    assert beats[-1].diagnostics["beats"] == 2


def test_a_wall_outside_the_range_has_no_prediction(model: WallForwardModel) -> None:
    x = np.zeros(len(NAMES))
    x[NAMES.index("tissue.control.duration")] = 100.0
    assert model.predict(x) is None
    assert model.slopes(x) is None


def test_the_wall_varies_by_segment() -> None:
    x = np.zeros(len(NAMES))
    x[NAMES.index("segment.07")], x[NAMES.index("delay.11")] = 2.0, 1.0
    (variation,) = [
        m
        for m in heart_at(HeartInWall.loaded(Heart(), 1.0, 1.0), x).heart.mechanisms
        if isinstance(m, WallVariation)
    ]
    kept = 1.0 - variation.lost_share()
    assert kept[7] == pytest.approx(np.exp(2.0 * CONTRACTILITY_SD))
    assert kept[np.arange(18) != 7] == pytest.approx(1.0)
    assert variation.delay()[11] == pytest.approx(0.008)
    assert np.count_nonzero(variation.delay()) == 1


def test_no_unknown_has_two_coordinates() -> None:
    assert len(set(NAMES)) == len(NAMES)


def test_regional_effects_are_tried_all_around() -> None:
    scar = Candidate.from_mechanism(Scar)
    names = [unknown.name for unknown in scar.unknowns]
    angles = [
        scar.unknowns[names.index("angle")].at(place[names.index("angle")]) for place in placements(scar)
    ]
    assert np.sort(np.mod(np.round(angles, 9), 2.0 * np.pi)) == pytest.approx(
        np.pi / 3.0 * np.arange(6), abs=1e-6
    )


def test_images_alone_name_regions_and_image_errors(model: WallForwardModel) -> None:
    images = replace(model, times={name: times for name, times in CURVES.items() if name != "lv_pressure"})
    alone = {candidate.name for candidate in candidates(images, pressure=False)}
    assert alone == {
        "DelayedActivation",
        "Scar",
        "ImageShrinkage",
        "ImageSmoothing",
        "ImageTriggerDelay",
        "RateMismatch",
    }
    assert {candidate.name for candidate in candidates(model, pressure=True)} < set(registered())


def test_a_stenosis_of_the_right_side_needs_its_pressure(model: WallForwardModel) -> None:
    right = {"PulmonaryStenosis", "TricuspidStenosis"}
    without = {candidate.name for candidate in candidates(model, pressure=True)}
    measured = replace(model, times={**CURVES, "rv_pressure": TIMES})
    assert not right & without
    assert "AorticStenosis" in without
    assert right <= {candidate.name for candidate in candidates(measured, pressure=True)}
