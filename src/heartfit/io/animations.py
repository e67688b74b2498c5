"""Animations out."""

from pathlib import Path

from matplotlib.animation import FuncAnimation

from heartfit.io.atomic import replacing

WRITTEN = (".gif", ".png")


def write_animation(path: Path, animation: FuncAnimation) -> None:
    """Write as an animated GIF, or PNG in full colour, at its own pace; raises ValueError for another suffix.

    The delays of a GIF are whole hundredths of a second.
    """
    if Path(path).suffix not in WRITTEN:
        raise ValueError(f"{path}: animations are written as {', '.join(WRITTEN)}")
    with replacing(path) as draft:
        animation.save(draft, writer="pillow")
