"""Static equilibrium under a follower pressure and a constant fibre tension.

Newton's method along a path of increasing loads. The tangent of the wall is factorised and preconditions GMRES, which
includes the tangent of the pressure, not symmetric on an open surface. The nodal force of a pressure is quadratic in
the positions, so a central difference differentiates it exactly.
"""

from dataclasses import dataclass, replace

import numpy as np
from scipy.sparse.linalg import LinearOperator, gmres

from heartfit.core.arrays import Floats, Integers
from heartfit.geometry.mesh import VentricularMesh
from heartfit.heart.finite_elements.body import FiniteElementBody, StepFailed, Tissue
from heartfit.heart.finite_elements.solver import Elimination, Factor
from heartfit.heart.muscle.passive import Passive
from verification.block import ConstantTension, Held

TOLERANCE = 1e-4
"""Largest residual over the load."""
ITERATIONS, HALVINGS = 40, 6
CONTRACTION = 0.3
"""Ratio of residuals above which the tangent is renewed."""
FIRST, SHORTEST = 0.1, 1e-3
"""First and smallest step along the path, as shares of the load."""


@dataclass(frozen=True, eq=False)
class Loading:
    """A ``pressure`` [Pa] on the triangles ``loaded`` (k, 3), against their normals, and a fibre ``tension`` [Pa].

    ``held`` (n, 3) masks the components of the displacement that stay zero.
    """

    mesh: VentricularMesh
    material: Passive
    held: np.ndarray
    loaded: Integers
    pressure: float
    tension: float = 0.0
    element: str = "mixed"

    def body(self, elimination: Elimination | None = None) -> FiniteElementBody:
        """Build the wall with the fibre tension of this load."""
        active = ConstantTension(tension_of_fibres=self.tension)
        tissue = Tissue(self.material, active, support=Held(held=self.held), element=self.element)
        return FiniteElementBody(self.mesh, tissue, elimination)

    def share(self, part: float) -> "Loading":
        """Scale the load."""
        return replace(self, pressure=part * self.pressure, tension=part * self.tension)


def pressure_force(positions: Floats, triangles: Integers) -> Floats:
    """Nodal forces (n, 3) of a unit pressure against the normals of ``triangles`` (k, 3)."""
    a, b, c = (positions[triangles[:, i]] for i in range(3))
    thirds, force = -np.cross(b - a, c - a) / 6.0, np.zeros_like(positions)
    for corner in range(3):
        np.add.at(force, triangles[:, corner], thirds)
    return force


def equilibrium(loading: Loading) -> Floats:
    """Solve for the unknowns (n, dofs) at the full load; raises StepFailed if the path ends before."""
    whole = loading.body()
    rest = np.zeros((len(loading.mesh.points), whole.element.dofs))
    path, stride = [(0.0, rest), (0.0, rest)], FIRST
    while path[-1][0] < 1.0:
        part = min(1.0, path[-1][0] + stride)
        try:
            x, factors = _newton(loading.share(part), _extrapolate(path, part), whole.elimination)
        except StepFailed:
            stride = 0.5 * (part - path[-1][0])
            if stride < SHORTEST:
                raise
            continue
        path, stride = [path[-1], (part, x)], stride * (1.5 if factors <= 3 else 1.0)
    return path[-1][1]


def _extrapolate(path: list[tuple[float, Floats]], part: float) -> Floats:
    (before, old), (now, x) = path
    return x + (x - old) * (part - now) / (now - before) if now > before else x.copy()


def _newton(loading: Loading, x: Floats, elimination: Elimination) -> tuple[Floats, int]:
    """Solve for the equilibrium near ``x``; returns it with the number of tangents. Raises StepFailed."""
    balance, factors, last = Balance(loading, elimination), 0, np.inf
    residual = balance.residual(x)
    for _ in range(ITERATIONS):
        size = balance.size(residual)
        if size < TOLERANCE:
            return x, factors
        if size > CONTRACTION * last or not factors:
            balance.linearise(x)
            factors += 1
        last = size
        x, residual = balance.step_back(x, balance.change(x, residual), size)
    raise StepFailed(f"no equilibrium at {loading.pressure:.4g} Pa, residual {size:.2g} of the load")


class Balance:
    """Residual and Newton step of one load."""

    def __init__(self, loading: Loading, elimination: Elimination) -> None:
        body = loading.body(elimination)
        self._loading, self._step, self._points = (
            loading,
            body.static_step(body.rest()),
            body.reference.points,
        )
        self._load = loading.pressure * float(np.linalg.norm(pressure_force(self._points, loading.loaded)))

    def residual(self, x: Floats) -> Floats:
        """Unbalanced forces and volumes (n, dofs), zero where the displacement is held."""
        residual = self._step.forces(x).reshape(x.shape)
        residual[:, :3] -= self._pressure(self._points + x[:, :3])
        residual[:, :3][self._loading.held] = 0.0
        return residual

    def size(self, residual: Floats) -> float:
        """Norm of a residual over that of the load."""
        return self._step.size(residual) / self._load

    def linearise(self, x: Floats) -> None:
        """Factorise the tangent of the wall at ``x``; the last factor is released first, to save memory."""
        self._factor: Factor | None = None
        self._step.forces(x)
        self._factor = self._step.tangent(x)

    def change(self, x: Floats, residual: Floats) -> Floats:
        """Newton step (n, dofs), to be subtracted from ``x``."""
        positions, factor, held = self._points + x[:, :3], self._factor, self._loading.held
        assert factor is not None

        def preconditioned(change: Floats) -> Floats:
            motion, force = change.reshape(x.shape)[:, :3], np.zeros_like(x)
            force[:, :3] = 0.5 * (self._pressure(positions + motion) - self._pressure(positions - motion))
            force[:, :3][held] = 0.0
            return change - factor.solve(force.ravel())

        tangent = LinearOperator((x.size, x.size), matvec=preconditioned)
        change = gmres(tangent, factor.solve(residual.ravel()), rtol=1e-2, restart=20, maxiter=1)[0]
        result: Floats = change.reshape(x.shape)
        result[:, :3][held] = 0.0
        return result

    @np.errstate(over="ignore", invalid="ignore")  # an exponential law overflows if a step is too long
    def step_back(self, x: Floats, change: Floats, size: float) -> tuple[Floats, Floats]:
        """Subtract the largest share of the change that inverts no element and keeps the residual bounded."""
        for share in 0.5 ** np.arange(HALVINGS):
            try:
                residual = self.residual(x - share * change)
            except StepFailed:
                continue
            if self.size(residual) < 2.0 * size + 0.1:
                return x - share * change, residual
        raise StepFailed("every part of a Newton step leads away from equilibrium")

    def _pressure(self, positions: Floats) -> Floats:
        return self._loading.pressure * pressure_force(positions, self._loading.loaded)
