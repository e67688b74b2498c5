"""Malformed folders of a measured heart."""

import json
import shutil
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
from scipy.io import loadmat, savemat
from scipy.sparse import csc_array, eye

from tests.malformed.case import Content, Malformed, folder
from tests.malformed.sound import HEADER, control_points, phase

CHECK = "check|--no-picture|--config|sound.yaml"
PHASE = "heart/control_points/frame_003.txt"
TRIANGLES, LABELS = "heart/template/ETIndicesSorted.txt", "heart/template/ETIndicesMaterials.txt"
MATRIX, TIMING = "heart/template/subdivision_matrix_sparse.mat", "heart/cine/timing.json"


def heart(name: str, file: str, content: Content, message: str) -> Malformed:
    return Malformed(f"measured heart: {name}", CHECK, message, {file: content})


def edited(change: Callable[[str], str]) -> Content:
    """The file with its text changed."""

    def edit(path: Path) -> None:
        path.write_text(change(path.read_text()))

    return edit


def remove(path: Path) -> None:
    shutil.rmtree(path) if path.is_dir() else path.unlink()


def stored(**content: Any) -> Content:
    """A .mat of other content."""
    return lambda path: savemat(path, content)


def cut(path: Path) -> None:
    path.write_bytes(path.read_bytes()[: path.stat().st_size // 2])


def pointing_out_of_range(path: Path) -> None:
    """Indices beyond the matrix, which a product would read from foreign memory."""
    matrix = csc_array(loadmat(path)["S"])
    matrix.indices[0] = 2_000_000_000
    savemat(path, {"S": matrix})


def every_phase(scale: float) -> Content:
    text = phase(scale * control_points())

    def write(path: Path) -> None:
        for file in path.iterdir():
            file.write_text(text)

    return write


def timing(**acquisition: Any) -> str:
    return json.dumps({"1": {"description": "cine_trufi_retro"} | acquisition})


POINTS = len(control_points())

MALFORMED = [
    heart("no control points", "heart/control_points", remove, "control_points: missing"),
    heart("no template", "heart/template", remove, "template: missing"),
    heart("no triangles", TRIANGLES, remove, "no such file"),
    heart("triangles in a folder", TRIANGLES, folder, "is a folder"),
    heart("no matrix", MATRIX, remove, "no such file"),
    heart("no timing", TIMING, remove, "no such file"),
    heart("seven phases", "heart/control_points/frame_003.txt", remove, "at least 8"),
    heart("a phase that is a folder", PHASE, folder, "is a folder"),
    heart("a phase that is empty", PHASE, "", "0 control points"),
    heart("a phase of bytes", PHASE, bytes(range(256)), "not UTF-8"),
    heart("a phase with a point less", PHASE, phase(control_points()[:-1]), f"expected {POINTS}"),
    heart("a phase with two coordinates", PHASE, HEADER + "1,2\n" * POINTS, "expected lines x,y,z"),
    heart(
        "a phase with semicolons", PHASE, edited(lambda text: text.replace(",", ";")), "expected lines x,y,z"
    ),
    heart(
        "a phase with decimal commas",
        PHASE,
        edited(lambda text: text.replace(".", ",")),
        "frame_003|expected",
    ),
    heart("a phase with a word", PHASE, HEADER + "x,y,z\n" * POINTS, "expected lines x,y,z"),
    heart("a phase with NaN", PHASE, HEADER + "nan,0,0\n" * POINTS, "NaN"),
    heart("a phase of huge numbers", PHASE, HEADER + "1e308,1e308,0\n" * POINTS, "coordinates in m"),
    heart("a phase that is flat", PHASE, HEADER + "0,0,0\n" * POINTS, "phase 3"),
    heart("a phase turned inside out", PHASE, phase(control_points() * [-1, 1, 1]), "phase 3"),
    heart("metres", "heart/control_points", every_phase(1e-3), "m taken for mm"),
    heart("micrometres", "heart/control_points", every_phase(1e3), "mm taken for m"),
    heart("a heart of a mouse", "heart/control_points", every_phase(0.1), "a wall of"),
    heart(
        "triangles of points that are not there",
        TRIANGLES,
        edited(lambda text: text.replace("1 ", f"{POINTS + 9} ", 1)),
        "refers to point",
    ),
    heart(
        "triangles counted from nought",
        TRIANGLES,
        edited(lambda text: text.replace("\n", "\n", 1).replace("1 ", "0 ", 1)),
        "refers to point|not closed|below",
    ),
    heart(
        "triangles of fractions", TRIANGLES, edited(lambda text: text.replace(" ", ".5 ", 1)), "three numbers"
    ),
    heart(
        "triangles with four corners",
        TRIANGLES,
        edited(lambda text: text.replace("\n", " 1\n")),
        "three numbers",
    ),
    heart(
        "triangles that are ragged",
        TRIANGLES,
        edited(lambda text: text.replace("\n", " 1\n", 1)),
        "three numbers",
    ),
    heart("a triangle less", TRIANGLES, edited(lambda text: text.split("\n", 1)[1]), "labels for"),
    heart(
        "a triangle twice",
        TRIANGLES,
        edited(lambda text: text.replace(*text.split("\n")[1::-1], 1)),
        "not closed|manifold",
    ),
    heart(
        "names that nobody knows",
        LABELS,
        edited(lambda text: text.replace("LV_", "XX_").replace("RV_", "XX_").replace("_CUT", "")),
        "no triangle is named",
    ),
    heart(
        "an endocardium of another name",
        LABELS,
        edited(lambda text: text.replace("LV_ENDOCARDIAL", "LEFT_ATRIUM", 1)),
        "not closed",
    ),
    heart("no base", LABELS, edited(lambda text: text.replace("_VALVE_CUT", "_DISC")), "not closed"),
    heart(
        "labels without numbers", LABELS, edited(lambda text: text.replace(" ", "")), "a number and a name"
    ),
    heart(
        "one name for all",
        LABELS,
        edited(lambda text: "".join(f"{line.split()[0]} LV_EPICARDIAL\n" for line in text.splitlines())),
        "no opening|endo",
    ),
    heart("a matrix cut off", MATRIX, cut, "cannot be read"),
    heart("a matrix of text", MATRIX, "S = [1 0; 0 1]\n", "cannot be read"),
    heart("a matrix that is empty", MATRIX, "", "cannot be read"),
    heart(
        "a matrix of HDF",
        MATRIX,
        b"MATLAB 7.3 MAT-file" + b" " * 105 + b"\0\2IM" + b"\x89HDF\r\n\x1a\n" + bytes(99),
        "cannot be read",
    ),
    heart("a matrix of another name", MATRIX, stored(T=eye(3, format="csc")), "cannot be read"),
    heart("a matrix of words", MATRIX, stored(S="rm -rf"), "cannot be read|columns"),
    heart("a matrix in a table", MATRIX, stored(S={"a": 1}), "cannot be read|columns"),
    heart(
        "a matrix of another fit",
        MATRIX,
        stored(S=eye(POINTS, POINTS + 1, format="csc")),
        "columns of the subdivision matrix",
    ),
    heart("a matrix with NaN", MATRIX, stored(S=np.nan * eye(POINTS, format="csc")), "NaN"),
    heart("a matrix with too few points", MATRIX, stored(S=eye(9, POINTS, format="csc")), "refers to point"),
    heart("a matrix that points out of range", MATRIX, pointing_out_of_range, "cannot be read"),
    heart("timing cut off", TIMING, '{"1": {"nominal_int', "not JSON"),
    heart("timing of a list", TIMING, "[800]", "no acquisition"),
    heart("timing of no acquisition", TIMING, "{}", "no acquisition"),
    heart("timing without a length", TIMING, timing(), "nominal_interval_ms"),
    heart("timing in seconds", TIMING, timing(nominal_interval_ms=0.8), "nominal_interval_ms"),
    heart("timing of a word", TIMING, timing(nominal_interval_ms="800"), "nominal_interval_ms"),
    heart("timing of a truth", TIMING, timing(nominal_interval_ms=True), "nominal_interval_ms"),
    heart(
        "timing of NaN",
        TIMING,
        '{"1": {"description": "cine_trufi_retro", "nominal_interval_ms": NaN}}',
        "not JSON",
    ),
    heart(
        "timing beyond all",
        TIMING,
        '{"1": {"description": "cine_trufi_retro", "nominal_interval_ms": 1e999}}',
        "not JSON",
    ),
    heart("timing with a key twice", TIMING, '{"1": {}, "1": {}}', "occurs twice"),
    heart("timing without end", TIMING, "[" * 100_000, "nested too deeply"),
    heart("timing of another length", TIMING, timing(nominal_interval_ms=900), "expected the same to 2 %"),
]
