"""A heart whose motion is known, kept on disk: the mesher cannot be seeded, and a beat takes longer than its images."""

from dataclasses import dataclass, replace

from benchmarks.ventricles import FOLDER, ROOT, SHAPE
from heartfit.geometry.mesh import Motion, VentricularMesh
from heartfit.io.configuration import read_study
from heartfit.io.meshes import read_mesh, read_motion, write_mesh, write_motion
from heartfit.synthetic.volunteer import Template, draw_heart, generate

EDGE, TOLERANCE = 9e-3, 0.3e-3
"""Edge length of the mesh and tolerance [m]: 5k to 6k tetrahedra."""
PERIOD, SEED = 0.86, 1
"""Period [s], and seed of the scatter of its parameters."""
MESH, MOTION = (FOLDER / "registration" / f"heart0.{kind}" for kind in ("vtu", "npz"))


@dataclass(frozen=True, eq=False)
class Known:
    """A mesh at end diastole and its motion at every step of the beat, phase 0 at the trigger."""

    mesh: VentricularMesh
    motion: Motion


def known_heart() -> Known:
    """The heart of the benchmarks' ventricles, made now if it is not on disk yet."""
    if not MOTION.exists():
        phantom = _made()
        write_mesh(MESH, phantom.mesh)
        write_motion(MOTION, phantom.motion)
    return Known(read_mesh(MESH), read_motion(MOTION))


def _made() -> Known:
    """By the study's generator, on a coarser mesh and at the step of its calibrator."""
    study = read_study([ROOT / "config" / "config.yaml"])
    protocol = replace(
        study.cohort.protocol(study.end_diastolic_pressure),
        numerics=study.numerics.numerics(),
    )
    bare = Template.build(EDGE, TOLERANCE).deformed_to(SHAPE)
    volunteer = generate(bare, draw_heart(study.cohort.heart, PERIOD, SEED), protocol)
    return Known(volunteer.mesh, volunteer.motion)
