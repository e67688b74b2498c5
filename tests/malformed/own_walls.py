"""Malformed segmentations and folders of surfaces, and malformed names for `init`."""

import json
from collections.abc import Callable
from pathlib import Path

import numpy as np
import SimpleITK as sitk

from heartfit.geometry.surface import SURFACES
from tests.malformed.case import Content, Malformed, folder, hole, pipe
from tests.malformed.sound import PHASES, wall

CHECK = "check|--no-picture|--config|sound.yaml|bad.yaml"
LABELS = "{lv_cavity: 1, lv_wall: 2, rv_cavity: 3}"
NOTES = {"unit": "mm", "period_s": 0.8, "labels": {name: number for number, name in enumerate(SURFACES)}}
FILE = "s/surfaces.json"


def segmented(
    name: str, content: Content, message: str, labels: str = LABELS, file: str = "seg.nii.gz"
) -> Malformed:
    source = f"sources: {{mine: {{segmentation: {file}, labels: {labels}, images: cine.nrrd}}}}\n"
    return Malformed(f"segmentation: {name}", CHECK, message, {"bad.yaml": source, file: content})


def drawn(change: Callable[[np.ndarray], object] = lambda codes: None) -> Content:
    """The sound image's tissues as numbers, changed."""

    def write(path: Path) -> None:
        image = sitk.ReadImage(str(path.parent / "cine.nrrd"))[:, :, :, 0]
        codes = np.digitize(sitk.GetArrayFromImage(image), [30, 100]).astype(np.float32)
        change(codes)
        other = sitk.GetImageFromArray(codes)
        other.CopyInformation(image)
        sitk.WriteImage(other, str(path))

    return write


def put(value: float) -> Content:
    def change(codes: np.ndarray) -> None:
        codes[0, 0, 0] = value

    return drawn(change)


def right(codes: np.ndarray) -> None:
    """The blood towards one side is the right cavity."""
    codes[..., codes.shape[-1] // 2 :][codes[..., codes.shape[-1] // 2 :] == 2] = 3


def surfaces(
    name: str, message: str, notes: object = None, spoil: Callable[[Path], object] | None = None
) -> Malformed:
    """A folder of closed surfaces as .ply with their notes, spoilt."""

    def write(path: Path) -> None:
        for number in range(PHASES):
            write_ply(path.parent / f"wall_{number}.ply")
        path.write_text(notes if isinstance(notes, str) else json.dumps(notes or NOTES))
        if spoil:
            spoil(path.parent)

    files = {"bad.yaml": "sources: {mine: {surfaces: s}}\n", FILE: write}
    return Malformed(f"surfaces: {name}", CHECK, message, files)


def write_ply(path: Path, points: np.ndarray | None = None, count: int | None = None) -> None:
    shape = wall()
    places = 1e3 * shape.points if points is None else points
    numbers = [SURFACES.index(label) for label in shape.labels]
    head = (
        f"ply\nformat ascii 1.0\nelement vertex {len(places)}\nproperty float x\nproperty float y\nproperty float z\n"
        f"element face {count or len(shape.triangles)}\nproperty list uchar int vertex_indices\nproperty int label\n"
        "end_header\n"
    )
    nodes = "".join(f"{x:.6g} {y:.6g} {z:.6g}\n" for x, y, z in places)
    faces = (f"3 {a} {b} {c} {label}\n" for (a, b, c), label in zip(shape.triangles, numbers, strict=True))
    path.write_text(head + nodes + "".join(faces))


def without(key: str) -> dict[str, object]:
    return {name: value for name, value in NOTES.items() if name != key}


def text(name: str, content: str | bytes) -> Callable[[Path], object]:
    return lambda path: (path / name).write_bytes(content.encode() if isinstance(content, str) else content)


def cut(path: Path) -> None:
    file = path / "wall_3.ply"
    file.write_bytes(file.read_bytes()[:90_000])


MALFORMED = [
    segmented("a folder of nothing", folder, "seg", file="seg"),
    segmented("a pipe that nobody fills", pipe, "not a regular file"),
    segmented("empty", "", "cannot be read"),
    segmented("a hole of a terabyte", hole, "cannot be read"),
    segmented("an archive", b"PK\x03\x04" * 99, "not a supported kind of image", file="seg.zip"),
    segmented("a part that nobody drew", drawn(), "no voxel has 3, stated for rv_cavity"),
    segmented("halves of labels", put(1.5), "no whole numbers"),
    segmented("labels of NaN", put(np.nan), "no whole numbers", file="seg.nrrd"),
    segmented(
        "the numbers of another data set", drawn(right), "mine", "{lv_cavity: 3, lv_wall: 2, rv_cavity: 1}"
    ),
    segmented("no right cavity", drawn(right), "rv_cavity", "{lv_cavity: 1, lv_wall: 2}"),
    segmented(
        "an atrium",
        drawn(right),
        "did you mean|unknown key",
        "{lv_cavity: 1, lv_wall: 2, rv_cavity: 3, atrium: 4}",
    ),
    surfaces("no notes", "surfaces.json", spoil=lambda path: (path / "surfaces.json").unlink()),
    surfaces("notes cut off", "surfaces.json", '{"unit": "m'),
    surfaces("notes without end", "surfaces.json", "[" * 100_000),
    surfaces("notes of a list", "surfaces.json", "[]"),
    surfaces("notes with a key twice", "surfaces.json", '{"unit": "mm", "unit": "m"}'),
    surfaces("notes in Latin-1", "surfaces.json", spoil=text("surfaces.json", b'{"unit": "\xb5m"}')),
    surfaces("no unit", "unit is None", without("unit")),
    surfaces("a unit that nobody knows", "unit is 'inch'", NOTES | {"unit": "inch"}),
    surfaces("no period", "the length of the beat is not stated", without("period_s")),
    surfaces("a period in milliseconds", "a beat of 800 s", NOTES | {"period_s": 800}),
    surfaces("a period of NaN", "surfaces.json", '{"unit": "mm", "period_s": NaN}'),
    surfaces("times that are words", "expected period_s", NOTES | {"times_s": ["0"] * PHASES}),
    surfaces(
        "two labels of one number", "a number of its own", NOTES | {"labels": dict.fromkeys(SURFACES, 1)}
    ),
    surfaces(
        "labels that are not stated",
        "not stated",
        NOTES | {"labels": dict(zip(SURFACES, range(5, 9), strict=True))},
    ),
    surfaces("metres that are millimetres", "mm taken for m", NOTES | {"unit": "m"}),
    surfaces(
        "a phase that is missing",
        "3 is missing|at least 8",
        spoil=lambda path: (path / "wall_3.ply").unlink(),
    ),
    surfaces("a phase that is text", "wall_3.ply", spoil=text("wall_3.ply", "text")),
    surfaces("a phase of bytes", "wall_3.ply", spoil=text("wall_3.ply", bytes(range(256)))),
    surfaces("a phase that is empty", "wall_3.ply", spoil=text("wall_3.ply", "")),
    surfaces("a phase cut off", "wall_3.ply", spoil=cut),
    surfaces(
        "a phase of more faces than there are",
        "wall_3.ply",
        spoil=lambda path: write_ply(path / "wall_3.ply", count=10**7),
    ),
    surfaces("a phase that is a folder", "wall_3.ply", spoil=lambda path: folder(path / "wall_3.ply")),
    surfaces("a phase that is a pipe", "wall_3.ply", spoil=lambda path: pipe(path / "wall_3.ply")),
    surfaces(
        "a phase with NaN",
        "wall_3.ply",
        spoil=lambda path: write_ply(path / "wall_3.ply", np.full_like(wall().points, np.nan)),
    ),
    surfaces(
        "a phase that is flat",
        "mine",
        spoil=lambda path: write_ply(path / "wall_3.ply", 1e3 * wall().points * [1, 1, 0]),
    ),
    surfaces(
        "a phase that is mirrored",
        "mirrored",
        spoil=lambda path: write_ply(path / "wall_3.ply", -1e3 * wall().points),
    ),
    surfaces(
        "a phase with a node less",
        "nodes, expected|not there|wall_3",
        spoil=lambda path: write_ply(path / "wall_3.ply", 1e3 * wall().points[:-1]),
    ),
    surfaces(
        "a surface in text that is none",
        "wall_3",
        spoil=lambda path: [
            text("wall_3.vtk", "# vtk DataFile Version 3.0\nx\nASCII\nDATASET POLYDATA\nPOINTS 9e9 float\n")(
                path
            ),
            (path / "wall_3.ply").unlink(),
        ],
    ),
    Malformed("init: a path", "init|../mine", "expected a name"),
    Malformed("init: no name", "init|", "expected a name"),
    Malformed("init: outside of a project", "init|heart1", "config.yaml: no such file"),
    Malformed("init: a rate of a minute", "init|heart1|--rr|fast", "--rr"),
]
