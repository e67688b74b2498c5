"""The page of a small study, made once."""

import pytest

from heartfit.geometry.mesh import VentricularMesh
from heartfit.results.report.page import Assets, render
from tests.results.report.small_report import study

ASSETS = Assets("const library = 1;", "const own = 2;", "body { color: black; }")
HOSTILE = "</script><img src=x onerror=alert(1)>&\u2028"
"""Hostile text of a user."""


@pytest.fixture(scope="session")
def page(ventricle: VentricularMesh) -> str:
    return render(study(ventricle, note=HOSTILE), ASSETS)
