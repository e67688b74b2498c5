"""What the motion of a segmented heart is registered from."""

from pathlib import Path

from heartfit.configuration.source import Source
from heartfit.errors import InputError
from heartfit.imaging.sequence import ImageSequence
from heartfit.io.segmentations import read_segmentation
from heartfit.segmentation.labels import Segmentation
from heartfit.segmentation.sequence import label_images
from heartfit.segmentation.wall import Shaping


def followed(source: Source, images: ImageSequence) -> ImageSequence:
    """Images of the labels where every frame is segmented, which say more than the cine; else the cine itself.

    images: with end diastole first. Raises InputError where the segmentation has other frames than the cine.
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
    """The segmentations, none of a heart that is not segmented; raises InputError for other frames than the cine's."""
    if source.segmentation is None or source.labels is None:
        return ()
    frames = read_segmentation(Path(source.segmentation), source.labels.numbers())
    if len(frames) not in (1, len(images.times)):
        raise InputError(
            f"{source.segmentation}: {len(frames)} frames, the images have {len(images.times)}; expected as many, or "
            "end diastole alone: segment every frame"
        )
    return frames
