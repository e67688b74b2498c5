"""Malformed measured hearts, images, segmentations, folders of surfaces and meshes."""

import gzip
import json
import re
import shutil
import struct
from collections.abc import Callable
from pathlib import Path
from typing import Any

import meshio
import numpy as np
import SimpleITK as sitk
from scipy.io import loadmat, savemat
from scipy.sparse import csc_array, eye

from heartfit.geometry.surface import SURFACES
from tests.malformed.case import Content, Malformed, edited, pipe
from tests.malformed.pictures import dicom
from tests.malformed.sound import HEADER, PHASES, control_points, phase, wall

CHECK = "check|--no-picture|--config|sound.yaml"
PHASE = "heart/control_points/frame_003.txt"
TRIANGLES, LABELS = "heart/template/ETIndicesSorted.txt", "heart/template/ETIndicesMaterials.txt"
MATRIX, TIMING = "heart/template/subdivision_matrix_sparse.mat", "heart/cine/timing.json"
POINTS = len(control_points())
LAUGHS = "".join(f'<!ENTITY l{n} "{f"&l{n - 1};" * 10}">' for n in range(1, 12))
GRID = (
    '<?xml version="1.0"?>\n{}<VTKFile type="UnstructuredGrid" version="0.1">'
    "<UnstructuredGrid>{}</UnstructuredGrid></VTKFile>"
)
MANY_POINTS = (
    '<Piece NumberOfPoints="1000000000000" NumberOfCells="0"><Points><DataArray type="Float64" '
    'NumberOfComponents="3" format="ascii">0 0 0</DataArray></Points><Cells></Cells></Piece>'
)


def remove(path: Path) -> None:
    shutil.rmtree(path) if path.is_dir() else path.unlink()


def heart(name: str, file: str, content: Content, message: str) -> Malformed:
    return Malformed(f"measured heart: {name}", CHECK, message, {file: content})


def stored(**content: Any) -> Content:
    """A .mat of other content."""
    return lambda path: savemat(path, content)


def pointing_out_of_range(path: Path) -> None:
    """Indices beyond the matrix, which a product would read from foreign memory."""
    matrix = csc_array(loadmat(path)["S"])
    matrix.indices[0] = 2_000_000_000
    savemat(path, {"S": matrix})


def in_metres(path: Path) -> None:
    for file in path.iterdir():
        file.write_text(phase(1e-3 * control_points()))


def timing(**acquisition: Any) -> str:
    return json.dumps({"1": {"description": "cine_trufi_retro"} | acquisition})


def images(name: str, file: str, content: Content, message: str) -> Malformed:
    """A source whose images are `file`."""
    own = f"sources: {{mine: {{fit: heart, images: {file}}}}}\n"
    return Malformed(f"images: {name}", f"{CHECK}|bad.yaml", message, {"bad.yaml": own, file: content})


def header(start: int, pattern: str, *values: float) -> Content:
    """The sound NIfTI with numbers of its header replaced."""

    def write(path: Path) -> None:
        content = bytearray((path.parent / "cine.nii").read_bytes())
        struct.pack_into(pattern, content, start, *values)
        path.write_bytes(content)

    return write


def bomb(path: Path) -> None:
    """NIfTI followed by two gigabytes of zeros, packed into two megabytes."""
    head = gzip.compress((path.parent / "cine.nii").read_bytes())
    path.write_bytes(head + 128 * gzip.compress(bytes(1 << 24)))


def voxels(change: Callable[[np.ndarray], np.ndarray]) -> Content:
    """The sound images with other voxels (t,z,y,x)."""

    def write(path: Path) -> None:
        image = sitk.ReadImage(str(path.parent / "cine.nrrd"))
        other = sitk.GetImageFromArray(change(sitk.GetArrayFromImage(image)), isVector=False)
        other.CopyInformation(image)
        sitk.WriteImage(other, str(path))

    return write


def put(place: object, value: float) -> Callable[[np.ndarray], np.ndarray]:
    def change(array: np.ndarray) -> np.ndarray:
        array[place] = value
        return array

    return change


def frames(path: Path) -> None:
    """A folder with a 3-D file for each frame, and one frame twice."""
    image = sitk.ReadImage(str(path.parent / "cine.nrrd"))
    path.mkdir()
    for number in range(image.GetSize()[3]):
        sitk.WriteImage(image[:, :, :, number], str(path / f"f{number}.mha"))
    shutil.copyfile(path / "f4.mha", path / "f04.mha")


def two_patients(path: Path) -> None:
    dicom(path, lambda place, frame: {"0020|000d": "9.9"} if (place, frame) == (1, 3) else {})


def segmented(name: str, content: Content, message: str, file: str = "seg.nii.gz") -> Malformed:
    own = f"{{segmentation: {file}, labels: {{lv_cavity: 1, lv_wall: 2, rv_cavity: 3}}, images: cine.nrrd}}"
    files = {"bad.yaml": f"sources: {{mine: {own}}}\n", file: content}
    return Malformed(f"segmentation: {name}", f"{CHECK}|bad.yaml", message, files)


def halves_of_labels(path: Path) -> None:
    """The sound image's tissues as numbers, one voxel between two of them."""
    image = sitk.ReadImage(str(path.parent / "cine.nrrd"))[:, :, :, 0]
    codes = np.digitize(sitk.GetArrayFromImage(image), [30, 100]).astype(np.float32)
    codes[0, 0, 0] = 1.5
    other = sitk.GetImageFromArray(codes)
    other.CopyInformation(image)
    sitk.WriteImage(other, str(path))


def surfaces(name: str, message: str, spoil: Callable[[Path], object]) -> Malformed:
    """A folder of closed surfaces as .ply with their notes, spoilt."""

    def write(path: Path) -> None:
        for number in range(PHASES):
            write_ply(path.parent / f"wall_{number}.ply", 1e3 * wall().points)
        labels = {name: number for number, name in enumerate(SURFACES)}
        path.write_text(json.dumps({"unit": "mm", "period_s": 0.8, "labels": labels}))
        spoil(path.parent)

    files = {"bad.yaml": "sources: {mine: {surfaces: s}}\n", "s/surfaces.json": write}
    return Malformed(f"surfaces: {name}", f"{CHECK}|bad.yaml", message, files)


def write_ply(path: Path, points: np.ndarray) -> None:
    shape = wall()
    head = (
        f"ply\nformat ascii 1.0\nelement vertex {len(points)}\nproperty float x\nproperty float y\nproperty float z\n"
        f"element face {len(shape.triangles)}\nproperty list uchar int vertex_indices\nproperty int label\nend_header\n"
    )
    nodes = "".join(f"{x:.6g} {y:.6g} {z:.6g}\n" for x, y, z in points)
    faces = "".join(
        f"3 {a} {b} {c} {SURFACES.index(label)}\n"
        for (a, b, c), label in zip(shape.triangles, shape.labels, strict=True)
    )
    path.write_text(head + nodes + faces)


def vtk_that_ends_early(path: Path) -> None:
    (path / "wall_3.ply").unlink()
    text = "# vtk DataFile Version 3.0\nx\nASCII\nDATASET POLYDATA\nPOINTS 9e9 float\n"
    (path / "wall_3.vtk").write_text(text)


def mesh(name: str, content: Content, message: str) -> Malformed:
    return Malformed(f"mesh: {name}", "simulate|bad.vtu|--config|sound.yaml", message, {"bad.vtu": content})


def changed(change: Callable[[meshio.Mesh], object]) -> Content:
    """The sound mesh with its arrays changed."""

    def write(path: Path) -> None:
        sound = meshio.vtu.read(path.with_name("sound.vtu"))
        change(sound)
        meshio.vtu.write(path, sound)

    return write


def first(field: str, value: float) -> Content:
    """Another value of a field in the first tetrahedron."""

    def change(sound: meshio.Mesh) -> None:
        arrays = [np.array(array) for array in sound.cell_data[field]]
        arrays[0][0] = value
        sound.cell_data[field] = arrays

    return changed(change)


def one_surface(sound: meshio.Mesh) -> None:
    sound.cell_data["surface"] = [np.zeros(len(labels), int) for labels in sound.cell_data["surface"]]


def triangle_twice(sound: meshio.Mesh) -> None:
    sound.cells[1].data = np.vstack([sound.cells[1].data[1], sound.cells[1].data[1:]])


HEARTS = [
    heart("no template", "heart/template", remove, "template: missing"),
    heart("a phase with semicolons", PHASE, edited(lambda text: text.replace(",", ";")), "lines x,y,z"),
    heart("a phase with words", PHASE, HEADER + "x,y,z\n" * POINTS, "expected lines x,y,z"),
    heart("a phase with a point less", PHASE, phase(control_points()[:-1]), f"expected {POINTS}"),
    heart("a phase of huge numbers", PHASE, HEADER + "1e308,1e308,0\n" * POINTS, "coordinates in m"),
    heart("a phase turned inside out", PHASE, phase(control_points() * [-1, 1, 1]), "phase 3"),
    heart("metres", "heart/control_points", in_metres, "m taken for mm"),
    heart(
        "triangles of points that are not there",
        TRIANGLES,
        edited(lambda text: text.replace("1 ", f"{POINTS + 9} ", 1)),
        "refers to point",
    ),
    heart("ragged triangles", TRIANGLES, edited(lambda text: text.replace("\n", " 1\n", 1)), "three numbers"),
    heart("a triangle less", TRIANGLES, edited(lambda text: text.split("\n", 1)[1]), "labels for"),
    heart(
        "a triangle twice",
        TRIANGLES,
        edited(lambda text: text.replace(*text.split("\n")[1::-1], 1)),
        "closed",
    ),
    heart(
        "labels without numbers", LABELS, edited(lambda text: text.replace(" ", "")), "a number and a name"
    ),
    heart("unknown labels", LABELS, edited(lambda text: re.sub("LV_|RV_|_CUT", "", text)), "no triangle"),
    heart("a matrix of another name", MATRIX, stored(T=eye(3, format="csc")), "cannot be read"),
    heart(
        "a matrix of another fit", MATRIX, stored(S=eye(POINTS, POINTS + 1, format="csc")), "columns of the"
    ),
    heart("a matrix with NaN", MATRIX, stored(S=np.nan * eye(POINTS, format="csc")), "NaN"),
    heart("a matrix that points out of range", MATRIX, pointing_out_of_range, "cannot be read"),
    heart("timing in seconds", TIMING, timing(nominal_interval_ms=0.8), "nominal_interval_ms"),
    heart("timing of NaN", TIMING, timing(nominal_interval_ms=np.nan), "not JSON"),
    heart("timing with a key twice", TIMING, '{"1": {}, "1": {}}', "occurs twice"),
    heart("timing without end", TIMING, "[" * 100_000, "nested too deeply"),
]
IMAGES = [
    images("missing", "none.nii", lambda path: None, "no such file"),
    images("an archive", "x.zip", b"PK\x03\x04" + bytes(200), "not a supported kind of image"),
    images("a NIfTI that unfolds to gigabytes", "x.nii.gz", bomb, "follows the voxels"),
    images("a NIfTI of a petabyte", "x.nii", header(42, "<hhhh", 32767, 32767, 32767, 8), "x.nii"),
    images("voxels of NaN mm", "x.nii", header(80, "<fff", np.nan, np.nan, np.nan), "voxels of .* mm"),
    images("voxels of NaN", "x.nrrd", voxels(put((3, 2, 2, 2), np.nan)), "not finite"),
    images("an empty frame", "x.nrrd", voxels(put(5, 7.0)), "frame 5 is 7 everywhere"),
    images("left and right exchanged", "x.nrrd", voxels(lambda array: array[:, ::-1, :, ::-1]), "Dice"),
    images("dark blood", "x.nrrd", voxels(lambda array: 210.0 - array), "Dice"),
    images(
        "voxels in a device",
        "x.mhd",
        "ObjectType = Image\nNDims = 4\nDimSize = 3 3 3 8\nElementSpacing = 1 1 1 1\nElementType = MET_FLOAT\n"
        "ElementDataFile = /dev/zero\n",
        "voxels from",
    ),
    images("a frame twice", "f", frames, "the number of frame"),
    images("pictures of two patients", "d", two_patients, "another study"),
]
SEGMENTATIONS = [
    segmented("a folder of nothing", Path.mkdir, "seg", file="seg"),
    segmented("halves of labels", halves_of_labels, "no whole numbers"),
]
FOLDERS_OF_SURFACES = [
    surfaces("notes of a list", "surfaces.json", lambda path: (path / "surfaces.json").write_text("[]")),
    surfaces("a phase that is a pipe", "wall_3.ply", lambda path: pipe(path / "wall_3.ply")),
    surfaces(
        "a phase with a node less",
        "nodes, expected|not there|wall_3",
        lambda path: write_ply(path / "wall_3.ply", 1e3 * wall().points[:-1]),
    ),
    surfaces("a surface in text that ends early", "wall_3", vtk_that_ends_early),
]
MESHES = [
    mesh("text", "nothing of the kind", "cannot be read"),
    mesh(
        "a billion laughs",
        GRID.format(f'<!DOCTYPE v [<!ENTITY l0 "ha">{LAUGHS}]>', "&l11;"),
        "cannot be read",
    ),
    mesh("fewer points than it says", GRID.format("", MANY_POINTS), "cannot be read"),
    mesh("millimetres", changed(lambda sound: sound.points.__imul__(1e3)), "mm taken for m"),
    mesh("no fibres", changed(lambda sound: sound.cell_data.pop("fibres")), "fibres"),
    mesh("fibres of no length", first("fibres", 0.0), "fibres"),
    mesh("an orientation of NaN", first("orientation", np.nan), "orientation"),
    mesh("activation in milliseconds", first("activation", 80.0), "activation"),
    mesh("a segment eighteen", first("segments", 18), "segments"),
    mesh("all of one surface", changed(one_surface), "has no triangle"),
    mesh("a triangle twice", changed(triangle_twice), "boundary"),
]
MALFORMED = [*HEARTS, *IMAGES, *SEGMENTATIONS, *FOLDERS_OF_SURFACES, *MESHES]
