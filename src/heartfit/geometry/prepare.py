"""Assigns to a bare mesh the fields that follow from its shape."""

from dataclasses import replace

from heartfit.geometry.coordinates import LeftVentricularAxes
from heartfit.geometry.fibres import rule_based_fibres
from heartfit.geometry.mesh import VentricularMesh
from heartfit.geometry.segments import aha_segments


def prepare(mesh: VentricularMesh) -> VentricularMesh:
    """The mesh with rule-based fibres, AHA segments and the longitudinal coordinate."""
    return replace(
        mesh,
        fibres=rule_based_fibres(mesh),
        segments=aha_segments(mesh),
        longitudinal=LeftVentricularAxes.of(mesh).longitudinal(mesh.points),
    )
