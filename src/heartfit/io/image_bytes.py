"""Checks of the raw bytes of image files, which SimpleITK trusts.

SimpleITK follows a header to any file, makes up missing voxels, and leaves memory as it was where a compressed stream
breaks off. These checks run before and after it reads a file.
"""

import gzip
import re
import struct
import zlib
from io import BufferedReader
from pathlib import Path

import numpy as np
import SimpleITK as sitk

from heartfit.core.errors import InputError

BLOCK = 1 << 20
LONGEST_HEADER = 1 << 16
ELSEWHERE = re.compile(rb"^(?:ElementDataFile\s*=|data ?file:)\s*(.*?)\s*$", re.IGNORECASE | re.MULTILINE)
SAME_FILE = b"LOCAL"
DAMAGED = (EOFError, zlib.error, gzip.BadGzipFile)
NIFTI_1, SPACING = 348, 80
"""Length of the header and offset of the voxel sizes, three floats [bytes]."""


def require_own_voxels(path: Path) -> None:
    """Raise InputError for a header that takes its voxels from anything but one file in its folder.

    SimpleITK would follow it to any file, and wait endlessly for a pipe or a device.
    """
    name = elsewhere(header_of(path)) if path.suffix not in (".nii", ".gz") else ""
    if name and (Path(name).name != name or not path.with_name(name).is_file()):
        raise InputError(
            f"{path}: takes its voxels from {name}; expected a file in its folder: write both into one, as .nrrd "
            "or .nii.gz"
        )


def header_of(path: Path) -> bytes:
    """First bytes of a file, which contain its header."""
    with path.open("rb") as file:
        return file.read(LONGEST_HEADER)


def elsewhere(header: bytes) -> str:
    """Name of the file that holds the voxels by the header, empty if they follow the header."""
    name = ELSEWHERE.search(header)
    return "" if name is None or name[1].upper() == SAME_FILE else name[1].decode("utf-8", "replace")


def require_whole(path: Path, image: sitk.Image) -> None:
    """Raise InputError for a NIfTI without voxel sizes or with another number of bytes than its header states.

    SimpleITK makes up both. The bytes are counted up to little more than expected.
    """
    _require_spacing(path)
    axes = range(1, image.GetDimension() + 1)
    voxels = np.prod([int(image.GetMetaData(f"dim[{axis}]")) for axis in axes])
    begin = int(float(image.GetMetaData("vox_offset")))
    expected = begin + int(voxels) * int(image.GetMetaData("bitpix")) // 8
    try:
        length = _length(path, expected + BLOCK)
    except DAMAGED:
        raise damage(path) from None
    excess = length - expected
    if not 0 <= excess < BLOCK:
        fault = "it is cut off" if excess < 0 else "something follows the voxels"
        raise InputError(
            f"{path}: {length} bytes or more, expected {expected}; {fault}: export or copy it again"
        )


def damage(path: Path) -> InputError:
    """Error for a stream that does not decompress to its checksum."""
    return InputError(f"{path}: the compressed data are cut off or damaged; export or copy it again")


def _require_spacing(path: Path) -> None:
    with _unpacked(path) as content:
        header = content.read(NIFTI_1)
    for order in "<>":
        if struct.unpack_from(f"{order}i", header) == (NIFTI_1,):
            spacing = struct.unpack_from(f"{order}3f", header, SPACING)
            if not all(0.0 < edge < np.inf for edge in spacing):
                raise InputError(
                    f"{path}: voxels of {spacing} mm; expected positive numbers: correct the header"
                )


def _unpacked(path: Path) -> gzip.GzipFile | BufferedReader:
    return gzip.open(path) if path.suffix == ".gz" else path.open("rb")


def _length(path: Path, most: int) -> int:
    """Number of decompressed bytes, counted up to `most`."""
    if path.suffix != ".gz":
        return path.stat().st_size
    count = 0
    with _unpacked(path) as content:
        while count < most and (block := content.read(BLOCK)):
            count += len(block)
    return count


META_IMAGE = re.compile(rb"^CompressedData\s*=\s*True\s*$", re.IGNORECASE | re.MULTILINE)
LENGTH = re.compile(rb"^CompressedDataSize\s*=\s*(\d+)", re.IGNORECASE | re.MULTILINE)
NRRD = re.compile(rb"^encoding:\s*(?:gzip|gz)\s*$", re.IGNORECASE | re.MULTILINE)
VOXELS_FOLLOW = re.compile(rb"^ElementDataFile[^\n]*\n", re.IGNORECASE | re.MULTILINE)
EMPTY_LINE = re.compile(rb"\r?\n\r?\n")


def require_undamaged(path: Path, image: sitk.Image) -> None:
    """Raise InputError for a MetaImage or NRRD whose compressed voxels are damaged or do not fill `image`.

    Where the stream breaks off, SimpleITK leaves the former content of the memory, another image at every call.
    """
    header = header_of(path)
    expected = sitk.GetArrayViewFromImage(image).nbytes
    try:
        if path.suffix in (".mha", ".mhd") and META_IMAGE.search(header):
            length = _meta_image(path, header, expected + 1)
        elif path.suffix in (".nrrd", ".nhdr") and NRRD.search(header):
            length = _nrrd(path, header, expected + 1)
        else:
            return
    except DAMAGED:
        length = 0
    if length != expected:
        raise damage(path)


def _meta_image(path: Path, header: bytes, most: int) -> int:
    """Number of decompressed bytes, counted up to `most`, 0 if the stream does not end; raises one of DAMAGED."""
    length = LENGTH.search(header)
    stream = zlib.decompressobj()
    with _voxels(path, header, VOXELS_FOLLOW) as file:
        packed = file.read()  # the whole file: a damaged length may have any value
    count = len(stream.decompress(packed[: int(length[1])] if length else packed, most))
    return count if stream.eof else 0


def _nrrd(path: Path, header: bytes, most: int) -> int:
    """Number of decompressed bytes, counted up to `most`; raises one of DAMAGED."""
    with _voxels(path, header, EMPTY_LINE) as file:
        return len(gzip.GzipFile(fileobj=file).read(most))


def _voxels(path: Path, header: bytes, before: re.Pattern[bytes]) -> BufferedReader:
    """Open the file of the voxels at their beginning: behind `before`, or in a separate file."""
    name, end_of_header = elsewhere(header), before.search(header)
    file = (path.with_name(name) if name else path).open("rb")
    file.seek(end_of_header.end() if end_of_header and not name else 0)
    return file
