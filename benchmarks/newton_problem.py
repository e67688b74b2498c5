r"""One Newton step that other programs can compute.

Mooney-Rivlin wall of bulk modulus K with fibres of constant tension, fixed nodes at the base and no load: residual of
the energy

.. math:: W = c_1 (\bar I_1 - 3) + c_2 (\bar I_2 - 3) + \tfrac\sigma2 (f \cdot C f - 1) + U(J)

with U of the element (see elements.py), tangent, factors and solution, at a deformed state with
strains of some 10 % that is not an equilibrium.
"""

from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from heartfit.geometry.mesh import VentricularMesh
from heartfit.heart.finite_elements.body import FiniteElementBody, Step, Tissue
from heartfit.heart.muscle.passive import MooneyRivlin
from heartfit.heart.muscle.tissue import Support
from verification.block import ConstantTension

TENSION = 30e3  # Pa
HOLD = 1e7
"""Stiffness of the springs [N/m], about a thousand times that of a node; more would spoil single-precision factors."""
PROBE = 1e-5
STRAIN, PRESSURE = 0.1, 2e3  # of the state; pressure in Pa


@dataclass(frozen=True)
class HeldBase(Support):
    """Support that fixes the nodes of the base."""

    def stiffness(self, mesh: VentricularMesh) -> np.ndarray:
        blocks = np.zeros((len(mesh.points), 3, 3))
        blocks[base_nodes(mesh)] = HOLD * np.eye(3)
        return blocks

    def damping(self, mesh: VentricularMesh) -> np.ndarray:
        return np.zeros((len(mesh.points), 3, 3))

    def passive_scale(self, mesh: VentricularMesh) -> np.ndarray:
        return np.ones(len(mesh.tets))


def base_nodes(mesh: VentricularMesh) -> np.ndarray:
    return np.unique(mesh.surfaces["base"])


def state(mesh: VentricularMesh, dofs: int) -> np.ndarray:
    """Smooth displacements that vanish on the base z = 0, and wall pressures (n, dofs)."""
    X = (mesh.points - mesh.points.mean(axis=0)) / np.ptp(mesh.points, axis=0).max()
    x = np.zeros((len(X), dofs))
    x[:, :3] = STRAIN * mesh.points[:, 2:] * np.sin(np.pi * X[:, [1, 2, 0]] + 1.0)
    x[base_nodes(mesh), :3] = 0.0
    x[:, 3:] = PRESSURE * np.cos(np.pi * X[:, :1])
    return x


def step_of(mesh: VentricularMesh, element: str) -> tuple[Step, np.ndarray]:
    """Wall with one fibre in each tetrahedron, and the state of the Newton step."""
    active = ConstantTension(tension_of_fibres=TENSION)
    mesh = replace(mesh, orientation=None)
    body = FiniteElementBody(mesh, Tissue(MooneyRivlin(), active, support=HeldBase(), element=element))
    return body.static_step(body.rest()), state(mesh, body.element.dofs)


def write_problem(path: Path, mesh: VentricularMesh, element: str) -> None:
    """Input for another program and our results: residual, Newton direction, and directional derivative
    of our forces, by differences.
    """
    step, x = step_of(mesh, element)
    residual = step.forces(x)
    direction = step.tangent(x).solve(residual)
    probe = x[:, [1, 2, 0, *range(3, x.shape[1])]]
    derivative = (step.forces(x + PROBE * probe) - step.forces(x - PROBE * probe)) / (2.0 * PROBE)
    law = step.body.tissue.passive
    assert isinstance(law, MooneyRivlin)
    assert mesh.fibres is not None
    np.savez(
        path,
        points=mesh.points,
        tets=mesh.tets,
        fibres=mesh.fibres,
        held=base_nodes(mesh),
        moduli=[law.c_1, law.c_2, law.K, TENSION],
        x=x,
        residual=residual.reshape(x.shape),
        direction=direction.reshape(x.shape),
        probe=probe,
        derivative=derivative.reshape(x.shape),
    )
