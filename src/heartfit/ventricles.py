"""What stands in the ventricles' slot: finite elements on the measured mesh, or two spheres of its volumes."""

import numpy as np

from heartfit.circulation.coupling import Body
from heartfit.geometry.arrays import Floats
from heartfit.geometry.cavity import Cavity
from heartfit.geometry.mesh import VentricularMesh
from heartfit.mechanics.body import CHAMBERS, FiniteElementBody, Tissue
from heartfit.mechanics.passive.law import isotropic
from heartfit.mechanics.unloading import unload


def ventricles(mesh: VentricularMesh, tissue: Tissue, loads: Floats, unloaded: bool = True) -> Body:
    """The ventricles that were measured as ``mesh`` under the end-diastolic pressures ``loads`` (2,), Pa.

    With ``unloaded`` their stress-free reference is found first; without, the measured state is taken as
    stress-free, as the paper does. The element "sphere" keeps of the mesh only its volumes.
    Raises StepFailed if there is no such reference.
    """
    if tissue.element == "sphere":
        return _spheres(mesh, tissue, loads if unloaded else np.zeros(2))
    return FiniteElementBody(unload(mesh, tissue, loads) if unloaded else mesh, tissue)


def _spheres(mesh: VentricularMesh, tissue: Tissue, loads: Floats) -> Body:
    """Spheres of the same cavities; the septum belongs to the left one."""
    from heartfit.mechanics.sphere import Sphere, SphericalBody  # finite elements need no root finder

    cavities = [Cavity.of(mesh, f"{chamber}_endo").volume(mesh.points) for chamber in CHAMBERS]
    volumes, right = mesh.element_volumes(), np.asarray(mesh.segments) == 0
    walls = volumes[~right].sum(), volumes[right].sum()
    sides = zip(cavities, walls, loads, strict=True)
    left_sphere, right_sphere = (
        Sphere.unloaded(cavity, wall, load, isotropic(tissue.passive))
        if load > 0.0
        else Sphere.of(cavity, wall)
        for cavity, wall, load in sides
    )
    return SphericalBody(left_sphere, right_sphere, tissue)
