r"""Ventricular wall of finite elements: internal forces and tangent at the end of one time step.

Find u (and the wall pressure p) with, for all :math:`\delta u`,

.. math:: \int (S_{passive} + S_{visc} + S_p + \sigma_{1D} f \otimes f) : \delta E + \text{support} =
          \sum_c P_c\, \delta V_c .

Inertia, about 1e-4 of the internal forces, is neglected.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from heartfit.core.arrays import Floats
from heartfit.core.errors import InputError
from heartfit.geometry.cavity import Cavity
from heartfit.geometry.mesh import VentricularMesh
from heartfit.heart.finite_elements import assembly, kinematics
from heartfit.heart.finite_elements.elements import ELEMENTS, Element
from heartfit.heart.finite_elements.kinematics import StepFailed as StepFailed
from heartfit.heart.finite_elements.solver import Elimination, Factor
from heartfit.heart.muscle.bcs import Drive
from heartfit.heart.muscle.control import ControlMeans
from heartfit.heart.muscle.tissue import Tissue as Tissue
from heartfit.heart.time_step import STATIC_STEP, TimeStep

SMALLEST_JACOBIAN = 0.05
"""Relative element volume below which a trial state is rejected."""

CHAMBERS = ("lv", "rv")


@dataclass(frozen=True, eq=False)
class BodyState:
    """Unknowns ``x`` (n, dofs), state of the fibres (4, m) and right Cauchy-Green tensor ``C`` (m, 6) at one time.

    ``stress`` (m,) is the mean fibre stress [Pa] during the last step; ``x_before`` and ``C_before`` are x and C at its
    start.
    """

    x: Floats
    fibres: Floats
    C: Floats
    stress: Floats
    x_before: Floats
    C_before: Floats


class FiniteElementBody:
    """Ventricles of linear tetrahedra on a stress-free reference mesh; bodies may share an ``elimination``."""

    def __init__(
        self, reference: VentricularMesh, tissue: Tissue, elimination: Elimination | None = None
    ) -> None:
        _require_fields(reference, tissue)
        self.reference, self.tissue = reference, tissue
        self._elimination = elimination
        self.element: Element = ELEMENTS[tissue.element]
        self.tets = reference.tets
        self.gradients, self.element_volumes = kinematics.shape_gradients(reference.points, self.tets)
        self.dyads = mean_dyads(reference)
        self.stiffness = tissue.support.stiffness(reference)
        self.damping = tissue.support.damping(reference)
        self.passive_scale = tissue.support.passive_scale(reference)
        activation, self.kept = np.asarray(reference.activation), np.ones(len(self.tets))
        if not tissue.uniform:
            activation = activation + tissue.delays()[reference.segments]
            self.kept = 1.0 - tissue.losses()[reference.segments]
            self.passive_scale = self.passive_scale * tissue.stiffenings()[reference.segments]
        self.control_means = ControlMeans(tissue.control, activation)
        self.cavities = [Cavity.from_endocardium(reference, f"{chamber}_endo") for chamber in CHAMBERS]

    @property
    def activation(self) -> Floats:
        """Times (m,) at which the tetrahedra are activated [s]."""
        return self.control_means.activation

    @cached_property
    def elimination(self) -> Elimination:
        """Symbolic factorisation of the tangent, valid for all bodies of the same tetrahedra."""
        return self._elimination or Elimination(self.tets, len(self.reference.points), self.element.dofs)

    @cached_property
    def element_matrices(self) -> Floats:
        """Workspace (m, 4 dofs, 4 dofs) for the element tangents, the largest array of a simulation."""
        return np.empty((len(self.tets), 4 * self.element.dofs, 4 * self.element.dofs))

    def rest(self) -> BodyState:
        """Stress-free state."""
        m = len(self.tets)
        C = np.tile([1.0, 1.0, 1.0, 0.0, 0.0, 0.0], (m, 1))
        x = np.zeros((len(self.reference.points), self.element.dofs))
        return BodyState(x, self.tissue.active.rest(m), C, np.zeros(m), x, C)

    def positions(self, x: Floats) -> Floats:
        """Nodal positions (n, 3) [m]."""
        return self.reference.points + x[:, :3]

    def volumes(self, x: Floats) -> Floats:
        """Cavity volumes (2,) of the left and right ventricle [m^3]."""
        position = self.positions(x)
        return np.array([cavity.volume(position) for cavity in self.cavities])

    def volume_gradients(self, x: Floats) -> Floats:
        """Derivatives (N, 2) of the cavity volumes by the unknowns."""
        position, result = self.positions(x), np.zeros((*x.shape, 2))
        for c, cavity in enumerate(self.cavities):
            result[:, :3, c] = cavity.gradient(position)
        return result.reshape(x.size, 2)

    def step(self, state: BodyState, step: TimeStep) -> "Step":
        """Equations of ``step`` from ``state``."""
        control = self.control_means.mean(step.start, step.length, step.period)
        return Step(self, state, step, self.tissue.active.drive(step, control, state.fibres, self.kept))

    def static_step(self, state: BodyState) -> "Step":
        """Equations of static equilibrium near ``state``: relaxed fibres, no viscosity."""
        zeros = np.zeros(len(self.tets))
        return Step(self, state, STATIC_STEP, Drive(zeros, zeros, zeros, np.inf))

    def wall_volume(self, x: Floats) -> float:
        """Volume of the deformed wall [m^3]."""
        return float(self.reference.with_points(self.positions(x)).wall_volume())


def mean_dyads(mesh: VentricularMesh) -> Floats:
    r"""Six-vectors (m, 6) of :math:`f \otimes f`, or of its mean if the mesh holds ``orientation``."""
    if mesh.orientation is None:
        return kinematics.fibre_dyads(np.asarray(mesh.fibres))
    return mesh.orientation


def _require_fields(mesh: VentricularMesh, tissue: Tissue) -> None:
    needed = ("fibres", "activation", "longitudinal", *(() if tissue.uniform else ("segments",)))
    missing = [name for name in needed if getattr(mesh, name) is None]
    if missing:
        raise InputError(
            f"body: the mesh has no {', '.join(missing)}; prepare it and assign its activation first"
        )


class Step:
    """Internal forces and tangent as functions of the unknowns at the end of one time step."""

    def __init__(self, body: FiniteElementBody, state: BodyState, time_step: TimeStep, drive: Drive) -> None:
        self.body, self.state, self.time_step, self.drive = body, state, time_step, drive
        m = len(body.tets)
        self._F, self._C, self._J = np.empty((m, 3, 3)), np.empty((m, 6)), np.empty(m)
        self._S, self._e = np.empty((m, 6)), np.empty(m)
        self._e_old = kinematics.fibre_strain(state.C, body.dyads)
        self._fibre = body.tissue.active.begin(self._e_old, state.fibres)
        self._find_fibres = body.tissue.active.respond
        self._viscosity = 0.5 * body.tissue.passive.eta / time_step.effective
        self._start = time_step.starting_value(state.x, state.x_before)

    def forces(self, x: Floats) -> Floats:
        """Internal and support forces (N,) at ``x`` (n, dofs) [N]; raises StepFailed if an element collapses."""
        body, tissue = self.body, self.body.tissue
        self._deform(x)
        tissue.passive.stress(self._C, self._J, body.passive_scale, body.dyads, self._S)
        self._find_fibres(self.drive, self._e_old, self._e, self.state.fibres, self._fibre)
        tension = self.time_step.end_value(self._fibre[0], self.state.stress)
        p, _ = body.element.pressure(x, body.tets, self._J, tissue.passive.K)
        assembly.add_stresses(
            self._C,
            self._J,
            p,
            self.state.C,
            self.state.C_before,
            self.time_step.ahead,
            self._viscosity,
            tension,
            body.dyads,
            self._S,
        )
        return self._assemble_forces(x)

    @property
    def deformation(self) -> tuple[Floats, Floats]:
        """F (m, 3, 3) and second Piola-Kirchhoff stress S (m, 6) [Pa] at the last evaluation of the forces."""
        return self._F, self._S

    @property
    def wall(self) -> "Step":
        """The step without the loads around the wall: itself."""
        return self

    def start_near(self, other: "Step") -> None:
        """Find the responses of the fibres by one correction, from those of another wall that differs a little.

        The guess is the same relation between the increments of strain and contractile strain.
        """
        self._fibre[2:] = other._fibre[2:]
        self._fibre[4] += self._e_old - other._e_old
        self._find_fibres = self.body.tissue.active.correct

    def follow(self, x: Floats) -> None:
        """Move to ``x`` near the last evaluation of the forces: the response of the fibres is extrapolated linearly."""
        self._deform(x)
        stress, stress_slope, increment, increment_slope, strain = self._fibre
        change = self._e - strain
        stress += stress_slope * change
        increment += increment_slope * change
        strain += change

    def _deform(self, x: Floats) -> None:
        body = self.body
        smallest = kinematics.deform(
            x, body.tets, body.gradients, body.dyads, self._F, self._C, self._J, self._e
        )
        if not smallest > SMALLEST_JACOBIAN:
            raise StepFailed(f"an element collapsed to {smallest:.3g} of its reference volume")

    def _assemble_forces(self, x: Floats) -> Floats:
        body, out = self.body, np.zeros_like(x)
        assembly.add_nodal_forces(self._F, self._S, body.gradients, body.element_volumes, body.tets, out)
        K, G = body.tissue.passive.K, body.tissue.passive.shear_modulus
        body.element.add_forces(x, body.tets, self._J, body.element_volumes, K, G, out)
        rate = 1.0 / self.time_step.effective
        assembly.add_support_forces(body.stiffness, body.damping, rate, x, self._start, out)
        return out.ravel()

    def tangent(self, x: Floats) -> Factor:
        """Factorised derivative of the forces at ``x``, at which they were last evaluated."""
        return self.body.elimination.factorise(*self.stiffness(x))

    def stiffness(self, x: Floats) -> tuple[Floats, Floats]:
        """Derivative of the forces at ``x``, at which they were last evaluated, as element matrices and nodal blocks.

        The matrices (m, 4 dofs, 4 dofs) are overwritten by the next call; the blocks are (n, dofs, dofs).
        """
        body = self.body
        dofs, m, elements = body.element.dofs, len(body.tets), body.element_matrices
        D = self._material_tangent(x)
        assembly.element_stiffness(self._F, self._S, D, body.gradients, body.element_volumes, dofs, elements)
        slopes = np.empty((m, 4, 3))
        assembly.volume_slopes(self._F, body.gradients, slopes)
        K, G = body.tissue.passive.K, body.tissue.passive.shear_modulus
        body.element.fill_stiffness(slopes, body.element_volumes, K, G, elements)
        nodes = np.zeros((len(x), dofs, dofs))
        nodes[:, :3, :3] = body.stiffness + body.damping / self.time_step.effective
        return elements, nodes

    def _material_tangent(self, x: Floats) -> Floats:
        body, tissue = self.body, self.body.tissue
        D = np.empty((len(body.tets), 6, 6))
        tissue.passive.tangent(self._C, self._J, body.passive_scale, body.dyads, D)
        p, slope = body.element.pressure(x, body.tets, self._J, tissue.passive.K)
        stiffness = (1.0 + self.time_step.memory) * self._fibre[1]
        assembly.add_tangents(self._C, self._J, p, slope, self._viscosity, stiffness, body.dyads, D)
        return D

    def commit(self, x: Floats) -> BodyState:
        """State at the end of the step, at the unknowns ``x`` at which the forces were last evaluated."""
        fibres = self.body.tissue.active.advance(self.drive, self.state.fibres, self._fibre[2])
        return BodyState(x.copy(), fibres, self._C.copy(), self._fibre[0].copy(), self.state.x, self.state.C)

    def size(self, residual: Floats) -> float:
        """Norm of a residual [N], infinite where it overflows.

        Wall-volume equations are weighted by shear modulus over length.
        """
        rows = residual.reshape(-1, self.body.element.dofs)
        weight = self.body.tissue.passive.shear_modulus / 5e-3
        with np.errstate(over="ignore"):
            return float(np.linalg.norm(rows[:, :3]) + weight * np.linalg.norm(rows[:, 3:]))

    def weights(self, x: Floats) -> Floats:
        """Weights (n, dofs) under which displacements of 1 mm and wall pressures of 10 kPa count alike."""
        weights = np.full_like(x, 1e-4)
        weights[:, :3] = 1e3
        return weights
