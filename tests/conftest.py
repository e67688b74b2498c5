"""Fixtures and markers that tests of several folders share."""

import gc
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from hypothesis import settings

from heartfit.geometry.mesh import VentricularMesh
from heartfit.heart.finite_elements.body import FiniteElementBody, Tissue
from heartfit.heart.finite_elements.unloading import unload
from heartfit.heart.heart import Heart
from heartfit.heart.sphere.body import Sphere, SphericalBody
from verification.specimen import COARSE, specimen

settings.register_profile(
    "shared machine", deadline=None
)  # how long an example takes is no property of the code
settings.load_profile("shared machine")

PUBLISHED_HEART = ("../shared/data/bivme_patient1", "resources/bivme_patient1")
PHYSIOBLOCKS = ("../shared/data/physioblocks_bcs0d", "resources/physioblocks_bcs0d")
LAST_CYCLE = "spherical_heart_last_cycle_1kHz.csv"
DESELECTED = pytest.StashKey[dict[str, int]]()
END_DIASTOLIC_PRESSURE = np.array([1000.0, 500.0])


@pytest.fixture(scope="session")
def ventricle() -> VentricularMesh:
    """Ventricles at end diastole, on the coarsest mesh that beats."""
    return specimen(COARSE)


@pytest.fixture(scope="session")
def unloaded(ventricle: VentricularMesh) -> VentricularMesh:
    """The same ventricles without stress."""
    return unload(ventricle, Tissue(), END_DIASTOLIC_PRESSURE)


@pytest.fixture(scope="session")
def coarse_body(unloaded: VentricularMesh) -> FiniteElementBody:
    return FiniteElementBody(unloaded, Tissue())


@pytest.fixture(scope="session")
def spherical_heart() -> Heart:
    """Standard heart, with a contractility for :func:`spheres`."""
    return Heart().with_parameters({"sigma_0": 150e3})


@pytest.fixture(scope="session")
def spheres(spherical_heart: Heart) -> SphericalBody:
    """Ventricles of two spheres, which beat in a second."""
    left, right = Sphere.from_volumes(80e-6, 130e-6), Sphere.from_volumes(90e-6, 45e-6)
    return SphericalBody(left, right, spherical_heart.tissue)


@pytest.fixture(scope="module")
def coarse_search() -> Iterator[None]:
    """The search simulates beats at twice its time step and to ten times its drift, in half of the time.

    For a test about what a search concludes, of which a heart and its recording leave no doubt.
    """
    from heartfit.discovery.sphere_model import forward_model

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(forward_model, "NUMERICS", replace(forward_model.NUMERICS, time_step=1e-2, drift=1e-4))
        yield


def _first_folder(places: tuple[str, ...], content: str) -> Path | None:
    """Return the first place that has the content; a fetched licence alone is not enough."""
    root = Path(__file__).parents[1]
    return next((root / place for place in places if (root / place / content).exists()), None)


REQUIRED_DATA = {"published": (PUBLISHED_HEART, "vtk_ED_ES"), "physioblocks": (PHYSIOBLOCKS, LAST_CYCLE)}
"""Data that tests with a marker need, by marker: possible folders, and a file in them."""


@pytest.fixture(scope="session")
def measured_heart_folder() -> Path:
    """The measured heart as it is shipped."""
    return Path(__file__).parents[1] / "resources" / "measured_heart"


@pytest.fixture(scope="session")
def published_heart_folder() -> Path:
    """The measured heart as it was published, with its whole images and surfaces."""
    folder = _first_folder(*REQUIRED_DATA["published"])
    assert folder is not None, "a test that needs the published heart must carry the marker `published`"
    return folder


@pytest.fixture(scope="session")
def physioblocks_cycle() -> Path:
    folder = _first_folder(*REQUIRED_DATA["physioblocks"])
    assert folder is not None, (
        "a test that needs the cycle of PhysioBlocks must carry the marker `physioblocks`"
    )
    return folder / LAST_CYCLE


def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    """Deselect tests whose data is missing; the summary gives the reason."""
    config.stash[DESELECTED] = {}
    for marker in (marker for marker, data in REQUIRED_DATA.items() if _first_folder(*data) is None):
        needing = [item for item in items if item.get_closest_marker(marker)]
        items[:] = [item for item in items if item not in needing]
        config.hook.pytest_deselected(items=needing)
        config.stash[DESELECTED][marker] = len(needing)


def pytest_configure() -> None:
    """Collect no garbage while tests are collected: what is made then stays."""
    gc.disable()


def pytest_collection_finish() -> None:
    """Leave the tests and all that they import out of garbage collections, and make full ones thirty times as rare."""
    gc.freeze()
    gc.set_threshold(10_000, 10, 20)
    gc.enable()


def pytest_terminal_summary(terminalreporter: pytest.TerminalReporter, config: pytest.Config) -> None:
    for marker, count in config.stash.get(DESELECTED, {}).items():
        if count:
            places = ", ".join(REQUIRED_DATA[marker][0])
            terminalreporter.write_line(
                f"{count} tests `{marker}` deselected: their data is in none of {places}"
            )
