"""Residuals of a beat: phases by the valves, noise, signs, and the place of the largest."""

from dataclasses import replace

import numpy as np
import pytest

from heartfit.geometry.mesh import Motion, VentricularMesh
from heartfit.heart.heart import Heart
from heartfit.heart.simulation import Numerics
from heartfit.heart.sphere.body import Sphere
from heartfit.heart.sphere.simulation import simulate_spheres
from heartfit.observation.beat import PHASES, BeatPhases, beat_curves
from heartfit.observation.comparison import compare_motions, learn_noise
from heartfit.observation.curve import Curve
from heartfit.observation.noise_model import NoiseModel
from heartfit.observation.operator import VolumeFeatures
from heartfit.observation.residual import SIMULATION_ROUGHNESS, case_residual, residuals, strain_residual
from heartfit.observation.scatter import Scatter
from heartfit.observation.strain import DIRECTIONS


@pytest.fixture(scope="module")
def beat(spherical_heart: Heart) -> dict[str, Curve]:
    sphere = Sphere.from_volumes(80e-6, 130e-6)
    return beat_curves(simulate_spheres(spherical_heart, [sphere], Numerics(time_step=5e-3)))


@pytest.fixture
def measured(beat: dict[str, Curve]) -> dict[str, Curve]:
    return {"lv_volume": beat["lv_volume"].resampled(25), "lv_pressure": beat["lv_pressure"].resampled(80)}


def test_the_valves_divide_the_beat(beat: dict[str, Curve]) -> None:
    phases = BeatPhases.from_curves(beat)
    steps = np.mod(np.diff([*phases.starts, phases.starts[0]]), phases.period)
    assert steps.sum() == pytest.approx(phases.period), "phases follow each other once per beat"
    spans = phases.spans()
    assert {name for name, _, _ in spans} == set(PHASES)
    assert sum(end - start for _, start, end in spans) == pytest.approx(phases.period)
    middles = np.array([0.5 * (start + end) for _, start, end in spans])
    assert phases.names_at(middles) == [name for name, _, _ in spans]


def test_the_volume_falls_in_ejection_only_and_rises_in_filling(beat: dict[str, Curve]) -> None:
    phases, rate = (
        BeatPhases.from_curves(beat),
        np.gradient(beat["lv_volume"].values, beat["lv_volume"].times),
    )
    named = np.array(phases.names_at(beat["lv_volume"].times))
    assert rate[named == "ejection"].mean() < -100e-6
    assert rate[named == "early filling"].mean() > rate[named == "diastasis"].mean() > 0.0
    assert rate[named == "atrial systole"].mean() > rate[named == "diastasis"].mean()
    assert np.abs(rate[np.char.startswith(named, "isovolumic")]).max() < 60e-6


def test_a_beat_has_no_residual_to_itself(beat: dict[str, Curve], measured: dict[str, Curve]) -> None:
    left = residuals(measured, {"same": beat}, [])
    assert [residual.curve for residual in left] == ["lv_volume", "lv_pressure"]
    assert max(np.abs(residual.difference("same")).max() for residual in left) < 1e-12


def test_the_worst_is_named_with_its_sign(beat: dict[str, Curve], measured: dict[str, Curve]) -> None:
    phases, volume = BeatPhases.from_curves(beat), measured["lv_volume"]
    early = np.array([name == "early filling" for name in phases.names_at(volume.times)])
    fuller = replace(volume, values=volume.values + 9e-6 * early)
    worst = case_residual(measured | {"lv_volume": fuller}, {"same": beat}, []).misfits()[0]
    assert (worst.curve, worst.phase) == ("lv_volume", "early filling")
    assert worst.difference == pytest.approx(-9e-6)
    assert worst.score < -2.0


def test_the_noise_model_gives_bias_and_deviation_of_each_phase(measured: dict[str, Curve]) -> None:
    bias, sd = np.linspace(0.0, 0.1, 25), np.linspace(0.0, 0.04, 25)
    scatter = Scatter(tuple(map(str, range(25))), 20, bias, np.diag(sd**2))
    model = NoiseModel({}, scatter, {"lv_volume": scatter})
    (volume,) = residuals({"lv_volume": measured["lv_volume"]}, {}, [model])
    stroke = np.ptp(measured["lv_volume"].values)
    assert volume.measured == pytest.approx(measured["lv_volume"].values - stroke * bias)
    assert volume.noise == pytest.approx(
        np.hypot(stroke * sd * np.sqrt(1.05), SIMULATION_ROUGHNESS["volume"])
    )


def test_a_failed_beat_leaves_no_residual(measured: dict[str, Curve]) -> None:
    residual = case_residual(measured, {"after one step": {}}, [])
    assert residual.curves == ()
    assert residual.misfits() == []


def shrunk(mesh: VentricularMesh, most: float) -> Motion:
    shares = 1.0 - most * np.sin(np.pi * np.arange(8) / 8) ** 2
    return Motion(0.1 * np.arange(8), 0.8, np.array([share * mesh.points for share in shares]))


@pytest.fixture(scope="module")
def model_of_strain(ventricle: VentricularMesh) -> NoiseModel:
    """Noise of ten sequences that lose three tenths of the motion, and of ten that lose one."""
    true = shrunk(ventricle, 0.10)
    features = {"lv_volume": VolumeFeatures(frames=8)}
    two = [compare_motions(ventricle, true, shrunk(ventricle, most), features) for most in (0.07, 0.09)]
    return learn_noise(10 * two, {})


def test_strain_is_compared_at_end_systole_and_in_the_noise_of_registration(
    ventricle: VentricularMesh, model_of_strain: NoiseModel
) -> None:
    residual = strain_residual(ventricle, shrunk(ventricle, 0.10), shrunk(ventricle, 0.12), [model_of_strain])
    assert residual is not None
    assert residual.noise is not None
    strain = {most: 0.5 * ((1.0 - most) ** 2 - 1.0) for most in (0.07, 0.09, 0.10, 0.12)}
    bias = 0.5 * (strain[0.07] + strain[0.09]) - strain[0.10]
    noise = 0.5 * abs(strain[0.07] - strain[0.09]) * np.sqrt(20.0 / 19.0)
    assert residual.time == pytest.approx(0.4)
    assert residual.difference == pytest.approx(
        np.full((len(DIRECTIONS), 16), strain[0.12] - strain[0.10] + bias)
    )
    assert residual.score() == pytest.approx(residual.difference / noise)


def test_a_strain_of_unknown_noise_is_in_percent(ventricle: VentricularMesh) -> None:
    residual = strain_residual(ventricle, shrunk(ventricle, 0.10), shrunk(ventricle, 0.12), [])
    assert residual is not None
    assert residual.noise is None
    assert residual.score() == pytest.approx(100.0 * residual.difference)
    assert strain_residual(ventricle, shrunk(ventricle, 0.10), None, []) is None
