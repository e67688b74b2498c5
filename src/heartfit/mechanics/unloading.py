r"""The stress-free reference of ventricles that were measured under pressure.

Given the end-diastolic positions x and cavity pressures P, find reference positions X with

.. math:: f(x - X; X) = \sum_c P_c \nabla V_c(x) .

The load depends on x alone, so it is fixed. At fixed x the Cauchy stress depends on X through F only, and moving
the reference by :math:`-\delta u` changes F as moving x by :math:`F \delta u` would; so the tangent is the forward
one, less what the latter owes to the moving x, times F:

.. math:: \frac{\partial f_a}{\partial u_b} = \big(K_{ab} + f_b \otimes h_a - f_a \otimes h_b\big) F, \qquad
          h_a = F^{-T} \nabla N_a,

with :math:`f_a` the forces of the element on its node a. Without these terms, which are of the order of K times the
strain, nearly incompressible linear tetrahedra do not converge. Supports and fibres follow the reference too; what
that adds, and terms of the order of the strain in the equation of the wall pressure, are left to Anderson mixing.
Source: Govindjee and Mihalic, Comput. Methods Appl. Mech. Eng. 136 (1996) 47 (inverse finite elastostatics).
"""

from dataclasses import replace

import numpy as np

from heartfit.geometry.arrays import Floats
from heartfit.geometry.mesh import VentricularMesh
from heartfit.mechanics import kinematics
from heartfit.mechanics.acceleration import Anderson
from heartfit.mechanics.body import FiniteElementBody, Step, StepFailed, Tissue, dyads_of
from heartfit.mechanics.general_solver import GeneralFactor
from heartfit.mechanics.kinematics import VOIGT

INCREMENT = 0.25
"""First increment of the load, over the whole."""

SMALLEST_INCREMENT = INCREMENT / 8
ITERATIONS = 20
CONTRACTION = 0.5
"""A step that shrinks the residual less than this renews the tangent."""
HALVINGS = 5
FORCE_TOLERANCE = 2e-3  # N


def unload(mesh: VentricularMesh, tissue: Tissue, pressures: Floats) -> VentricularMesh:
    """Stress-free mesh whose relaxed equilibrium under ``pressures`` (2,), Pa, is ``mesh``.

    Fibres are pulled back, so that the inflated fibres are those of ``mesh``. The load is applied in increments,
    which are halved where the search fails. Raises StepFailed if they become too small.
    """
    search, share, increment = _Search(mesh, tissue), 0.0, INCREMENT
    while share < 1.0:
        following = min(share + increment, 1.0)
        try:
            search.balance(following * pressures)
        except StepFailed:
            if increment <= SMALLEST_INCREMENT:
                raise
            increment *= 0.5
        else:
            share = following
    return search.reference


class _Search:
    """The reference found so far, with the wall pressures of the mixed element."""

    def __init__(self, loaded: VentricularMesh, tissue: Tissue) -> None:
        self.loaded, self.reference, self.tissue = loaded, loaded, tissue
        body = FiniteElementBody(loaded, tissue)
        self._elimination = body.elimination
        self._x = body.rest().x

    def balance(self, pressures: Floats) -> None:
        """Move the reference until it balances the cavity ``pressures`` (2,); leave it where it is on failure."""
        x, step, residual = self._x, *self._residual(self._x, pressures)
        anderson, previous, factor = Anderson(step.weights(x).ravel()), np.inf, None
        for _ in range(ITERATIONS):
            size = step.size(residual)
            if size < FORCE_TOLERANCE:
                self._x, self.reference = x, step.body.reference
                return
            if factor is None or size > CONTRACTION * previous:
                factor = _tangent(step, x)
                anderson.forget()
            previous = size
            change = anderson.mix(x.ravel(), -factor.solve(residual)).reshape(x.shape)
            x, step, residual = self._move(x, change, pressures, size)
        raise StepFailed(
            f"{_failure(pressures)}, residual {size:.3g} N: the wall is too soft for this pressure"
        )

    def _move(self, x: Floats, change: Floats, pressures: Floats, size: float) -> tuple[Floats, Step, Floats]:
        """Take the change, halved until no element collapses and the residual does not grow twofold."""
        for halving in range(HALVINGS):
            trial = x + 0.5**halving * change
            try:
                step, residual = self._residual(trial, pressures)
            except StepFailed:
                continue
            if step.size(residual) < 2.0 * size:
                return trial, step, residual
        raise StepFailed(f"{_failure(pressures)}: elements collapse, the wall is too soft for this pressure")

    def _residual(self, x: Floats, pressures: Floats) -> tuple[Step, Floats]:
        """Imbalance at the unknowns ``x``, whose displacements lead from the reference to the loaded mesh."""
        moved = self.loaded.with_points(self.loaded.points - x[:, :3])
        body = FiniteElementBody(_pull_back(moved, self.loaded), self.tissue, self._elimination)
        step = body.endless_step(body.rest())
        return step, step.forces(x) - body.volume_gradients(x) @ pressures


def _failure(pressures: Floats) -> str:
    return f"no unloaded reference at {pressures[0]:.0f} / {pressures[1]:.0f} Pa"


def _tangent(step: Step, x: Floats) -> GeneralFactor:
    """Factorised derivative of the forces at fixed loaded positions; see the module."""
    elements, nodes = step.stiffness(x)
    body, (F, S) = step.body, step.deformation
    slopes = body.gradients @ np.linalg.inv(F)
    forces = body.element_volumes[:, None, None] * body.gradients @ S[:, VOIGT] @ F.transpose(0, 2, 1)
    blocks = elements.reshape(len(F), 4, body.element.dofs, 4, body.element.dofs)
    blocks[:, :, :3, :, :3] += np.einsum("ebi,eaj->eaibj", forces, slopes)
    blocks[:, :, :3, :, :3] -= np.einsum("eai,ebj->eaibj", forces, slopes)
    blocks[..., :3] = np.einsum("eaibk,ekj->eaibj", blocks[..., :3], F)
    return GeneralFactor(body.tets, elements, nodes, body.elimination.permutation)


def _pull_back(reference: VentricularMesh, loaded: VentricularMesh) -> VentricularMesh:
    """The reference with the fibres of the loaded mesh, turned as the tissue is."""
    gradients, _ = kinematics.shape_gradients(loaded.points, loaded.tets)
    F = np.empty((len(loaded.tets), 3, 3))
    kinematics.deformation_gradient(reference.points - loaded.points, loaded.tets, gradients, F)
    fibres = np.einsum("eij,ej->ei", F, np.asarray(loaded.fibres))
    fibres /= np.linalg.norm(fibres, axis=1, keepdims=True)
    return replace(reference, fibres=fibres, orientation=kinematics.push_forward(dyads_of(loaded), F))
