r"""The stress-free reference of ventricles that were measured under pressure.

Given the end-diastolic positions x and cavity pressures P, find reference positions X with

.. math:: f(x - X; X) = \sum_c P_c \nabla V_c(x) .

The load depends on x alone, so it is fixed; only the internal forces change with X. The correction
:math:`X \leftarrow X + K^{-1} r`, K the tangent at the current reference, is Newton's method up to the
dependence of f on the shape of X, which is of the order of the strain; Anderson mixing makes up for that.
"""

from dataclasses import replace

import numpy as np

from heartfit.geometry.arrays import Floats
from heartfit.geometry.mesh import VentricularMesh
from heartfit.mechanics import kinematics
from heartfit.mechanics.acceleration import Anderson
from heartfit.mechanics.assembly import SparsityPattern
from heartfit.mechanics.body import FiniteElementBody, Step, StepFailed, Tissue

INCREMENTS = 4
ITERATIONS = 60
HALVINGS = 5
FORCE_TOLERANCE = 2e-3  # N


def unload(mesh: VentricularMesh, tissue: Tissue, pressures: Floats) -> VentricularMesh:
    """Stress-free mesh whose relaxed equilibrium under ``pressures`` (2,), Pa, is ``mesh``.

    Fibres are pulled back, so that the inflated fibres are those of ``mesh``. Raises StepFailed if the
    corrections do not converge.
    """
    search = _Search(mesh, tissue)
    for share in np.linspace(0.0, 1.0, INCREMENTS + 1)[1:]:
        search.balance(share * pressures)
    return replace(search.reference, fibres=_pull_back(search.reference, mesh))


class _Search:
    """The reference found so far, with the wall pressures of the mixed element."""

    def __init__(self, loaded: VentricularMesh, tissue: Tissue) -> None:
        self.loaded, self.reference, self.tissue = loaded, loaded, tissue
        body = FiniteElementBody(loaded, tissue)
        self._pattern: SparsityPattern = body.pattern
        self._x = body.rest().x

    def balance(self, pressures: Floats) -> None:
        """Move the reference until it balances the cavity ``pressures`` (2,)."""
        step, residual = self._residual(self._x, pressures)
        factor = step.tangent(self._x)
        anderson = Anderson(step.weights(self._x).ravel())
        for _ in range(ITERATIONS):
            size = step.size(residual)
            if size < FORCE_TOLERANCE:
                return
            change = anderson.mix(self._x.ravel(), -factor.solve(residual)).reshape(self._x.shape)
            step, residual, shortened = self._correct(change, pressures, size)
            if shortened:
                factor = step.tangent(self._x)
                anderson.forget()
        raise StepFailed(
            f"no unloaded reference at {pressures[0]:.0f} / {pressures[1]:.0f} Pa, residual {size:.3g} N: "
            "the wall is too soft for this pressure"
        )

    def _correct(self, change: Floats, pressures: Floats, size: float) -> tuple[Step, Floats, bool]:
        """Take the change, halved until no element collapses and the residual does not grow twofold."""
        for halving in range(HALVINGS):
            trial = self._x + 0.5**halving * change
            try:
                step, residual = self._residual(trial, pressures)
            except StepFailed:
                continue
            if step.size(residual) < 2.0 * size:
                self._x = trial
                return step, residual, halving > 0
        raise StepFailed(
            f"no unloaded reference at {pressures[0]:.0f} / {pressures[1]:.0f} Pa: elements collapse"
        )

    def _residual(self, x: Floats, pressures: Floats) -> tuple[Step, Floats]:
        """Imbalance at the unknowns ``x``, whose displacements lead from the reference to the loaded mesh."""
        self.reference = self.loaded.with_points(self.loaded.points - x[:, :3])
        body = FiniteElementBody(self.reference, self.tissue, self._pattern)
        step = body.endless_step(body.rest())
        return step, step.forces(x) - body.volume_gradients(x) @ pressures


def _pull_back(reference: VentricularMesh, loaded: VentricularMesh) -> Floats:
    gradients, _ = kinematics.shape_gradients(loaded.points, loaded.tets)
    F = np.empty((len(loaded.tets), 3, 3))
    kinematics.deformation_gradient(reference.points - loaded.points, loaded.tets, gradients, F)
    fibres = np.einsum("eij,ej->ei", F, np.asarray(loaded.fibres))
    pulled: Floats = fibres / np.linalg.norm(fibres, axis=1, keepdims=True)
    return pulled
