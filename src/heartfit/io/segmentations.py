"""Segmentations: a volume of labels for one moment of the beat, or one for each frame."""

from collections.abc import Mapping, Sequence
from difflib import get_close_matches
from pathlib import Path

import numpy as np
import SimpleITK as sitk

from heartfit.errors import InputError
from heartfit.geometry.arrays import Floats, Integers
from heartfit.imaging.grid import Grid
from heartfit.io.atomic import replacing
from heartfit.io.image_file import MILLIMETRE, grid_of, load, numbers
from heartfit.io.image_folder import read_frames
from heartfit.segmentation.labels import NEEDED, PARTS, Segmentation


def read_segmentation(path: Path, labels: Mapping[str, int]) -> tuple[Segmentation, ...]:
    """The segmentation at `path`, one for each frame: a 3-D or 4-D file, or a folder of numbered 3-D files.

    labels: which number means lv_cavity, lv_wall, rv_cavity and, if it is segmented, rv_wall; other numbers are
    surroundings. Raises InputError, in one line that names the file, for labels that cannot be meant, voxels that are
    no whole numbers, and a part that is nowhere.
    """
    path = Path(path)
    require_labels(labels, path)
    grid, frames = _read(path)
    codes = _whole(path, frames)
    _require_present(path, labels, codes[0])
    return tuple(_frame(path, number, grid, frame, labels) for number, frame in enumerate(codes))


def require_labels(labels: Mapping[str, int], where: Path | str) -> None:
    """Raises InputError unless every part that is needed, and none that is unknown, has a number of its own."""
    for name in labels:
        if name not in PARTS:
            near = get_close_matches(name, PARTS, n=1, cutoff=0.4)
            meant = f"did you mean {near[0]}? " if near else ""
            raise InputError(f"{where}: unknown label {name!r}; {meant}Known are {', '.join(PARTS)}")
    missing = [name for name in NEEDED if name not in labels]
    if missing:
        raise InputError(
            f"{where}: no number is stated for {', '.join(missing)}; expected one for each of {', '.join(NEEDED)}"
        )
    taken: dict[int, str] = {0: "the surroundings"}
    for name, number in labels.items():
        if number in taken:
            raise InputError(
                f"{where}: {name} and {taken[number]} are both {number}; expected a number of its own for each part"
            )
        taken[number] = name


def write_segmentation(path: Path, frames: Sequence[Segmentation], labels: Mapping[str, int]) -> None:
    """Writes labels, 4-D or 3-D if there is one frame, as .nrrd, .nii.gz or .mha; a part without label becomes 0."""
    images = [_image(frame, labels) for frame in frames]
    image = images[0] if len(images) == 1 else sitk.JoinSeries(images)
    with replacing(Path(path)) as draft:
        sitk.WriteImage(image, str(draft), useCompression=True)


def _image(frame: Segmentation, labels: Mapping[str, int]) -> sitk.Image:
    grid, codes = frame.grid, np.zeros(frame.grid.shape, np.uint8)
    for name, number in labels.items():
        codes[frame.parts[name]] = number
    image = sitk.GetImageFromArray(codes)
    image.SetSpacing((grid.spacing / MILLIMETRE).tolist())
    image.SetOrigin((grid.origin / MILLIMETRE).tolist())
    image.SetDirection(grid.direction.ravel().tolist())
    return image


def _read(path: Path) -> tuple[Grid, Floats]:
    """Where the voxels lie, and the voxels (p,k,j,i)."""
    if path.is_dir():
        return read_frames(path)
    image = load(path)
    if image.GetDimension() not in (3, 4) or image.GetNumberOfComponentsPerPixel() != 1:
        raise InputError(
            f"{path}: {image.GetDimension()}-D, numbers in a voxel {image.GetNumberOfComponentsPerPixel()}; "
            "expected a volume of labels, 3-D or 4-D with time last"
        )
    voxels = numbers(image)
    return grid_of(image, path), voxels if voxels.ndim == 4 else voxels[None]


def _whole(path: Path, voxels: Floats) -> Integers:
    codes = np.rint(np.nan_to_num(voxels, nan=np.inf, posinf=np.inf))
    wrong = voxels[~(codes == voxels)]
    if len(wrong):
        raise InputError(
            f"{path}: {len(wrong)} voxels are no whole numbers, the first {wrong[0]:g}; expected labels: "
            "take the segmentation as it was drawn, not resampled, and not the image"
        )
    return codes.astype(np.int64)


def _require_present(path: Path, labels: Mapping[str, int], first: Integers) -> None:
    found = sorted(set(np.unique(first).tolist()) - {0})
    for name, number in labels.items():
        if number not in found:
            raise InputError(
                f"{path}: no voxel has {number}, stated for {name}; found are {_some(found)}: "
                "state the numbers that this file uses"
            )


def _some(found: list[int]) -> str:
    return (
        ", ".join(map(str, found[:8])) + (f" and {len(found) - 8} more" if len(found) > 8 else "") or "none"
    )


def _frame(path: Path, number: int, grid: Grid, codes: Integers, labels: Mapping[str, int]) -> Segmentation:
    try:
        return Segmentation(grid, {name: codes == label for name, label in labels.items()})
    except InputError as fault:
        raise InputError(f"{path}: frame {number}: {fault}") from None
