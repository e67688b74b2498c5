"""In which order the frames of a beat are registered."""

from collections.abc import Iterator


def in_turn(count: int) -> Iterator[tuple[int, int]]:
    """Frames after the first, each with the neighbour matched before it: up to the middle, then back from the end."""
    middle = count // 2
    yield from ((frame, frame - 1) for frame in range(1, middle + 1))
    yield from ((frame, (frame + 1) % count) for frame in range(count - 1, middle, -1))
