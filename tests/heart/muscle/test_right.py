"""Muscle of the right free wall: each parameter changes that wall alone, on meshes and on spheres."""

from dataclasses import replace

import numpy as np
import pytest

from heartfit.core.errors import InputError
from heartfit.geometry.mesh import VentricularMesh
from heartfit.heart.finite_elements import unloading
from heartfit.heart.finite_elements.body import FiniteElementBody, Tissue
from heartfit.heart.finite_elements.unloading import inflate
from heartfit.heart.heart import Heart
from heartfit.heart.muscle.right import RightVentricle
from heartfit.heart.simulation import Numerics, simulate
from heartfit.heart.sphere.body import SphericalBody
from heartfit.heart.sphere.simulation import simulate_spheres
from heartfit.heart.time_step import TimeStep
from heartfit.mechanisms.delayed_activation import DelayedActivation
from heartfit.mechanisms.fibre_stiffening import FibreStiffening
from heartfit.mechanisms.image_trigger_delay import ImageTriggerDelay
from heartfit.mechanisms.scar import Scar
from heartfit.personalise.run import ventricles
from tests.heart.sphere.test_simulation import LEFT, RIGHT, TIGHT, TWO_BEATS, departures

WEAK, LATE, STIFF = (
    RightVentricle(contractility=0.5),
    RightVentricle(delay=0.03),
    RightVentricle(stiffness=2.0),
)
EARLY_SYSTOLE = TimeStep(0.2, 5e-3, 0.8, last=5e-3)


def tissue(right: RightVentricle) -> Tissue:
    return Tissue(right=right)


@pytest.fixture(scope="module")
def right_wall(ventricle: VentricularMesh) -> np.ndarray:
    wall: np.ndarray = np.asarray(ventricle.segments) == 0
    assert 0 < wall.sum() < wall.size
    return wall


def test_the_same_muscle_needs_no_regions_and_is_unchanged(ventricle: VentricularMesh) -> None:
    same = Tissue(right=RightVentricle(1.0, 0.0, 1.0))
    assert same.uniform
    without_regions = FiniteElementBody(replace(ventricle, segments=None), same)
    assert (without_regions.activation == ventricle.activation).all()
    scarred = replace(same, regional=(Scar(),))
    assert scarred.losses() == pytest.approx(Scar().lost_share(), abs=1e-15)
    assert not scarred.delays().any()


def test_half_the_contractility_halves_the_bridges_of_the_right_wall(
    ventricle: VentricularMesh, right_wall: np.ndarray
) -> None:
    body = FiniteElementBody(ventricle, tissue(WEAK))
    drive = body.step(body.rest(), EARLY_SYSTOLE).drive
    assert drive.n_0 == pytest.approx(np.where(right_wall, 0.5, 1.0))
    assert SphericalBody(LEFT, RIGHT, tissue(WEAK)).kept == pytest.approx(np.repeat([1.0, 0.5], 8))
    more = FiniteElementBody(ventricle, tissue(RightVentricle(contractility=3.0)))
    assert more.kept == pytest.approx(np.where(right_wall, 3.0, 1.0))


def test_both_shares_of_a_region_multiply() -> None:
    losses = Tissue(right=WEAK, regional=(Scar(),)).losses()
    assert losses[0] == pytest.approx(0.5)
    assert losses[1:] == pytest.approx(Scar().lost_share()[1:])


def test_a_delay_shifts_the_activation_of_the_right_wall(
    ventricle: VentricularMesh, right_wall: np.ndarray
) -> None:
    """In addition to the delays of mechanisms, which lie in the left ventricle."""
    later = FiniteElementBody(ventricle, tissue(LATE)).activation - np.asarray(ventricle.activation)
    assert later == pytest.approx(np.where(right_wall, 0.03, 0.0))
    spheres, late = (SphericalBody(LEFT, RIGHT, t).activation for t in (Tissue(), tissue(LATE)))
    assert late - spheres == pytest.approx(np.repeat([0.0, 0.03], 8))
    both = Tissue(right=LATE, regional=(DelayedActivation(),)).delays()
    assert both[0] == 0.03
    assert (both[1:] == DelayedActivation().delay()[1:]).all()


def passive_forces(mesh: VentricularMesh, tissue: Tissue, x: np.ndarray, part: np.ndarray) -> np.ndarray:
    """Stress (m, 6) of the relaxed elements of a ``part`` of the wall at the unknowns x."""
    body = FiniteElementBody(mesh, tissue)
    step = body.static_step(body.rest())
    step.forces(x)
    return step.deformation[1][part]


def test_stiffness_scales_the_passive_stress_of_the_right_wall(
    ventricle: VentricularMesh, right_wall: np.ndarray
) -> None:
    """Without volumetric stress, which belongs to the element: no wall pressure, and an isochoric law."""
    x = np.zeros((len(ventricle.points), 4))
    x[:, :3] = (ventricle.points - ventricle.points.mean(axis=0)) * [0.05, -0.03, 0.02]
    for part, factor in ((right_wall, 2.0), (~right_wall, 1.0)):
        same, stiff = (passive_forces(ventricle, t, x, part) for t in (Tissue(), tissue(STIFF)))
        assert abs(same).max() > 100.0
        assert stiff == pytest.approx(factor * same, rel=1e-12)


def test_the_right_sphere_holds_the_pressure_of_a_stiffer_balloon() -> None:
    """The same stretch at twice the pressure, which only the right sphere is given."""
    soft, stiff = (SphericalBody(LEFT, RIGHT, t) for t in (Tissue(), tissue(STIFF)))
    assert stiff.stretch(inflate(stiff, np.array([800.0, 800.0])).x) == pytest.approx(
        soft.stretch(inflate(soft, np.array([800.0, 400.0])).x), rel=1e-8
    )


def test_unloaded_spheres_of_a_stiffer_right_wall_return_to_the_measured_cavities(
    ventricle: VentricularMesh,
) -> None:
    loads = np.array([1000.0, 500.0])
    stiff = replace(tissue(STIFF), element="sphere")
    body = ventricles(ventricle, stiff, loads)
    measured = ventricles(ventricle, stiff, np.zeros(2))
    filled = body.volumes(inflate(body, loads).x)
    assert filled == pytest.approx(measured.volumes(measured.rest().x), rel=1e-7)


def test_energies_of_mechanisms_keep_their_moduli() -> None:
    """On a mesh, too: the annuli and the right wall scale the base law alone."""
    law = replace(tissue(STIFF), passive=Heart().tissue.passive)
    fibrous = (Heart(tissue=law) + FibreStiffening()).muscle
    stretch = np.array([1.2])
    base, both = fibrous.passive.base, fibrous.passive  # type: ignore[attr-defined]
    added = both.in_plane_stress(stretch) - base.in_plane_stress(stretch)
    assert both.in_plane_stress(stretch, 2.0) == pytest.approx(2.0 * base.in_plane_stress(stretch) + added)


@pytest.mark.parametrize("second_order", [False, True])
def test_compiled_spheres_are_those_of_the_coupled_path(
    spherical_heart: Heart, second_order: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(unloading, "INFLATION_FORCE_TOLERANCE", 1e-9)
    own = {"tissue.right.contractility": 0.7, "tissue.right.delay": 0.02, "tissue.right.stiffness": 1.5}
    heart = (spherical_heart + Scar()).with_parameters(own)
    numerics = replace(TWO_BEATS, second_order=second_order, tolerances=TIGHT)
    coupled = simulate(heart, SphericalBody(LEFT, RIGHT, heart.muscle), numerics)
    compiled = simulate_spheres(heart, [LEFT, RIGHT], numerics)
    assert max(departures(compiled, coupled).values()) < 1e-7


@pytest.mark.parametrize("name", ["contractility", "delay", "stiffness"])
def test_a_right_wall_of_its_own_changes_the_right_beat(name: str, spherical_heart: Heart) -> None:
    """The left sphere shares no blood with it in this circuit, and keeps its beat to the bit."""
    values = {"contractility": 0.6, "delay": 0.05, "stiffness": 2.5}
    own = spherical_heart.with_parameters({f"tissue.right.{name}": values[name]})
    beats = [
        simulate_spheres(heart, [LEFT, RIGHT], Numerics(0.01, max_beats=1))
        for heart in (spherical_heart, own)
    ]
    before, after = (beat.volume for beat in beats)
    assert after["lv"] == pytest.approx(before["lv"], abs=1e-12)
    assert abs(after["rv"] - before["rv"]).max() > 0.5e-6


def test_inadmissible_values_are_refused() -> None:
    for values in ({"contractility": -0.1}, {"delay": -1e-3}, {"stiffness": float("nan")}):
        with pytest.raises(InputError, match=next(iter(values))):
            RightVentricle(**values)


def test_a_short_name_means_the_other_parameter() -> None:
    """A stated name of a mechanism keeps its meaning."""
    heart = Heart() + ImageTriggerDelay()
    assert heart.parameter_path("delay") == "ImageTriggerDelay.delay"
    assert Heart().parameter_path("delay") == "tissue.right.delay"
