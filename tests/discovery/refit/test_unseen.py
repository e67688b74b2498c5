"""Error ratios on held-out data, and the choice of the nominal heart and of the threshold of a search."""

from collections.abc import Collection, Mapping, Sequence
from dataclasses import replace

import numpy as np
import pytest

from heartfit.core.errors import InputError
from heartfit.discovery.inference.decide import CENTRED_RULES, DEFAULT_RULES, STRICT_RULES, Rules
from heartfit.discovery.refit.model import ObservedBeat
from heartfit.discovery.refit.target import MeasuredCase
from heartfit.discovery.refit.verdict import Proof
from heartfit.discovery.sphere_model import recentred as centred_search
from heartfit.discovery.sphere_model import recentred as recentred_module
from heartfit.discovery.sphere_model.cause import Diagnosis
from heartfit.discovery.sphere_model.nominal_heart import ADULT, NominalHeart
from heartfit.discovery.sphere_model.recentred import fit_nominal_heart
from heartfit.discovery.sphere_model.recording import Recording
from heartfit.geometry.mesh import Motion, VentricularMesh
from heartfit.heart.simulation import Numerics
from heartfit.heart.sphere.body import Sphere
from heartfit.heart.sphere.simulation import simulate_spheres
from heartfit.observation.beat import beat_curves
from heartfit.observation.curve import Curve

PERIOD = 0.8
TIMES = np.arange(25) * PERIOD / 25
WAVE = np.cos(2.0 * np.pi * TIMES / PERIOD)


def volume(error: float) -> Curve:
    return Curve(TIMES, 100e-6 + (40e-6 + error) * WAVE, PERIOD)


def shrunk(mesh: VentricularMesh, most: float) -> Motion:
    shares = 1.0 - most * np.sin(np.pi * np.arange(8) / 8) ** 2
    return Motion(0.1 * np.arange(8), PERIOD, np.array([share * mesh.points for share in shares]))


@pytest.fixture
def proof(ventricle: VentricularMesh) -> Proof:
    case = MeasuredCase.from_curves({"lv_volume": volume(0.0), "rv_volume": volume(0.0)}, [])
    none = ObservedBeat({"lv_volume": volume(8e-6), "rv_volume": volume(4e-6)}, shrunk(ventricle, 0.20))
    extended = ObservedBeat({"lv_volume": volume(2e-6), "rv_volume": volume(4e-6)}, shrunk(ventricle, 0.11))
    return Proof(case, ventricle, shrunk(ventricle, 0.10), none, extended)


def test_ratios_are_those_of_the_errors_on_held_out_data(proof: Proof) -> None:
    gains = {gain.curve: gain for gain in proof.gains()}
    assert gains["lv_volume"].ratio == pytest.approx(0.25)
    assert gains["rv_volume"].ratio == pytest.approx(1.0)
    assert gains["lv_volume"].none == pytest.approx(8e-6 * np.sqrt(np.mean(WAVE[1::2] ** 2)))
    strain = gains["circumferential strain"]
    assert 0.05 < strain.ratio < 0.2
    assert strain.interval[0] <= strain.ratio <= strain.interval[1]


def test_an_extension_helps_if_all_unseen_curves_together_come_nearer(proof: Proof) -> None:
    assert proof.helps()
    assert not replace(proof, baseline=proof.extended, extended=proof.baseline).helps()
    worse = ObservedBeat({"lv_volume": volume(2e-6), "rv_volume": volume(12e-6)}, proof.extended.motion)
    assert not replace(proof, extended=worse).helps()


@pytest.mark.parametrize(("most", "helps"), [(0.10, True), (0.16, True), (0.40, False)])
def test_the_strain_votes_on_an_extension(proof: Proof, most: float, helps: bool) -> None:
    """The left volume comes nearer by half; the measured wall shrinks by 10 %, without the extension by 15 %."""
    without = ObservedBeat({"lv_volume": volume(8e-6), "rv_volume": volume(4e-6)}, shrunk(proof.mesh, 0.15))
    nearer = ObservedBeat({"lv_volume": volume(4e-6), "rv_volume": volume(4e-6)}, shrunk(proof.mesh, most))
    voted = replace(proof, baseline=without, extended=nearer)
    assert voted.helps() is helps
    assert all(gain.objects for gain in voted.strain_gains) is not (most < 0.15)


def test_traces_hold_every_measured_sample(proof: Proof) -> None:
    left, right = proof.traces()
    assert (left.curve, right.curve) == ("lv_volume", "rv_volume")
    assert left.lacking is None, "no discrepancy is fitted in three dimensions"
    assert left.extended == pytest.approx(volume(2e-6).values)


@pytest.fixture(scope="module")
def beat() -> dict[str, Curve]:
    heart = ADULT.heart.with_parameters({"sigma_0": 165e3, "mu": 11e3, "tau": 1.9, "slope": 0.2})
    numerics = Numerics(time_step=5e-3, max_beats=8, drift=1e-3)
    return beat_curves(simulate_spheres(heart, [Sphere.from_volumes(1.2e-4, 2.2e-4)], numerics))


def test_the_nominal_heart_follows_the_beat_that_it_is_fitted_to(beat: dict[str, Curve]) -> None:
    heart = ADULT.heart.with_parameters({"sigma_0": 260e3})
    centre = fit_nominal_heart(heart, beat)
    assert centre.wall == pytest.approx(2.2e-4, rel=0.25)
    assert centre.heart.period == heart.period


def test_a_beat_without_a_matching_sphere_is_refused(
    monkeypatch: pytest.MonkeyPatch, beat: dict[str, Curve]
) -> None:
    monkeypatch.setattr(recentred_module, "ROUNDS", 1)
    volume = beat["lv_volume"]
    humped = beat | {"lv_volume": replace(volume, values=volume.values + 8e-6 * np.sin(40.0 * volume.times))}
    with pytest.raises(InputError, match=r"beat.*lv_volume"):
        fit_nominal_heart(ADULT.heart.with_parameters({"sigma_0": 260e3}), humped, ("lv_volume",))


@pytest.fixture
def searched(monkeypatch: pytest.MonkeyPatch) -> None:
    def diagnosed(
        recording: Recording,
        nominal: NominalHeart | None = None,
        rules: Rules = DEFAULT_RULES,
        unseen: Recording | None = None,
        **searched: Collection[object],
    ) -> Diagnosis:
        assert searched == {"places": (), "left_out": ()}
        assert unseen is None
        about = "sphere" if nominal is ADULT else "adult"
        return Diagnosis("none", (), (), about, (), 0, recording.period, rules.detected)

    monkeypatch.setattr(centred_search, "diagnose", diagnosed)
    monkeypatch.setattr(centred_search, "fit_nominal_heart", lambda *_: ADULT)


def conclusion(beats: Sequence[Mapping[str, Curve]]) -> tuple[str, float, float | None]:
    recording = MeasuredCase.from_curves({"lv_volume": beats[0]["lv_volume"].resampled(25)}, []).recording()
    result = centred_search.centred_search(recording, ADULT.heart, beats)
    return result.next_measurement, result.threshold, result.self_test


@pytest.mark.usefixtures("searched")
def test_a_search_without_a_nominal_heart_has_stricter_rules(
    monkeypatch: pytest.MonkeyPatch, beat: dict[str, Curve]
) -> None:
    def following(*arguments: object) -> NominalHeart:
        if arguments[2] not in allowed:
            raise InputError("the sphere does not follow")
        return ADULT

    monkeypatch.setattr(centred_search, "fit_nominal_heart", following)
    allowed: list[object] = [("lv_volume",)]
    assert conclusion([beat]) == ("sphere", CENTRED_RULES.detected, None)
    allowed = [()]
    assert conclusion([beat]) == ("sphere", STRICT_RULES.detected, None)
    allowed = []
    assert conclusion([beat]) == ("adult", STRICT_RULES.detected, None)


@pytest.mark.usefixtures("searched")
@pytest.mark.parametrize(("tested", "rules"), [(0.4, CENTRED_RULES), (3.1, STRICT_RULES)])
def test_a_sphere_that_fails_its_self_test_has_stricter_rules(
    monkeypatch: pytest.MonkeyPatch, beat: dict[str, Curve], tested: float, rules: Rules
) -> None:
    tested_beats: list[object] = []
    monkeypatch.setattr(
        centred_search, "self_test", lambda *arguments: tested_beats.extend(arguments[2]) or tested
    )
    assert conclusion([beat, {}, beat]) == ("sphere", rules.detected, tested)
    assert len(tested_beats) == 1, "without the nominal heart's beat and a failed one"
