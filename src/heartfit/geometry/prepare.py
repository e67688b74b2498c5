"""Assigns to a bare mesh the fields that follow from its shape."""

from dataclasses import replace

from heartfit.geometry.coordinates import LeftVentricularAxes
from heartfit.geometry.fibres import FibreRule
from heartfit.geometry.mesh import VentricularMesh
from heartfit.geometry.segments import aha_segments


def prepare(mesh: VentricularMesh) -> VentricularMesh:
    """The mesh with rule-based fibres, AHA segments and the longitudinal coordinate."""
    rule = FibreRule.of(mesh)
    return replace(
        mesh,
        fibres=rule.fibres(),
        orientation=rule.orientation(),
        segments=aha_segments(mesh),
        longitudinal=LeftVentricularAxes.of(mesh).longitudinal(mesh.points),
    )
