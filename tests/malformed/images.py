"""Malformed images of a measured heart."""

import gzip
import shutil
import struct
from collections.abc import Callable
from pathlib import Path

import numpy as np
import SimpleITK as sitk

from tests.malformed.case import Content, Malformed, folder, hole, pipe
from tests.malformed.pictures import dicom

CHECK = "check|--no-picture|--config|sound.yaml|imaged.yaml"
SIDECAR = '{"period_s": 0.8, "times_s": [0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7]}'


def images(name: str, file: str, content: Content, message: str, **others: Content) -> Malformed:
    """A source whose images are `file`."""
    source = f"sources: {{mine: {{fit: heart, images: {file}}}}}\n"
    files = {"imaged.yaml": source, file: content} | {
        key.replace("_", "."): value for key, value in others.items()
    }
    return Malformed(f"images: {name}", CHECK, message, files)


def header(start: int, pattern: str, *values: float) -> Content:
    """The sound NIfTI with numbers of its header replaced."""

    def write(path: Path) -> None:
        content = bytearray((path.parent / "cine.nii").read_bytes())
        struct.pack_into(pattern, content, start, *values)
        path.write_bytes(content)

    return write


def changed(change: Callable[[sitk.Image], sitk.Image | None]) -> Content:
    """Sound images with a change."""

    def write(path: Path) -> None:
        image = sitk.ReadImage(str(path.parent / "cine.nrrd"))
        sitk.WriteImage(change(image) or image, str(path))

    return write


def voxels(change: Callable[[np.ndarray], object]) -> Content:
    def apply(image: sitk.Image) -> sitk.Image:
        array = sitk.GetArrayFromImage(image)
        change(array)
        other = sitk.GetImageFromArray(array, isVector=False)
        other.CopyInformation(image)
        return other

    return changed(apply)


def put(place: object, value: float) -> Content:
    def apply(array: np.ndarray) -> None:
        array[place] = value

    return voxels(apply)


def cut(of: str, keep: float) -> Content:
    def write(path: Path) -> None:
        content = (path.parent / of).read_bytes()
        path.write_bytes(content[: int(keep * len(content))])

    return write


def damaged(of: str) -> Content:
    """Some bytes in the middle turned over."""

    def write(path: Path) -> None:
        content = bytearray((path.parent / of).read_bytes())
        middle = len(content) // 2
        content[middle : middle + 200] = bytes(255 - byte for byte in content[middle : middle + 200])
        path.write_bytes(content)

    return write


def bomb(path: Path) -> None:
    """NIfTI followed by two gigabytes of zeros, packed into two megabytes."""
    head = gzip.compress((path.parent / "cine.nii").read_bytes())
    more = gzip.compress(bytes(1 << 24))
    path.write_bytes(head + 128 * more)


def detached(data: str, kind: str = "mhd") -> str:
    """Header that names another file of voxels."""
    if kind == "nhdr":
        return (
            "NRRD0004\ntype: float\ndimension: 4\nsizes: 3 3 3 8\nencoding: raw\nendian: little\n"
            f"space dimension: 3\nspace directions: (1,0,0) (0,1,0) (0,0,1) none\ndata file: {data}\n"
        )
    return (
        "ObjectType = Image\nNDims = 4\nDimSize = 3 3 3 8\nElementSpacing = 1 1 1 1\nElementType = MET_FLOAT\n"
        f"ElementDataFile = {data}\n"
    )


def frames(spoil: Callable[[Path], object]) -> Content:
    """A folder with a 3-D file for each frame, spoilt."""

    def write(path: Path) -> None:
        image = sitk.ReadImage(str(path.parent / "cine.nrrd"))
        path.mkdir()
        for number in range(image.GetSize()[3]):
            sitk.WriteImage(image[:, :, :, number], str(path / f"f{number}.mha"))
        spoil(path)

    return write


def slices(spoil: Callable[[Path], object] | None = None, **arguments: object) -> Content:
    """A DICOM cine, spoilt."""

    def write(path: Path) -> None:
        dicom(path, **arguments)  # type: ignore[arg-type]
        if spoil:
            spoil(path)

    return write


def tag(key: str, value: str, where: tuple[int, int] | None = None) -> Content:
    """A DICOM cine with a tag of one picture, or of all, replaced."""
    return slices(change=lambda place, frame: {key: value} if where in (None, (place, frame)) else {})


def copied(source: str, target: str) -> Callable[[Path], object]:
    return lambda path: shutil.copyfile(path / source, path / target)


def remove(name: str) -> Callable[[Path], object]:
    return lambda path: (path / name).unlink()


def other_spacing(image: sitk.Image) -> None:
    image.SetSpacing([1.0, 1.0, 1.0, 0.1])


def shifted(image: sitk.Image) -> None:
    image.SetOrigin([value + 400.0 for value in image.GetOrigin()])


def in_reverse(image: sitk.Image) -> sitk.Image:
    turned = sitk.GetImageFromArray(sitk.GetArrayFromImage(image)[:, ::-1, :, ::-1], isVector=False)
    turned.CopyInformation(image)
    return turned


def dark(array: np.ndarray) -> None:
    array[:] = 210.0 - array


MALFORMED = [
    images("missing", "none.nii", folder, "no such file|folder|holds no images"),
    images("an empty folder", "empty", folder, "holds no images"),
    images("a device", "x.nii", lambda path: path.symlink_to("/dev/zero"), "no such file|not a regular file"),
    images("a pipe that nobody fills", "x.nii", pipe, "no such file|not a regular file"),
    images("empty", "x.nii.gz", "", "cannot be read"),
    images("text", "x.nii", "text" * 200, "cannot be read"),
    images("an archive", "x.zip", b"PK\x03\x04" + bytes(200), "not a supported kind of image"),
    images(
        "an archive that is called images", "x.nii.gz", gzip.compress(b"PK\x03\x04" * 200), "cannot be read"
    ),
    images("a hole of a terabyte", "x.nii", hole, "cannot be read"),
    images("a NIfTI cut off", "x.nii", cut("cine.nii", 0.7), "cut off"),
    images("a packed NIfTI cut off", "x.nii.gz", cut("cine.nii.gz", 0.7), "cut off|cannot be read"),
    images("a packed NIfTI damaged", "x.nii.gz", damaged("cine.nii.gz"), "damaged"),
    images("a packed NRRD damaged", "x.nrrd", damaged("cine.nrrd"), "damaged"),
    images("a packed MetaImage damaged", "x.mha", damaged("cine.mha"), "damaged"),
    images("an NRRD cut off", "x.nrrd", cut("cine.nrrd", 0.7), "cannot be read"),
    images("a MetaImage cut off", "x.mha", cut("cine.mha", 0.7), "cannot be read"),
    images("a NIfTI that unfolds to gigabytes", "x.nii.gz", bomb, "follows the voxels"),
    images("a NIfTI of no axes", "x.nii", header(40, "<h", 0), "x.nii"),
    images("a NIfTI of nine axes", "x.nii", header(40, "<h", 9), "x.nii"),
    images("a NIfTI without voxels", "x.nii", header(42, "<h", 0), "x.nii"),
    images("a NIfTI of a negative size", "x.nii", header(42, "<h", -5), "x.nii"),
    images("a NIfTI of a petabyte", "x.nii", header(42, "<hhhh", 32767, 32767, 32767, 8), "x.nii"),
    images("a NIfTI of numbers that nobody knows", "x.nii", header(70, "<h", 999), "x.nii"),
    images("a NIfTI whose voxels begin behind its end", "x.nii", header(108, "<f", 1e9), "x.nii"),
    images("a NIfTI that does not know where it lies", "x.nii", header(252, "<hh", 0, 0), "qform"),
    images(
        "a NIfTI with voxels of NaN mm",
        "x.nii",
        header(80, "<fff", np.nan, np.nan, np.nan),
        "voxels of .* mm",
    ),
    images("a NIfTI with voxels of 0 mm", "x.nii", header(80, "<fff", 0.0, 0.0, 0.0), "voxels of .* mm"),
    images("three axes", "x.nrrd", changed(lambda image: image[:, :, :, 0]), "3-D"),
    images(
        "colours",
        "x.nrrd",
        changed(lambda image: sitk.Compose([image[:, :, :, 0]] * 3)),
        "numbers in a voxel 3",
    ),
    images(
        "seven frames", "x.nrrd", changed(lambda image: image[:, :, :, :7]), "at least 8|7 frames|times for 7"
    ),
    images("voxels of NaN", "x.nrrd", put((3, 2, 2, 2), np.nan), "not finite"),
    images("voxels of infinity", "x.nrrd", put((3, 2, 2, 2), np.inf), "not finite"),
    images("a voxel brighter than any scanner's", "x.nrrd", put((3, 2, 2, 2), 1e30), "beyond 1e"),
    images("an empty frame", "x.nrrd", put(5, 7.0), "frame 5 is 7 everywhere"),
    images("another heart's place", "x.nrrd", changed(shifted), "beyond the first voxels"),
    images("voxels of another size", "x.nrrd", changed(other_spacing), "beyond|Dice"),
    images("left and right exchanged", "x.nrrd", changed(in_reverse), "Dice"),
    images("dark blood", "x.nrrd", voxels(dark), "Dice"),
    images("voxels elsewhere, in a device", "x.mhd", detached("/dev/zero"), "voxels from"),
    images("voxels elsewhere, in a pipe", "x.mhd", detached("data.raw"), "voxels from", data_raw=pipe),
    images("voxels in another folder", "x.mhd", detached("../secret"), "voxels from"),
    images("voxels in a list of files", "x.mhd", detached("LIST\na\nb"), "voxels from"),
    images("voxels that are not there", "x.mhd", detached("none.raw"), "voxels from"),
    images("voxels of an NRRD in a device", "x.nhdr", detached("/dev/zero", "nhdr"), "voxels from"),
    images(
        "voxels of an NRRD in a pipe", "x.nhdr", detached("data.raw", "nhdr"), "voxels from", data_raw=pipe
    ),
    images("a frame that is missing", "f", frames(remove("f4.mha")), "but 4 missing"),
    images("a frame twice", "f", frames(copied("f4.mha", "f04.mha")), "the number of frame"),
    images("frames of two series", "f", frames(copied("f4.mha", "g4.mha")), "two series in one folder"),
    images("a frame without a number", "f", frames(copied("f4.mha", "mask.mha")), "no number in its name"),
    images(
        "a frame that is text",
        "f",
        frames(lambda path: (path / "f4.mha").write_text("text")),
        "cannot be read",
    ),
    images("a frame that is a folder", "f", frames(lambda path: folder(path / "f4.mha")), "f4.mha"),
    images("pictures of two patients", "d", tag("0020|000d", "9.9", (1, 3)), "another study"),
    images(
        "pictures of two series mixed", "d", slices(copied("1_3.dcm", "again.dcm")), "same place and time"
    ),
    images("a picture that is missing", "d", slices(remove("1_3.dcm")), "missing|frames"),
    images(
        "a slice that is missing", "d", slices(lambda path: [file.unlink() for file in path.glob("1_*")]), "d"
    ),
    images("a trigger time of words", "d", tag("0018|1060", "late", (1, 3)), "d"),
    images(
        "no times at all",
        "d",
        slices(change=lambda place, frame: {"0018|1060": "", "0020|0100": ""}),
        "no trigger time",
    ),
    images("another frame of reference", "d", tag("0020|0052", "9.9", (2, 0)), "another frame of reference"),
    images(
        "a picture that is text",
        "d",
        slices(lambda path: (path / "9.dcm").write_text("text")),
        "not a sound DICOM",
    ),
    images(
        "a picture cut off",
        "d",
        slices(lambda path: (path / "1_3.dcm").write_bytes((path / "1_3.dcm").read_bytes()[:400])),
        "1_3.dcm",
    ),
    images(
        "a folder of text",
        "d",
        lambda path: path.mkdir() or (path / "readme").write_text("text"),
        "not a sound DICOM",
    ),
]
