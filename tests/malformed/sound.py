"""Valid inputs, from which the malformed ones differ in one place."""

import json
from functools import cache
from pathlib import Path

import numpy as np
from scipy.io import savemat
from scipy.sparse import eye

from heartfit.geometry.surface import LabelledSurface
from heartfit.io.measured_heart import SURFACE_OF_LABEL
from heartfit.io.meshes import write_mesh
from verification.specimen import COARSE, SHAPE, specimen

ROOT = Path(__file__).parents[2]
CONFIGURATION = (
    (ROOT / "config" / "config.yaml")
    .read_text(encoding="utf-8")
    .replace("cases: config/cases.tsv", "cases: cases.tsv")
    .replace("measured_heart: resources/measured_heart", "measured_heart: heart")
)
CASES = (
    "case\tkind\tperiod_s\tseed\tconduction\tqrs_ms\tcatheter\tedv_ml\twall_thickness_mm\tsphericity\trv_edv_ml"
    "\trv_wall_thickness_mm\tsigma_0\tmu\tc_1\tR_p\n"
    "mine\tmeasured\t0.8\t\thealthy" + "\t" * 11 + "\n"
    "volunteer5\tvirtual\t0.88\t5\thealthy\t\t\t150\t8.2\t1.78\t158\t3.5\t1\t1\t1\t1\n"
)
HEADER = "x,y,z,frame\n"
PHASES = 8


def recording(
    columns: str = "time_s,lv_volume_ml,lv_pressure_kpa",
    period: str = "0.9",
    rows: int = 30,
    lead: float = 1 / 6,
) -> str:
    """A table of curves of one beat; lead: of the pressure before the emptying, over the period."""
    lines = [f"# period_s = {period}", columns]
    for share in np.arange(rows) / rows:
        wave = np.cos(2 * np.pi * share)
        earlier = np.cos(2 * np.pi * (share + lead))
        lines.append(f"{0.9 * share:.4f},{110 + 40 * wave:.3f},{8 - 7 * earlier:.3f}")
    return "\n".join(lines) + "\n"


@cache
def wall() -> LabelledSurface:
    """A closed wall."""
    return SHAPE.surface()


@cache
def control_points() -> np.ndarray:
    """Its points (n,3), mm; they are their own control points."""
    return 1e3 * wall().points


def phase(points: np.ndarray) -> str:
    """The file of control points of one phase."""
    return HEADER + "".join(f"{x:.5f},{y:.5f},{z:.5f},0\n" for x, y, z in points)


def write_heart(folder: Path) -> None:
    """The folder of a measured heart, which does not move."""
    points, triangles, labels = control_points(), wall().triangles, wall().labels
    for part in ("control_points", "template", "cine"):
        (folder / part).mkdir(parents=True)
    for number in range(PHASES):
        (folder / "control_points" / f"frame_{number:03}.txt").write_text(phase(points))
    labels_of_surfaces = {surface: label for label, surface in reversed(SURFACE_OF_LABEL.items())}
    np.savetxt(folder / "template" / "ETIndicesSorted.txt", triangles + 1, "%d")
    rows = [f"{index} {labels_of_surfaces[label]}\n" for index, label in enumerate(labels, start=1)]
    (folder / "template" / "ETIndicesMaterials.txt").write_text("".join(rows))
    savemat(folder / "template" / "subdivision_matrix_sparse.mat", {"S": eye(len(points), format="csc")})
    acquisition = {"nominal_interval_ms": 800.0, "description": "cine_trufi_retro"}
    (folder / "cine" / "timing.json").write_text(json.dumps({"1": acquisition}))


def write_sound(folder: Path) -> None:
    """Write all sound files, under the names in the commands of the malformed inputs."""
    (folder / "sound.yaml").write_text(CONFIGURATION)
    (folder / "cases.tsv").write_text(CASES)
    (folder / "sound.csv").write_text(recording())
    write_heart(folder / "heart")
    write_mesh(folder / "sound.vtu", specimen(COARSE))
