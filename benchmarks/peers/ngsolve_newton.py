"""The Newton step by NGSolve's symbolic energy, differentiated by NGSolve, and its direct solvers."""

import clock
import ngsolve
import numpy as np
from netgen.csg import Pnt
from netgen.meshing import Element3D, FaceDescriptor, MeshPoint
from netgen.meshing import Mesh as NetgenMesh
from ngsolve import (
    H1,
    TET,
    BilinearForm,
    CoefficientFunction,
    Det,
    Grad,
    GridFunction,
    Id,
    InnerProduct,
    IntegrationRule,
    Mesh,
    Trace,
    Variation,
    VectorH1,
    VectorL2,
    dx,
)

SOLVERS = ("sparsecholesky", "umfpack")


def main() -> None:
    problem = clock.read_problem()
    step = Step(problem)
    residual_s, residual = clock.median_cpu(step.residual)
    tangent_s, matrix = clock.median_cpu(step.tangent)
    images = [step.image(matrix, direction) for direction in (problem.probe, problem.direction)]
    factor_s, solve_s, solver = min(map(step.solved, SOLVERS))
    times = {"residual": residual_s, "tangent": tangent_s, "factors": factor_s, "solution": solve_s}
    name = f"NGSolve {ngsolve.__version__}, {solver}"
    clock.say(problem, times, step.table(residual), images, name)


class Step:
    """Residual and tangent at the problem's state, by one point of integration, as linear elements need."""

    def __init__(self, problem: clock.Problem) -> None:
        self.shape, self.mixed = problem.x.shape, problem.x.shape[1] == 4
        mesh = netgen_mesh(problem.points, problem.tets)
        space = VectorH1(mesh, order=1)
        self.space = space * H1(mesh, order=1) if self.mixed else space
        self.x = GridFunction(self.space)
        self.x.vec.data = self.vector(problem.x)
        self.free = ngsolve.BitArray(self.space.ndof)
        self.free.Clear()
        for i in np.flatnonzero(problem.free.T.ravel()):
            self.free[int(i)] = True
        self.form = BilinearForm(self.space, symmetric=True)
        for energy, measure in self._energies(mesh, problem):
            self.form += Variation(energy.Compile() * measure)

    def _energies(self, mesh, problem):
        c_1, c_2, K, tension = map(float, problem.moduli)
        trial = self.space.TrialFunction()
        u, p = trial if self.mixed else (trial, None)
        fibres = GridFunction(VectorL2(mesh, order=0))
        fibres.vec.FV().NumPy()[:] = problem.fibres.T.ravel()
        F = Id(3) + Grad(u)
        C, J = F.trans * F, Det(F)
        I1 = Trace(C)
        I2 = 0.5 * (I1 * I1 - InnerProduct(C, C))
        wall = c_1 * J ** (-2 / 3) * I1 + c_2 * J ** (-4 / 3) * I2
        wall += 0.5 * tension * InnerProduct(F * fibres, F * fibres)
        one = dx(intrules={TET: IntegrationRule([(0.25, 0.25, 0.25)], [1 / 6])})
        if p is None:
            return [(wall + 0.5 * K * (J - 1) * (J - 1), one)]
        G = 2.0 * (c_1 + c_2)
        four = dx(intrules={TET: IntegrationRule(TET, 2)})
        mean = CoefficientFunction(p * p)
        return [(wall + p * (J - 1) + 0.5 / G * mean, one), (-0.5 * (1 / K + 1 / G) * p * p, four)]

    def vector(self, table: np.ndarray):
        result = GridFunction(self.space).vec.CreateVector()
        result.FV().NumPy()[:] = table.T.ravel()
        return result

    def table(self, vector) -> np.ndarray:
        return vector.FV().NumPy().reshape(self.shape[::-1]).T

    def residual(self):
        result = self.x.vec.CreateVector()
        self.form.Apply(self.x.vec, result)
        return result

    def tangent(self):
        self.form.AssembleLinearization(self.x.vec)
        return self.form.mat

    def image(self, matrix, table: np.ndarray) -> np.ndarray:
        source, result = self.vector(table), self.x.vec.CreateVector()
        result.data = matrix * source
        return self.table(result)

    def solved(self, solver: str) -> tuple[float, float, str]:
        """CPU s for factors and solution, and the solver's name; infinite where it does not solve."""
        try:
            factor_s, inverse = clock.median_cpu(lambda: self.form.mat.Inverse(self.free, inverse=solver))
        except Exception as refusal:  # NGSolve raises its own kinds
            return np.inf, np.inf, f"{solver}: {refusal}"
        right, left, back = (self.x.vec.CreateVector() for _ in range(3))
        right.data = self.residual()
        solve_s, _ = clock.median_cpu(lambda: inverse.Mult(right, left))
        back.data = self.form.mat * left
        mask = np.array([self.free[i] for i in range(self.space.ndof)])
        missing = (back.FV().NumPy() - right.FV().NumPy())[mask]
        solved = np.linalg.norm(missing) < 1e-6 * np.linalg.norm(right.FV().NumPy()[mask])
        return (factor_s, solve_s, solver) if solved else (np.inf, np.inf, f"{solver} fails")


def netgen_mesh(points: np.ndarray, tets: np.ndarray) -> Mesh:
    mesh = NetgenMesh(dim=3)
    mesh.Add(FaceDescriptor(surfnr=1, domin=1, bc=1))
    for point in points:
        mesh.Add(MeshPoint(Pnt(*map(float, point))))
    for a, b, c, d in tets.tolist():
        mesh.Add(Element3D(1, [a + 1, c + 1, b + 1, d + 1]))
    return Mesh(mesh)


if __name__ == "__main__":
    main()
