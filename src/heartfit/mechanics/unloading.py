r"""The stress-free reference of ventricles that were measured under pressure.

Given the end-diastolic positions x and cavity pressures P, find reference positions X with

.. math:: f(x - X; X) = \sum_c P_c \nabla V_c(x) .

The load depends on x alone, so it is fixed; only the internal forces change with X. The correction
:math:`X \leftarrow X + K^{-1} r`, K the tangent at the current reference, is Newton's method up to the
dependence of f on the shape of X, which is of the order of the strain.
"""

from dataclasses import replace

import numpy as np

from heartfit.geometry.arrays import Floats
from heartfit.geometry.mesh import VentricularMesh
from heartfit.mechanics import kinematics
from heartfit.mechanics.body import FiniteElementBody, StepFailed, Tissue

INCREMENTS = 4
ITERATIONS = 60
FORCE_TOLERANCE = 1e-3  # N


def unload(mesh: VentricularMesh, tissue: Tissue, pressures: Floats) -> VentricularMesh:
    """Stress-free mesh whose relaxed equilibrium under ``pressures`` (2,), Pa, is ``mesh``.

    Fibres are pulled back, so that the inflated fibres are those of ``mesh``. Raises StepFailed if the
    corrections do not converge.
    """
    reference, wall_pressure, body = mesh, None, None
    for share in np.linspace(0.0, 1.0, INCREMENTS + 1)[1:]:
        reference, wall_pressure = _solve(mesh, reference, tissue, share * pressures, wall_pressure)
    return replace(reference, fibres=_pull_back(reference, mesh))


def _solve(
    loaded: VentricularMesh, reference: VentricularMesh, tissue: Tissue, pressures: Floats, x: Floats | None
) -> tuple[VentricularMesh, Floats]:
    factor, previous = None, np.inf
    body = FiniteElementBody(reference, tissue)
    pattern = body.pattern
    for _ in range(ITERATIONS):
        body = FiniteElementBody(reference, tissue)
        body.__dict__["pattern"] = pattern
        rest = body.rest()
        unknowns = rest.x if x is None else x.copy()
        unknowns[:, :3] = loaded.points - reference.points
        step = body.endless_step(rest)
        residual = step.forces(unknowns) - body.volume_gradients(unknowns) @ pressures
        size = step.size(residual)
        if size < FORCE_TOLERANCE:
            return reference, unknowns
        if factor is None or size > 0.5 * previous:
            factor = step.tangent(unknowns)
        previous = size
        change = factor.solve(residual).reshape(unknowns.shape)
        reference = reference.with_points(reference.points + change[:, :3])
        x = unknowns - change
    raise StepFailed(
        f"no unloaded reference at {pressures[0]:.0f} / {pressures[1]:.0f} Pa, residual {size:.3g} N: "
        "the wall is too soft for this pressure"
    )


def _pull_back(reference: VentricularMesh, loaded: VentricularMesh) -> Floats:
    gradients, _ = kinematics.shape_gradients(loaded.points, loaded.tets)
    F = np.empty((len(loaded.tets), 3, 3))
    kinematics.deformation_gradient(reference.points - loaded.points, loaded.tets, gradients, F)
    fibres = np.einsum("eij,ej->ei", F, np.asarray(loaded.fibres))
    pulled: Floats = fibres / np.linalg.norm(fibres, axis=1, keepdims=True)
    return pulled
