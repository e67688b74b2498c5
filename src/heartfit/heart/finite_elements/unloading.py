r"""Static equilibria of the relaxed wall: inflation, and the stress-free reference of a loaded mesh.

Inflation finds x at given X and cavity pressures P, in increments of P. Unloading is the inverse: given the positions x
of ventricles that were measured under the pressures P, at end diastole, find reference positions X with

.. math:: f(x - X; X) = \sum_c P_c \nabla V_c(x) .

The load depends on x alone and is therefore fixed. At fixed x the Cauchy stress depends on X through F only, and moving
the reference by :math:`-\delta u` changes F as a displacement :math:`F \delta u` of x would; so the tangent is the
forward one, without the terms due to the change of x, times F:

.. math:: \frac{\partial f_a}{\partial u_b} = \big(K_{ab} + f_b \otimes h_a - f_a \otimes h_b\big) F, \qquad
          h_a = F^{-T} \nabla N_a,

with :math:`f_a` the forces of the element on its node a. Without these terms, which are of the order of K times the
strain, nearly incompressible linear tetrahedra do not converge. Supports and fibres follow the reference too; their
contribution, and terms of the order of the strain in the equation of the wall pressure, are left to Anderson mixing.
Source: Govindjee and Mihalic, Comput. Methods Appl. Mech. Eng. 136 (1996) 47 (inverse finite elastostatics).
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from heartfit.core.arrays import Floats
from heartfit.geometry.mesh import VentricularMesh
from heartfit.heart.finite_elements import kinematics
from heartfit.heart.finite_elements.body import FiniteElementBody, Step, Tissue, mean_dyads
from heartfit.heart.finite_elements.kinematics import VOIGT, StepFailed
from heartfit.heart.finite_elements.solver import Elimination, Factor
from heartfit.heart.time_step import Anderson

INFLATION_INCREMENTS = 6
INFLATION_ITERATIONS = 40
INFLATION_FORCE_TOLERANCE = 1e-6
"""Residual force of the inflated wall [N]; every beat starts at such a state."""

INFLATION_CONTRACTION = 0.4
"""Ratio of successive residuals above which the tangent is renewed."""


def inflate(body: Any, pressures: Floats, increments: int = INFLATION_INCREMENTS) -> Any:
    """State of ``body`` inflated from rest to ``pressures`` (2,) [Pa]; raises StepFailed if it has none."""
    state, factor = body.rest(), None
    for share in np.linspace(0.0, 1.0, increments + 1)[1:]:
        state, factor = _equilibrium(body, state, share * pressures, factor)
    return state


def _equilibrium(body: Any, state: Any, pressures: Floats, factor: Any) -> tuple[Any, Any]:
    """State in equilibrium with ``pressures``, and the last factor of the tangent, for the next increment."""
    step, x, previous = body.static_step(state), state.x.copy(), np.inf
    for _ in range(INFLATION_ITERATIONS):
        residual = step.forces(x) - body.volume_gradients(x) @ pressures
        size = step.size(residual)
        if size < INFLATION_FORCE_TOLERANCE:
            return step.commit(x), factor
        if factor is None or size > INFLATION_CONTRACTION * previous:
            factor = step.tangent(x)
        previous = size
        x = x - factor.solve(residual).reshape(x.shape)
    raise StepFailed(
        f"no static equilibrium at {pressures[0]:.0f} / {pressures[1]:.0f} Pa, residual {size:.3g} N: "
        "the wall is too soft for this pressure, or the supports are too weak"
    )


SMALLEST_INCREMENT = 1.0 / 32
"""Increment of the load, as a fraction of the whole, below which unloading fails."""

UNLOADING_ITERATIONS = 20
UNLOADING_CONTRACTION = 0.5
"""Ratio of successive residuals above which the tangent is renewed."""

UNLOADING_HALVINGS = 5
UNLOADING_FORCE_TOLERANCE = 1e-4
"""Residual force of the unloaded reference [N]; the softest walls do not reach 1e-5."""

NEIGHBOUR_ITERATIONS, NEIGHBOUR_TOLERANCE = 20, 1e-6
"""Corrections of a neighbouring reference, and the residual force [N] that ends them."""


def unload(
    mesh: VentricularMesh, tissue: Tissue, pressures: Floats, near: VentricularMesh | None = None
) -> VentricularMesh:
    """Stress-free mesh whose relaxed equilibrium under ``pressures`` (2,) [Pa] is ``mesh``.

    Fibres are pulled back, so that the inflated fibres are those of ``mesh``. The load is applied at once, from the
    stress-free mesh of a similar wall, ``near``, or from ``mesh``; after a failure in increments, which are halved.
    Raises StepFailed if they fall below SMALLEST_INCREMENT.
    """
    if near is not None:
        search = _ReferenceSearch(mesh, tissue)
        search.unknowns[:, :3] = mesh.points - near.points
        try:
            search.balance(pressures)
        except StepFailed:
            pass  # no such start is near enough for some walls
        else:
            return search.reference
    return _search_reference(mesh, tissue, pressures).reference


@dataclass(frozen=True, eq=False)
class LoadedWall:
    """A mesh that was measured under the pressures (2,) [Pa] in its cavities, and its tissue."""

    mesh: VentricularMesh
    tissue: Tissue
    pressures: Floats

    def rests_like(self, other: "LoadedWall") -> bool:
        """True if both walls have the same stress-free reference: shape, fibres, load and passive parts are equal."""
        parts = [(wall.tissue.passive, wall.tissue.support, wall.tissue.element) for wall in (self, other)]
        arrays = [
            (wall.pressures, wall.tissue.stiffenings(), wall.mesh.points, mean_dyads(wall.mesh))
            for wall in (self, other)
        ]
        return parts[0] == parts[1] and all(map(np.array_equal, *arrays))


def unload_neighbours(
    wall: LoadedWall, others: Sequence[LoadedWall]
) -> tuple[VentricularMesh, list[VentricularMesh]]:
    """Stress-free mesh of ``wall``, and those of ``others`` at the same positions, which differ a little otherwise.

    Every neighbour is corrected with the one factorised tangent of the first mesh, so that their differences are exact
    to NEIGHBOUR_TOLERANCE. Raises StepFailed as `unload` does, or if a correction does not converge.
    """
    search = _search_reference(wall.mesh, wall.tissue, wall.pressures)
    correct = search.corrector(wall.pressures)
    start = correct(search.unknowns, wall)
    meshes = [_reference_at(other.mesh, correct(start, other)) for other in others]
    return _reference_at(wall.mesh, start), meshes


def _search_reference(mesh: VentricularMesh, tissue: Tissue, pressures: Floats) -> "_ReferenceSearch":
    """Search that has balanced the ``pressures``."""
    search, share, increment = _ReferenceSearch(mesh, tissue), 0.0, 1.0
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
    return search


class _ReferenceSearch:
    """Current reference, with the wall pressures of the mixed element."""

    def __init__(self, loaded: VentricularMesh, tissue: Tissue) -> None:
        self.loaded, self.reference, self.tissue = loaded, loaded, tissue
        body = FiniteElementBody(loaded, tissue)
        self._elimination = body.elimination
        self.unknowns = body.rest().x

    def balance(self, pressures: Floats) -> None:
        """Move the reference until it balances the cavity ``pressures`` (2,) [Pa]; on failure it stays unchanged."""
        x, step, residual = self.unknowns, *self._residual(self.unknowns, pressures)
        anderson, previous, factor = Anderson(step.weights(x).ravel()), np.inf, None
        for _ in range(UNLOADING_ITERATIONS):
            size = step.size(residual)
            if size < UNLOADING_FORCE_TOLERANCE:
                self.unknowns, self.reference = x, step.body.reference
                return
            if factor is None or size > UNLOADING_CONTRACTION * previous:
                factor = _tangent(step, x)
                anderson.forget()
            previous = size
            change = anderson.mix(x.ravel(), -factor.solve(residual)).reshape(x.shape)
            x, step, residual = self._move(x, change, pressures, size)
        raise StepFailed(
            f"{_failure_message(pressures)}, residual {size:.3g} N: the wall is too soft for this pressure"
        )

    def _move(self, x: Floats, change: Floats, pressures: Floats, size: float) -> tuple[Floats, Step, Floats]:
        """Apply the change, halved until no element collapses and the residual less than doubles."""
        for halving in range(UNLOADING_HALVINGS):
            trial = x + 0.5**halving * change
            try:
                step, residual = self._residual(trial, pressures)
            except StepFailed:
                continue
            if step.size(residual) < 2.0 * size:
                return trial, step, residual
        raise StepFailed(
            f"{_failure_message(pressures)}: elements collapse, the wall is too soft for this pressure"
        )

    def corrector(self, pressures: Floats) -> Callable[[Floats, LoadedWall], Floats]:
        """Map from unknowns (n, dofs) and a wall to the balanced unknowns, with the tangent at the last balance."""
        step, _ = self._residual(self.unknowns, pressures)
        factor = _tangent(step, self.unknowns)

        def correct(x: Floats, wall: LoadedWall) -> Floats:
            for _ in range(NEIGHBOUR_ITERATIONS):
                at_x, residual = _residual_at(x, wall, self._elimination)
                if at_x.size(residual) < NEIGHBOUR_TOLERANCE:
                    return x
                x = x - factor.solve(residual).reshape(x.shape)
            raise StepFailed(
                f"{_failure_message(wall.pressures)} near that of another wall, residual "
                f"{at_x.size(residual):.3g} N: expected a smaller difference"
            )

        return correct

    def _residual(self, x: Floats, pressures: Floats) -> tuple[Step, Floats]:
        return _residual_at(x, LoadedWall(self.loaded, self.tissue, pressures), self._elimination)


def _residual_at(x: Floats, wall: LoadedWall, elimination: Elimination) -> tuple[Step, Floats]:
    """Residual (N,) at the unknowns ``x``, whose displacements lead from the reference to the loaded mesh."""
    body = FiniteElementBody(_reference_at(wall.mesh, x), wall.tissue, elimination)
    step = body.static_step(body.rest())
    return step, step.forces(x) - body.volume_gradients(x) @ wall.pressures


def _reference_at(loaded: VentricularMesh, x: Floats) -> VentricularMesh:
    """Reference from which the displacements ``x`` lead to the loaded mesh, with its fibres."""
    return _pull_back(loaded.with_points(loaded.points - x[:, :3]), loaded)


def _failure_message(pressures: Floats) -> str:
    return f"no unloaded reference at {pressures[0]:.0f} / {pressures[1]:.0f} Pa"


def _tangent(step: Step, x: Floats) -> Factor:
    """Factorised derivative of the forces at fixed loaded positions; see the equation of the module."""
    elements, nodes = step.stiffness(x)
    body, (F, S) = step.body, step.deformation
    slopes = body.gradients @ np.linalg.inv(F)
    forces = body.element_volumes[:, None, None] * body.gradients @ S[:, VOIGT] @ F.transpose(0, 2, 1)
    blocks = elements.reshape(len(F), 4, body.element.dofs, 4, body.element.dofs)
    blocks[:, :, :3, :, :3] += np.einsum("ebi,eaj->eaibj", forces, slopes)
    blocks[:, :, :3, :, :3] -= np.einsum("eai,ebj->eaibj", forces, slopes)
    blocks[..., :3] = np.einsum("eaibk,ekj->eaibj", blocks[..., :3], F)
    return body.elimination.factorise(elements, nodes, symmetric=False)


def _pull_back(reference: VentricularMesh, loaded: VentricularMesh) -> VentricularMesh:
    """Reference with the fibres of the loaded mesh, mapped back by its deformation gradient."""
    gradients, _ = kinematics.shape_gradients(loaded.points, loaded.tets)
    F = np.empty((len(loaded.tets), 3, 3))
    kinematics.deformation_gradient(reference.points - loaded.points, loaded.tets, gradients, F)
    fibres = np.einsum("eij,ej->ei", F, np.asarray(loaded.fibres))
    fibres /= np.linalg.norm(fibres, axis=1, keepdims=True)
    return replace(reference, fibres=fibres, orientation=kinematics.push_forward(mean_dyads(loaded), F))
