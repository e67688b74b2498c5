"""The Newton step by scikit-fem's forms, linearised by hand, and SuperLU as scipy calls it by default."""

import clock
import numpy as np
import scipy
import skfem
from scipy.sparse.linalg import splu
from skfem import Basis, BilinearForm, ElementTetP1, ElementVector, LinearForm, MeshTet
from skfem.helpers import ddot, grad


def main() -> None:
    problem = clock.read_problem()
    step = Step(problem)
    residual_s, residual = clock.median_cpu(step.residual)
    tangent_s, matrix = clock.median_cpu(step.tangent)
    inner = matrix[step.free][:, step.free].tocsc()
    factor_s, factors = clock.median_cpu(lambda: splu(inner))
    solve_s, _ = clock.median_cpu(lambda: factors.solve(residual[step.free]))
    times = {"residual": residual_s, "tangent": tangent_s, "factors": factor_s, "solution": solve_s}
    images = [step.table(matrix @ step.vector(direction)) for direction in (problem.probe, problem.direction)]
    solver = f"scikit-fem {skfem.__version__}, SuperLU of scipy {scipy.__version__}"
    clock.say(problem, times, step.table(residual), images, solver)


class Step:
    """Residual and tangent at the problem's state; the constant pressure blocks are assembled once."""

    def __init__(self, problem: clock.Problem) -> None:
        self.mixed = problem.x.shape[1] == 4
        mesh = MeshTet(np.ascontiguousarray(problem.points.T), np.ascontiguousarray(problem.tets.T))
        displacement = ElementVector(ElementTetP1())
        self.element = displacement * ElementTetP1() if self.mixed else displacement
        self.basis = Basis(mesh, self.element, intorder=1)
        self.numbers = self.basis.nodal_dofs.T
        self.c_1, self.c_2, self.K, self.tension = problem.moduli
        self.fibres = problem.fibres.T[:, :, None]
        self.x, self.free = self.vector(problem.x), np.sort(self.numbers[problem.free])
        self.compliance = self._compliance(mesh) if self.mixed else None

    def vector(self, table: np.ndarray) -> np.ndarray:
        result = np.empty(self.basis.N)
        result[self.numbers] = table
        return result

    def table(self, vector: np.ndarray) -> np.ndarray:
        return vector[self.numbers]

    def _compliance(self, mesh: MeshTet) -> object:
        G = 2.0 * (self.c_1 + self.c_2)
        mass = BilinearForm(lambda u, p, v, q, w: p * q)
        whole = mass.assemble(Basis(mesh, self.element, intorder=2))
        return whole / self.K + (whole - mass.assemble(self.basis)) / G

    def _state(self) -> tuple[np.ndarray, np.ndarray | None]:
        interpolated = self.basis.interpolate(self.x)
        u, p = interpolated if self.mixed else (interpolated, None)
        return np.asarray(u.grad) + np.eye(3)[:, :, None, None], None if p is None else np.asarray(p)

    def residual(self) -> np.ndarray:
        F, p = self._state()
        P, J = self._stress(F, p), determinant(F)
        if not self.mixed:
            return LinearForm(lambda v, w: ddot(P, grad(v))).assemble(self.basis)
        form = LinearForm(lambda v, q, w: ddot(P, grad(v)) + (J - 1.0) * q)
        return form.assemble(self.basis) - self.compliance @ self.x

    def tangent(self) -> object:
        F, p = self._state()
        A = self._stiffness(F, p)
        if not self.mixed:
            form = BilinearForm(lambda u, v, w: ddot(np.einsum("ijkl...,kl...->ij...", A, grad(u)), grad(v)))
            return form.assemble(self.basis).tocsr()
        cofactor = determinant(F) * inverse_transpose(F)

        def mixed(u, p, v, q, w):
            pressures = p * ddot(cofactor, grad(v)) + q * ddot(cofactor, grad(u))
            return ddot(np.einsum("ijkl...,kl...->ij...", A, grad(u)), grad(v)) + pressures

        return (BilinearForm(mixed).assemble(self.basis) - self.compliance).tocsr()

    def _stress(self, F: np.ndarray, p: np.ndarray | None) -> np.ndarray:
        """First Piola-Kirchhoff stress, Pa."""
        H, J = inverse_transpose(F), determinant(F)
        C = np.einsum("ki...,kj...->ij...", F, F)
        I1 = np.einsum("ii...->...", C)
        I2 = 0.5 * (I1**2 - np.einsum("ij...,ij...->...", C, C))
        FC = np.einsum("ik...,kj...->ij...", F, C)
        first = 2.0 * self.c_1 * J ** (-2.0 / 3.0) * (F - I1 / 3.0 * H)
        second = 2.0 * self.c_2 * J ** (-4.0 / 3.0) * (I1 * F - FC - 2.0 / 3.0 * I2 * H)
        pressure = self.K * (J - 1.0) if p is None else p
        Ff = np.einsum("ij...,j...->i...", F, self.fibres)
        return first + second + pressure * J * H + self.tension * Ff[:, None] * self.fibres[None]

    def _stiffness(self, F: np.ndarray, p: np.ndarray | None) -> np.ndarray:
        """Its derivative by F (3, 3, 3, 3, ...): the complex step is exact to rounding."""
        A = np.empty((3, 3, *F.shape))
        for k in range(3):
            for m in range(3):
                perturbed = F.astype(complex)
                perturbed[k, m] += 1e-30j
                A[:, :, k, m] = self._stress(perturbed, p).imag / 1e-30
        return A


def determinant(F: np.ndarray) -> np.ndarray:
    return np.einsum("i...,i...->...", F[0], np.cross(F[1], F[2], axis=0))


def inverse_transpose(F: np.ndarray) -> np.ndarray:
    rows = [np.cross(F[(i + 1) % 3], F[(i + 2) % 3], axis=0) for i in range(3)]
    return np.stack(rows) / determinant(F)


if __name__ == "__main__":
    main()
