"""The tables and derivatives of the compiled wall."""

import numpy as np
import pytest

from heartfit.heart.muscle.passive import MooneyRivlin
from heartfit.heart.muscle.stiffened import Stiffened
from heartfit.heart.sphere.body import Sphere
from heartfit.heart.sphere.wall import cavity, passive_stress, tabulate, viscous_stress
from heartfit.mechanisms.exponential_stiffening import ExponentialStiffening
from heartfit.mechanisms.fibre_stiffening import FibreStiffening
from heartfit.roles import Stress
from tests.shrinking import assert_derivative

STRETCHES = np.random.default_rng(4).uniform(0.5, 1.9, 200)


def test_the_tabulated_passive_law_is_the_law() -> None:
    law = MooneyRivlin()
    interpolated = np.array([passive_stress(tabulate(law), 0, stretch) for stretch in STRETCHES])
    stress, stiffness = law.in_plane_stress(STRETCHES), law.in_plane_stiffness(STRETCHES)
    assert abs(interpolated[:, 0] - stress).max() < 1e-8 * law.c_1 * 100.0
    assert interpolated[:, 0] == pytest.approx(stress, rel=1e-7, abs=1e-3)
    assert interpolated[:, 1] == pytest.approx(stiffness, rel=1e-5)


@pytest.mark.parametrize("added", [ExponentialStiffening(), FibreStiffening()])
def test_a_stiffened_law_is_tabulated(added: Stress) -> None:
    """An interval of the table is a sixteenth of the strain over which fibres are straightened."""
    law = Stiffened(MooneyRivlin(), (added,))
    stretches = STRETCHES[(STRETCHES > 0.75) & (STRETCHES < 1.3)]
    interpolated = [passive_stress(tabulate(law), 0, stretch)[0] for stretch in stretches]
    assert interpolated == pytest.approx(law.in_plane_stress(stretches), rel=2e-6, abs=0.1)


def test_cavity_and_its_derivatives() -> None:
    sphere = Sphere.from_volumes(80e-6, 130e-6)
    ratio = 0.5 * sphere.thickness / sphere.radius
    assert cavity(sphere.radius, ratio, 1.0)[0] == pytest.approx(80e-6)
    for stretch in STRETCHES[STRETCHES > 0.75][:20]:
        x, step = np.array([stretch]), np.array([0.02])
        _, slope, curve = cavity(sphere.radius, ratio, stretch)
        assert_derivative(lambda s: np.array([cavity(sphere.radius, ratio, s[0])[0]]), slope * step, x, step)
        assert_derivative(lambda s: np.array([cavity(sphere.radius, ratio, s[0])[1]]), curve * step, x, step)


def test_viscous_stress_is_that_of_the_strain_rate_and_has_its_derivative() -> None:
    r"""eta/2 dE : dE of the stretches (x, x, x^-2), differentiated by hand at its end."""
    old = 1.1
    for new in (0.95, 1.02, 1.3):
        in_plane, radial = 0.5 * (new**2 - old**2), 0.5 * (new**-4 - old**-4)
        stress, slope = viscous_stress(new, old**2, old**-4)
        assert stress == pytest.approx(2.0 * in_plane * new - 2.0 * radial * new**-5)
        x, step = np.array([new]), np.array([0.02])
        assert_derivative(
            lambda s: np.array([viscous_stress(s[0], old**2, old**-4)[0]]), slope * step, x, step
        )
