"""A subject as a sphere: observations depend on the parameters and not on the bulk modulus."""

import pytest

from heartfit.geometry.mesh import VentricularMesh
from heartfit.heart.heart import Heart
from heartfit.heart.simulation import Numerics
from heartfit.observation.operator import PressureFeatures, VolumeFeatures
from heartfit.synthetic.known_hearts import UNFILLED, SphericalCase

FEATURES = {"lv_volume": VolumeFeatures(), "lv_pressure": PressureFeatures()}


@pytest.fixture(scope="module")
def subject(spherical_heart: Heart) -> SphericalCase:
    return SphericalCase(spherical_heart, 160e-6, 150e-6, 1300.0, FEATURES, Numerics(max_beats=1))


def observed(subject: SphericalCase, **parameters: float) -> dict[str, float]:
    outcome = subject(parameters)
    assert not isinstance(outcome, str), outcome
    return outcome


def test_all_six_observations_depend_on_the_parameters(subject: SphericalCase) -> None:
    usual, strong = observed(subject), observed(subject, sigma_0=180e3)
    assert tuple(usual) == (*VolumeFeatures.names, *PressureFeatures.names)
    assert strong["V_min"] < usual["V_min"]
    assert strong["dPdt_max"] > usual["dPdt_max"]


def test_an_incompressible_wall_has_no_bulk_modulus(subject: SphericalCase) -> None:
    assert observed(subject, K=1e5) == observed(subject, K=1e7)


def test_a_failure_to_unload_is_a_stated_reason(subject: SphericalCase) -> None:
    assert subject({"c_1": 1.0, "c_2": 1.0}) == UNFILLED


def test_volumes_are_those_of_the_mesh(ventricle: VentricularMesh, spherical_heart: Heart) -> None:
    case = SphericalCase.of(ventricle, 1300.0, spherical_heart, FEATURES, Numerics())
    septum_and_free_wall = ventricle.element_volumes()[ventricle.segments != 0].sum()
    assert case.wall == pytest.approx(septum_and_free_wall)
    assert 20e-6 < case.cavity < 300e-6
