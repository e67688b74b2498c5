"""The check sums of compressed voxels, which SimpleITK does not hold them to."""

import gzip
import re
import zlib
from io import BufferedReader
from pathlib import Path

import SimpleITK as sitk

from heartfit.io.image_bytes import DAMAGED, damage, elsewhere, header_of

META_IMAGE = re.compile(rb"^CompressedData\s*=\s*True\s*$", re.IGNORECASE | re.MULTILINE)
LENGTH = re.compile(rb"^CompressedDataSize\s*=\s*(\d+)", re.IGNORECASE | re.MULTILINE)
NRRD = re.compile(rb"^encoding:\s*(?:gzip|gz)\s*$", re.IGNORECASE | re.MULTILINE)
VOXELS_FOLLOW = re.compile(rb"^ElementDataFile[^\n]*\n", re.IGNORECASE | re.MULTILINE)
EMPTY_LINE = re.compile(rb"\r?\n\r?\n")


def require_undamaged(path: Path, image: sitk.Image) -> None:
    """Raises InputError for a MetaImage or NRRD whose compressed voxels are damaged, or are not those of `image`.

    Where the stream breaks off SimpleITK leaves whatever the memory held before, another image at every call.
    """
    header = header_of(path)
    expected = sitk.GetArrayViewFromImage(image).nbytes
    try:
        if path.suffix in (".mha", ".mhd") and META_IMAGE.search(header):
            found = _meta_image(path, header, expected + 1)
        elif path.suffix in (".nrrd", ".nhdr") and NRRD.search(header):
            found = _nrrd(path, header, expected + 1)
        else:
            return
    except DAMAGED:
        found = 0
    if found != expected:
        raise damage(path)


def _meta_image(path: Path, header: bytes, most: int) -> int:
    """The number of bytes, counted up to `most`, none if their end is not reached; raises one of DAMAGED."""
    length = LENGTH.search(header)
    stream = zlib.decompressobj()
    with _voxels(path, header, VOXELS_FOLLOW) as file:
        packed = file.read()  # all of it: a damaged length may be any
    count = len(stream.decompress(packed[: int(length[1])] if length else packed, most))
    return count if stream.eof else 0


def _nrrd(path: Path, header: bytes, most: int) -> int:
    """The number of bytes, counted up to `most`; raises one of DAMAGED."""
    with _voxels(path, header, EMPTY_LINE) as file:
        return len(gzip.GzipFile(fileobj=file).read(most))


def _voxels(path: Path, header: bytes, before: re.Pattern[bytes]) -> BufferedReader:
    """The file of the voxels where they begin: behind `before`, or in a file of their own."""
    name, found = elsewhere(header), before.search(header)
    file = (path.with_name(name) if name else path).open("rb")
    file.seek(found.end() if found and not name else 0)
    return file
