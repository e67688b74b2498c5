"""Welding of surfaces that are open at the base."""

import numpy as np
import pytest

from heartfit.core.errors import InputError
from heartfit.geometry.joining import OPEN_SURFACES, weld_surfaces
from heartfit.geometry.parametric import ParametricVentricles
from heartfit.geometry.surface import LabelledSurface


@pytest.fixture(scope="module")
def ventricles() -> LabelledSurface:
    return ParametricVentricles(150e-6, 10e-3, 1.8, 160e-6, 3.5e-3).surface()


def parts(surface: LabelledSurface) -> dict[str, np.ndarray]:
    return {name: surface.surfaces[name] for name in OPEN_SURFACES}


def test_the_base_is_recovered(ventricles: LabelledSurface) -> None:
    welded = weld_surfaces(ventricles.points, parts(ventricles))
    assert welded.volume() == pytest.approx(ventricles.volume(), rel=1e-12)
    assert np.ptp(welded.points[np.unique(welded.surfaces["base"]), 2]) < 1e-12


def test_triangles_may_be_turned_either_way(ventricles: LabelledSurface) -> None:
    turned = parts(ventricles) | {"rv_endo": ventricles.surfaces["rv_endo"][:, ::-1]}
    assert weld_surfaces(ventricles.points, turned).volume() == pytest.approx(ventricles.volume(), rel=1e-12)


def test_a_base_that_is_not_planar_is_refused(ventricles: LabelledSurface) -> None:
    bent = ventricles.points.copy()
    bent[:, 2] += 12.0 * bent[:, 0] ** 2
    with pytest.raises(InputError, match="plane"):
        weld_surfaces(bent, parts(ventricles))


def test_a_closed_endocardium_is_refused(ventricles: LabelledSurface) -> None:
    with pytest.raises(InputError, match=r"\bepi\b.*opening"):
        weld_surfaces(ventricles.points, parts(ventricles) | {"epi": ventricles.triangles})


def test_two_rings_in_one_surface_are_refused(ventricles: LabelledSurface) -> None:
    torn = np.delete(ventricles.surfaces["lv_endo"], 1500, axis=0)
    with pytest.raises(InputError, match=r"lv_endo 2, rv_endo 1, epi 1"):
        weld_surfaces(ventricles.points, parts(ventricles) | {"lv_endo": torn})
