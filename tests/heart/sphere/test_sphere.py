"""The spherical ventricles against their energies, the inflation of a balloon and Laplace's law."""

from dataclasses import replace

import numpy as np
import pytest

from heartfit.core.errors import InputError
from heartfit.heart.finite_elements.body import StepFailed, Tissue
from heartfit.heart.finite_elements.unloading import inflate
from heartfit.heart.sphere.body import Sphere, SphereState, SphericalBody, fibre_class_means
from heartfit.heart.time_step import TimeStep
from tests.shrinking import assert_derivative

LEFT, RIGHT = Sphere.from_volumes(80e-6, 130e-6), Sphere.from_volumes(90e-6, 45e-6)
TISSUE = Tissue()
BODY = SphericalBody(LEFT, RIGHT, TISSUE)
STEP = TimeStep(0.18, 5e-3, 0.8, last=4e-3)


def test_a_sphere_has_the_volumes_it_was_made_of() -> None:
    assert BODY.volumes(BODY.rest().x) == pytest.approx([80e-6, 90e-6])
    assert [LEFT.wall, RIGHT.wall] == pytest.approx([130e-6, 45e-6])
    outer, inner = LEFT.radius + LEFT.thickness / 2, LEFT.radius - LEFT.thickness / 2
    assert 4.0 / 3.0 * np.pi * inner**3 == pytest.approx(80e-6)
    assert 4.0 / 3.0 * np.pi * (outer**3 - inner**3) == pytest.approx(130e-6, rel=0.05)


@pytest.mark.parametrize("seed", range(5))
def test_volume_gradients_and_tangent_are_derivatives(seed: int) -> None:
    rng = np.random.default_rng(seed)
    first = rng.uniform(-5e-3, 5e-3, (2, 1))
    before = first + rng.uniform(-1e-4, 1e-4, (2, 1))
    fibres = TISSUE.active.rest(16)
    fibres[0] = np.repeat(0.5 * (BODY.stretch(first) ** 2 - 1.0), 8)
    fibres[1:3] = rng.uniform(1e4, 1e5, 16), rng.uniform(0.0, 200.0, 16)
    step = BODY.step(SphereState(first, fibres, rng.uniform(0.0, 5e3, 16), before), STEP)
    x = first + rng.choice([-1.0, 1.0], (2, 1)) * rng.uniform(2e-4, 1e-3, (2, 1))
    direction = rng.uniform(0.5, 1.0, (2, 1)) * 1e-5
    for _ in range(2):  # the slope of the fibres is that of their last but one iteration
        step.forces(x)
    slope = step.tangent(x).diagonal
    assert_derivative(step.forces, slope * direction[:, 0], x, direction)
    direction *= 100.0
    assert_derivative(BODY.volumes, direction[:, 0] @ BODY.volume_gradients(x), x, direction)


def work_over_volume(sphere: Sphere, stretch: float) -> float:
    """P = (dPsi/dLambda) / (dV/dLambda) of a relaxed sphere, term by term."""
    c_1, c_2 = TISSUE.passive.c_1, TISSUE.passive.c_2
    energy = c_1 * (4.0 * stretch - 4.0 * stretch**-5) + c_2 * (4.0 * stretch**3 - 4.0 * stretch**-3)
    ratio = sphere.thickness / (2.0 * sphere.radius)
    inner = stretch - ratio / stretch**2
    volume = 4.0 * np.pi * sphere.radius**3 * inner**2 * (1.0 + 2.0 * ratio / stretch**3)
    return sphere.wall * energy / volume


@pytest.mark.parametrize("pressures", [(600.0, 200.0), (1500.0, 500.0)])
def test_static_inflation_follows_the_closed_form(pressures: tuple[float, float]) -> None:
    state = inflate(BODY, np.array(pressures))
    stretch = BODY.stretch(state.x)
    assert (stretch > 1.005).all()
    closed_form = [work_over_volume(sphere, s) for sphere, s in zip((LEFT, RIGHT), stretch, strict=True)]
    assert closed_form == pytest.approx(pressures, rel=1e-4)


def test_inflating_an_unloaded_sphere_gives_the_measured_cavities() -> None:
    sides = [
        Sphere.unloaded(cavity, wall, load, TISSUE.passive)
        for cavity, wall, load in ((130e-6, 130e-6, 1300.0), (140e-6, 45e-6, 520.0))
    ]
    body = SphericalBody(*sides, TISSUE)
    assert (body.volumes(body.rest().x) < [115e-6, 125e-6]).all()
    state = inflate(body, np.array([1300.0, 520.0]))
    assert body.volumes(state.x) == pytest.approx([130e-6, 140e-6], rel=1e-6)


def test_a_thin_sphere_obeys_laplace() -> None:
    """P = 2 h sigma / r, up to thickness over radius."""
    thin = Sphere(radius=0.04, thickness=4e-5)
    body = SphericalBody(thin, thin, TISSUE)
    x = np.full((2, 1), 0.006)
    pressure = body.static_step(body.rest()).forces(x) / np.diag(body.volume_gradients(x))
    stretch = 1.15
    cauchy = 0.5 * stretch * TISSUE.passive.in_plane_stress(np.array([stretch]))
    laplace = 2.0 * 4e-5 * stretch**-2 * cauchy / (0.04 * stretch)
    assert pressure == pytest.approx(np.repeat(laplace, 2), rel=2e-3)


def test_the_matrix_and_the_sarcomere_resist_motion() -> None:
    """A faster step of relaxed spheres needs more force in both directions, for each of the two viscosities."""
    for eta, mu in ((TISSUE.passive.eta, 0.0), (0.0, TISSUE.active.mu)):
        active, passive = replace(TISSUE.active, mu=mu), replace(TISSUE.passive, eta=eta)
        body = SphericalBody(LEFT, RIGHT, Tissue(active=active, passive=passive))
        rest = body.rest()
        for move in (-1e-4, 1e-4):
            steps = [body.step(rest, TimeStep(0.0, dt, 0.8)) for dt in (1e-1, 1e-2, 1e-3)]
            assert (np.diff([step.forces(rest.x + move) * move for step in steps], axis=0) > 0.0).all()


def test_a_balloon_fails_with_its_stretch() -> None:
    with pytest.raises(StepFailed, match="stretched to"):
        BODY.static_step(BODY.rest()).forces(np.full((2, 1), 0.1))


@pytest.mark.parametrize("classes", [1, 8, 17, 40])
def test_fibre_classes_share_the_segments_in_their_order(classes: int) -> None:
    """Seventeen fibre classes are the segments, fewer are means over segments; the right sphere is the right wall."""
    regional = np.arange(18.0) ** 2
    left, right = fibre_class_means(regional, classes, 2).reshape(2, -1)
    assert left.mean() == pytest.approx(regional[1:].mean())
    assert (right == regional[0]).all()
    assert fibre_class_means(regional, classes, 1) == pytest.approx(left)
    assert sorted(fibre_class_means(regional, 17, 1)) == pytest.approx(regional[1:])
    assert fibre_class_means(regional, 8, 1)[0] == pytest.approx((81.0 + 64.0 + 0.125 * 14.0**2) / 2.125)


@pytest.mark.parametrize(
    ("cavity", "wall", "name"), [(120, 120, "cavity"), (1.2e-4, 120, "wall"), (0, 1e-4, "cavity")]
)
def test_volumes_in_another_unit_are_refused(cavity: float, wall: float, name: str) -> None:
    with pytest.raises(InputError, match=rf"sphere: {name} = .* m\^3; expected .*: convert it to m\^3"):
        Sphere.from_volumes(cavity, wall)
