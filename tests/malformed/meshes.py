"""Malformed meshes and arguments of a simulation."""

import re
from collections.abc import Callable
from pathlib import Path

import meshio
import numpy as np

from tests.malformed.case import Content, Malformed, folder, pipe

SIMULATE = "simulate|bad.vtu|--config|sound.yaml"
XML = '<?xml version="1.0"?>\n'
GRID = '<VTKFile type="UnstructuredGrid" version="0.1"><UnstructuredGrid>{}</UnstructuredGrid></VTKFile>'
NUMBERS = '<DataArray type="Float64" NumberOfComponents="3" format="ascii">{}</DataArray>'
PIECE = f'<Piece NumberOfPoints="{{}}" NumberOfCells="0"><Points>{NUMBERS}</Points><Cells></Cells></Piece>'
LAUGHS = "".join(f'<!ENTITY l{n} "{f"&l{n - 1};" * 10}">' for n in range(1, 12))


def mesh(name: str, content: Content, message: str) -> Malformed:
    return Malformed(f"mesh: {name}", SIMULATE, message, {"bad.vtu": content})


def changed(change: Callable[[meshio.Mesh], object]) -> Content:
    """The sound mesh with its arrays changed."""

    def write(path: Path) -> None:
        stored = meshio.vtu.read(path.with_name("sound.vtu"))
        change(stored)
        meshio.vtu.write(path, stored)

    return write


def with_cells(field: str, change: Callable[[np.ndarray], object]) -> Content:
    """A field of the tetrahedra changed in place."""

    def apply(stored: meshio.Mesh) -> None:
        arrays = [np.array(array) for array in stored.cell_data[field]]
        change(arrays[0])
        stored.cell_data[field] = arrays

    return changed(apply)


def first(value: object) -> Callable[[np.ndarray], object]:
    def put(array: np.ndarray) -> None:
        array[0] = value

    return put


def scaled(factor: float) -> Content:
    return changed(lambda stored: setattr(stored, "points", factor * stored.points))


def shifted(value: float) -> Content:
    def move(stored: meshio.Mesh) -> None:
        stored.points = np.array(stored.points)
        stored.points[7] = value

    return changed(move)


def cells(block: int, change: Callable[[np.ndarray], np.ndarray]) -> Content:
    """The tetrahedra (0) or triangles (1) changed."""

    def apply(stored: meshio.Mesh) -> None:
        stored.cells[block].data = change(np.array(stored.cells[block].data))

    return changed(apply)


def turned(nodes: np.ndarray) -> np.ndarray:
    return nodes[:, [1, 0, *range(2, nodes.shape[1])]]


def repeated(nodes: np.ndarray) -> np.ndarray:
    nodes[0] = nodes[1]
    return nodes


def far(nodes: np.ndarray) -> np.ndarray:
    nodes[0, 0] = 10**7
    return nodes


def negative(nodes: np.ndarray) -> np.ndarray:
    nodes[0, 0] = -1
    return nodes


def without(field: str) -> Content:
    return changed(lambda stored: stored.cell_data.pop(field))


def edited(pattern: str, text: str) -> Content:
    def edit(path: Path) -> None:
        path.write_text(re.sub(pattern, text, path.with_name("sound.vtu").read_text(), count=1))

    return edit


def cut(path: Path) -> None:
    path.write_bytes(path.with_name("sound.vtu").read_bytes()[:20_000])


def surfaces(change: Callable[[np.ndarray], np.ndarray]) -> Content:
    """Other numbers of the surfaces."""

    def apply(stored: meshio.Mesh) -> None:
        stored.cell_data["surface"] = [change(labels) for labels in stored.cell_data["surface"]]

    return changed(apply)


def placed(*factors: float) -> Content:
    """All points multiplied, axis by axis."""
    return changed(lambda stored: setattr(stored, "points", stored.points * factors))


def simulated(name: str, arguments: str, message: str, **files: Content) -> Malformed:
    return Malformed(f"simulation: {name}", f"simulate|{arguments}", message, files)


MALFORMED = [
    Malformed("mesh: missing", "simulate|none.vtu", "no such file"),
    Malformed("mesh: a command that has moved", "reference|none.vtu", "python -m verification reference"),
    mesh("a folder", folder, "is a folder"),
    mesh("a device", lambda path: path.symlink_to("/dev/zero"), "not a regular file"),
    mesh("a pipe that nobody fills", pipe, "not a regular file"),
    mesh("empty", "", "cannot be read"),
    mesh("text", "nothing of the kind", "cannot be read"),
    mesh("cut off", cut, "cannot be read"),
    mesh("bytes", bytes(range(256)) * 9, "cannot be read"),
    mesh("another XML", f"{XML}<svg/>", "cannot be read"),
    mesh("another grid", f'{XML}<VTKFile type="PolyData"><PolyData/></VTKFile>', "cannot be read"),
    mesh("no piece", XML + GRID.format(""), "cannot be read"),
    mesh("points alone", XML + GRID.format(PIECE.format(1, "0 0 0")), "cannot be read|tetrahedra"),
    mesh("points of words", XML + GRID.format(PIECE.format(1, "a b c")), "cannot be read"),
    mesh("fewer points than it says", XML + GRID.format(PIECE.format(10**12, "0 0 0")), "cannot be read"),
    mesh("points below none", XML + GRID.format(PIECE.format(-5, "0 0 0")), "cannot be read"),
    mesh(
        "a billion laughs",
        f'{XML}<!DOCTYPE v [<!ENTITY l0 "ha">{LAUGHS}]>' + GRID.format("&l11;"),
        "cannot be read",
    ),
    mesh(
        "a file from elsewhere",
        f'{XML}<!DOCTYPE v [<!ENTITY x SYSTEM "file:///etc/hostname">]>' + GRID.format("&x;"),
        "cannot be read",
    ),
    mesh(
        "appended bytes that are not there",
        edited('format="binary"', 'format="appended" offset="0"'),
        "cannot be read",
    ),
    mesh(
        "a compressor that nobody knows",
        edited("vtkZLibDataCompressor", "vtkOwnCompressor"),
        "cannot be read",
    ),
    mesh(
        "a number of a kind that nobody knows", edited('type="Float64"', 'type="Float65"'), "cannot be read"
    ),
    mesh("blocks without end", edited(r">\s*[A-Za-z0-9+/]{8}", ">////////"), "cannot be read"),
    mesh(
        "another format",
        lambda path: path.write_text("solid heart\nendsolid heart\n"),
        "cannot be read",
    ),
    mesh("millimetres", scaled(1e3), "mm taken for m"),
    mesh("kilometres", scaled(1e-3), "m taken for mm"),
    mesh(
        "a mirror image",
        placed(-1, 1, 1),
        "inverted",
    ),
    mesh(
        "a flat heart",
        placed(1, 1, 0),
        "inverted or flat",
    ),
    mesh("a point at NaN", shifted(np.nan), "coordinates in m"),
    mesh("a point at infinity", shifted(np.inf), "coordinates in m"),
    mesh("a point beyond all", shifted(1e300), "coordinates in m"),
    mesh("a tetrahedron of a point that is not there", cells(0, far), "refers to point"),
    mesh("a tetrahedron of point minus one", cells(0, negative), "refers to point|cannot be read"),
    mesh("a triangle of a point that is not there", cells(1, far), "refers to point"),
    mesh("a tetrahedron twice", cells(0, repeated), "boundary"),
    mesh("a triangle twice", cells(1, repeated), "boundary"),
    mesh("triangles turned inwards", cells(1, turned), "boundary"),
    mesh("no names of surfaces", without("surface"), "cell field 'surface'"),
    mesh(
        "all of one surface",
        changed(
            lambda stored: stored.cell_data.update(
                surface=[np.zeros(len(labels), int) for labels in stored.cell_data["surface"]]
            )
        ),
        "has no triangle",
    ),
    mesh(
        "surfaces that nobody knows",
        changed(
            lambda stored: stored.cell_data.update(
                surface=[labels + 40 for labels in stored.cell_data["surface"]]
            )
        ),
        "has no triangle",
    ),
    mesh("no fibres", without("fibres"), "fibres"),
    mesh("no activation", without("activation"), "activation"),
    mesh("fibres of no length", with_cells("fibres", first(0.0)), "fibres"),
    mesh("fibres of NaN", with_cells("fibres", first(np.nan)), "fibres"),
    mesh("an orientation of NaN", with_cells("orientation", first(np.nan)), "orientation"),
    mesh("activation in milliseconds", with_cells("activation", first(80.0)), "activation"),
    mesh("activation before the first", with_cells("activation", first(-0.1)), "activation"),
    mesh("activation of NaN", with_cells("activation", first(np.nan)), "activation"),
    mesh("a segment eighteen", with_cells("segments", first(18)), "segments"),
    simulated("a setting that is none", "sound.vtu|--config|sound.yaml|--setting|fysical", "known are"),
    simulated("a parameter that is none", "sound.vtu|--config|sound.yaml|--set|sigma0=1", "nearest are"),
    simulated("a parameter without a number", "sound.vtu|--config|sound.yaml|--set|sigma_0", "NAME=VALUE"),
    simulated("a parameter with a comma", "sound.vtu|--config|sound.yaml|--set|sigma_0=2,4e5", "NAME=VALUE"),
    simulated("a negative parameter", "sound.vtu|--config|sound.yaml|--set|sigma_0=-1", "sigma_0"),
    simulated("a parameter of NaN", "sound.vtu|--config|sound.yaml|--set|sigma_0=nan", "sigma_0"),
    simulated("an endless parameter", "sound.vtu|--config|sound.yaml|--set|sigma_0=inf", "sigma_0"),
    simulated("a parameter twice", "sound.vtu|--config|sound.yaml|--set|mu=1e4|mu=2e4", "twice"),
    simulated(
        "a parameter of a mechanism that is not added",
        "sound.vtu|--config|sound.yaml|--set|MitralRegurgitation.area=1e-5",
        "MitralRegurgitation",
    ),
    simulated("no period", "sound.vtu|--period|0", "--period 0"),
    simulated("a negative period", "sound.vtu|--period|-1", "--period -1"),
    simulated("a period in milliseconds", "sound.vtu|--period|829", "--period 829"),
    simulated("a period that is none", "sound.vtu|--period|nan", "--period nan"),
    simulated("a result in a folder's place", "sound.vtu|--output|heart", "--output heart"),
    simulated("a result below a file", "sound.vtu|--output|sound.yaml/beat.json", "is a file"),
    simulated("a result in the place of its curves", "sound.vtu|--output|beat.csv", "--output beat.csv"),
]
