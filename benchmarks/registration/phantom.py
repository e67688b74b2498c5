"""Hearts whose motion is known, kept on disk: the mesher cannot be seeded, and a beat takes longer than its images."""

from dataclasses import dataclass, replace

from benchmarks.ventricles import FOLDER, ROOT, SHAPE
from heartfit.geometry.mesh import Motion, VentricularMesh
from heartfit.geometry.parametric import ParametricVentricles
from heartfit.io.configuration import read_study
from heartfit.io.meshes import read_mesh, read_motion, write_mesh, write_motion
from heartfit.synthetic.volunteer import Anatomy, Template, draw_heart, generate

EDGE, TOLERANCE = 9e-3, 0.3e-3
"""Edge length of the mesh [m]: 5k to 6k tetrahedra."""

HEARTS = (
    Anatomy(SHAPE, 0.86),
    Anatomy(ParametricVentricles(145e-6, 8e-3, 1.9, 150e-6, 3.5e-3), 0.92),
    Anatomy(ParametricVentricles(120e-6, 9.5e-3, 1.75, 125e-6, 4e-3), 0.80),
)
"""The study's two volunteers, and a smaller, thicker and rounder heart with a faster beat."""


@dataclass(frozen=True, eq=False)
class Known:
    """A mesh at end diastole and its motion at every step of the beat, phase 0 at the trigger."""

    mesh: VentricularMesh
    motion: Motion


def known_heart(number: int) -> Known:
    """One of the hearts, made now if it is not on disk yet; its number scatters its parameters."""
    mesh, motion = (FOLDER / "registration" / f"heart{number}.{kind}" for kind in ("vtu", "npz"))
    if not motion.exists():
        phantom = _made(HEARTS[number], seed=number + 1)
        write_mesh(mesh, phantom.mesh)
        write_motion(motion, phantom.motion)
    return Known(read_mesh(mesh), read_motion(motion))


def _made(anatomy: Anatomy, seed: int) -> Known:
    """By the study's generator, on a coarser mesh and at the step of its calibrator."""
    study = read_study([ROOT / "config" / "config.yaml"])
    protocol = replace(
        study.cohort.protocol(study.end_diastolic_pressure),
        numerics=study.numerics.numerics(),
    )
    bare = Template.build(EDGE, TOLERANCE).deformed_to(anatomy.shape)
    volunteer = generate(bare, draw_heart(study.cohort.heart, anatomy.period, seed), protocol)
    return Known(volunteer.mesh, volunteer.motion)
