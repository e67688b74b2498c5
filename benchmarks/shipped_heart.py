"""Make the measured heart that is shipped: python -m benchmarks.shipped_heart FOLDER

FOLDER: the heart as it was published, with its short-axis cine as one int16 NIfTI; see heartfit.io.measured_heart. The
files of the fit are shipped as they are. Of the cine the voxels are shipped that a study reads, those of the registered
region about the heart: all others are zero. The box of voxels stays that of the scanner, header and all, so that every
index, and with it every result, is the same to the bit. Writes resources/measured_heart; a few seconds.
"""

import gzip
import shutil
import struct
import sys
from pathlib import Path

import numpy as np

from benchmarks.ventricles import ROOT
from heartfit.core.errors import InputError
from heartfit.imaging.registration.slices import region_about
from heartfit.io.files import checksum, read_manifest
from heartfit.io.image_times import write_sidecar
from heartfit.io.images import read_images
from heartfit.io.measured_heart import MeasuredHeart, read_measured_heart, short_axis_images

SHIPPED = ROOT / "resources" / "measured_heart"
PUBLISHED = SHIPPED / "published.tsv"
VOLUMES = "volumes.csv"
"""Volumes of the cavities in every phase by another program, for tests."""
HEADER, DIMENSIONS = 352, 40
"""Length of the header of a NIfTI-1 file, and offset of its dimensions, eight int16 [bytes]."""


def main(arguments: list[str]) -> int:
    if len(arguments) != 1:
        sys.stderr.write(f"{__doc__}\n")
        return 2
    ship(Path(arguments[0]), SHIPPED)
    return 0


def ship(published: Path, folder: Path) -> None:
    """Copy the fit and write the frames of the cine; raises InputError for a file that is not the published one."""
    for row in read_manifest(PUBLISHED):
        if checksum(published / row["file"]) != row["sha256"]:
            raise InputError(f"{published / row['file']}: not the published file; fetch it again")
        (folder / row["file"]).parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(published / row["file"], folder / row["file"])
    shutil.copyfile(published / VOLUMES, folder / VOLUMES)
    ship_cine(published, read_measured_heart(published), folder / "cine" / "sax")


def ship_cine(published: Path, heart: MeasuredHeart, folder: Path) -> None:
    """Write every frame of the short-axis cine with zeros beyond the registered region, and the times of the frames."""
    cine = short_axis_images(published)
    if cine is None:
        raise InputError(f"{published}: no short-axis cine cine/sax*; expected it beside the fit")
    images = read_images(cine, heart.period, heart.times)
    rows, columns = region_about(images.grid, heart.surface.points)
    kept = np.zeros(images.voxels.shape, dtype="<i2")
    kept[:, :, rows, columns] = images.voxels[:, :, rows, columns]
    header = bytearray(gzip.decompress(cine.read_bytes())[:HEADER])
    struct.pack_into("<8h", header, DIMENSIONS, 3, *images.grid.size, 1, 1, 1, 1)
    folder.mkdir(parents=True, exist_ok=True)
    for number, frame in enumerate(kept):
        file = folder / f"frame_{number:02d}.nii.gz"
        file.write_bytes(gzip.compress(bytes(header) + frame.tobytes(), mtime=0))
    write_sidecar(folder.with_suffix(".json"), heart.times, heart.period)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
