"""What the bytes of an image file say before and after SimpleITK has read it, which believes them."""

import gzip
import re
import struct
import zlib
from io import BufferedReader
from pathlib import Path

import numpy as np
import SimpleITK as sitk

from heartfit.errors import InputError

BLOCK = 1 << 20
LONGEST_HEADER = 1 << 16
ELSEWHERE = re.compile(rb"^(?:ElementDataFile\s*=|data ?file:)\s*(.*?)\s*$", re.IGNORECASE | re.MULTILINE)
HERE = b"LOCAL"
DAMAGED = (EOFError, zlib.error, gzip.BadGzipFile)
NIFTI_1, SPACING = 348, 80
"""Length of its header and where in it the sizes of voxels stand, three floats."""


def require_own_voxels(path: Path) -> None:
    """Raises InputError for a header that takes its voxels from anything but one file beside it.

    SimpleITK would follow it to any file, and wait for a pipe or a device without end.
    """
    name = elsewhere(header_of(path)) if path.suffix not in (".nii", ".gz") else ""
    if name and (Path(name).name != name or not path.with_name(name).is_file()):
        raise InputError(
            f"{path}: takes its voxels of {name}; expected a file beside it: write both into one, as .nrrd or .nii.gz"
        )


def header_of(path: Path) -> bytes:
    """What a file begins with, which holds its header."""
    with path.open("rb") as file:
        return file.read(LONGEST_HEADER)


def elsewhere(header: bytes) -> str:
    """The name of the file that a header says its voxels are in, nothing where they follow it."""
    found = ELSEWHERE.search(header)
    return "" if found is None or found[1].upper() == HERE else found[1].decode("utf-8", "replace")


def require_whole(path: Path, image: sitk.Image) -> None:
    """Raises InputError for a NIfTI whose voxels have no size or are not all there.

    SimpleITK makes up both; so the bytes are counted, no more of them than there should be.
    """
    _require_spacing(path)
    axes = range(1, image.GetDimension() + 1)
    voxels = np.prod([int(image.GetMetaData(f"dim[{axis}]")) for axis in axes])
    begin = int(float(image.GetMetaData("vox_offset")))
    expected = begin + int(voxels) * int(image.GetMetaData("bitpix")) // 8
    try:
        found = _length(path, expected + BLOCK)
    except DAMAGED:
        raise damage(path) from None
    behind = found - expected
    if not 0 <= behind < BLOCK:
        fault = "it is cut off" if behind < 0 else "something follows the voxels"
        raise InputError(
            f"{path}: {found} bytes or more, expected {expected}; {fault}: export or copy it again"
        )


def damage(path: Path) -> InputError:
    """What is raised for a stream that does not unpack to its check sum."""
    return InputError(f"{path}: the compressed data are cut off or damaged; export or copy it again")


def _require_spacing(path: Path) -> None:
    with _unpacked(path) as content:
        header = content.read(NIFTI_1)
    for order in "<>":
        if struct.unpack_from(f"{order}i", header) == (NIFTI_1,):
            spacing = struct.unpack_from(f"{order}3f", header, SPACING)
            if not all(0.0 < each < np.inf for each in spacing):
                raise InputError(
                    f"{path}: voxels of {spacing} mm; expected positive numbers: correct the header"
                )


def _unpacked(path: Path) -> gzip.GzipFile | BufferedReader:
    return gzip.open(path) if path.suffix == ".gz" else path.open("rb")


def _length(path: Path, most: int) -> int:
    """The number of bytes, counted up to `most`."""
    if path.suffix != ".gz":
        return path.stat().st_size
    count = 0
    with _unpacked(path) as content:
        while count < most and (block := content.read(BLOCK)):
            count += len(block)
    return count
