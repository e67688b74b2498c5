"""Files that are there whole or not at all, even where the power fails."""

import os
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from tempfile import TemporaryDirectory

from heartfit.io.sums import DRAFT, note


@contextmanager
def replacing(path: Path) -> Iterator[Path]:
    """A path of the same name to write to; it takes the place of `path` if the block ends well."""
    path = Path(path)
    path.parent.mkdir(parents=True, exist_ok=True)
    with TemporaryDirectory(dir=path.parent, prefix=DRAFT) as folder:
        draft = Path(folder) / path.name
        yield draft
        _sync(draft)  # a name may reach the disk before what it names
        note(path, draft)
        draft.replace(path)
    _sync(path.parent)


def write_text(path: Path, text: str) -> None:
    with replacing(path) as draft:
        draft.write_text(text, encoding="utf-8")


def _sync(path: Path) -> None:
    """Wait until what is written is on the disk."""
    if os.name == "nt" and path.is_dir():
        return  # a folder cannot be opened there
    descriptor = os.open(path, os.O_RDONLY)
    try:
        os.fsync(descriptor)
    finally:
        os.close(descriptor)
