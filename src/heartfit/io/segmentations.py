"""Segmentations: one volume of labels at end diastole, or one for every frame of the beat."""

from collections.abc import Mapping, Sequence
from difflib import get_close_matches
from pathlib import Path

import numpy as np
import SimpleITK as sitk

from heartfit.core.arrays import Floats, Integers
from heartfit.core.errors import InputError
from heartfit.imaging.segmentation.stack import PARTS, REQUIRED_PARTS, Segmentation
from heartfit.imaging.segmentation.surface import label_images
from heartfit.imaging.segmentation.wall import Shaping
from heartfit.imaging.sequence import Grid, ImageSequence
from heartfit.io.files import replacing
from heartfit.io.image_file import MILLIMETRE, grid_of, load, numbers, read_frames
from heartfit.study.case import Source


def read_segmentation(path: Path, labels: Mapping[str, int]) -> tuple[Segmentation, ...]:
    """Read a segmentation, one for each frame: a 3-D or 4-D file, or a folder of numbered 3-D files.

    labels: numbers of lv_cavity, lv_wall, rv_cavity and, if it is segmented, rv_wall; other numbers are background.
    Raises InputError, in one line that names the file, for invalid labels, voxels that are not whole numbers, and a
    part without voxels.
    """
    path = Path(path)
    require_labels(labels, path)
    grid, frames = _read(path)
    codes = _whole(path, frames)
    _require_present(path, labels, codes[0])
    return tuple(_frame(path, number, grid, frame, labels) for number, frame in enumerate(codes))


def require_labels(labels: Mapping[str, int], where: Path | str) -> None:
    """Raise InputError unless every required part, and no unknown part, has a distinct number."""
    for name in labels:
        if name not in PARTS:
            near = get_close_matches(name, PARTS, n=1, cutoff=0.4)
            hint = f"did you mean {near[0]}? " if near else ""
            raise InputError(f"{where}: unknown label {name!r}; {hint}Known are {', '.join(PARTS)}")
    missing = [name for name in REQUIRED_PARTS if name not in labels]
    if missing:
        raise InputError(
            f"{where}: no number is stated for {', '.join(missing)}; expected {', '.join(REQUIRED_PARTS)}"
        )
    taken: dict[int, str] = {0: "the surroundings"}
    for name, number in labels.items():
        if number in taken:
            raise InputError(
                f"{where}: {name} and {taken[number]} are both {number}; expected a number of its own for each part"
            )
        taken[number] = name


def write_segmentation(path: Path, frames: Sequence[Segmentation], labels: Mapping[str, int]) -> None:
    """Write labels, 4-D or 3-D of one frame, as .nrrd, .nii.gz or .mha; a part without a label becomes 0."""
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
    """Read grid and voxels (p, k, j, i)."""
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
    present = sorted(set(np.unique(first).tolist()) - {0})
    for name, number in labels.items():
        if number not in present:
            raise InputError(
                f"{path}: no voxel has {number}, stated for {name}; found are {_first_eight(present)}: "
                "state the numbers that this file uses"
            )


def _first_eight(numbers: list[int]) -> str:
    more = f" and {len(numbers) - 8} more" if len(numbers) > 8 else ""
    return ", ".join(map(str, numbers[:8])) + more or "none"


def _frame(path: Path, number: int, grid: Grid, codes: Integers, labels: Mapping[str, int]) -> Segmentation:
    try:
        return Segmentation(grid, {name: codes == label for name, label in labels.items()})
    except InputError as fault:
        raise InputError(f"{path}: frame {number}: {fault}") from None


def sequence_to_track(source: Source, images: ImageSequence) -> ImageSequence:
    """Images of the labels if every frame is segmented, because labels are clearer than the cine; else the cine.

    images: the cine, end diastole first. Raises InputError if the segmentation has another number of frames.
    """
    frames = frames_of(source, images)
    if len(frames) <= 1:
        return images
    turned = [*frames[source.end_diastole :], *frames[: source.end_diastole]]
    shaping = Shaping(right_wall=source.rv_wall_thickness)
    try:
        return label_images(turned, images.times, images.period, shaping)
    except InputError as fault:
        raise InputError(f"{source.segmentation}: {fault}") from None


def frames_of(source: Source, images: ImageSequence) -> tuple[Segmentation, ...]:
    """Segmentations of a source, empty without one; raises InputError for another number of frames than the cine."""
    if source.segmentation is None or source.labels is None:
        return ()
    frames = read_segmentation(Path(source.segmentation), source.labels.numbers())
    if len(frames) not in (1, len(images.times)):
        raise InputError(
            f"{source.segmentation}: {len(frames)} frames, the images have {len(images.times)}; expected as many, or "
            "end diastole alone: segment every frame"
        )
    return frames
