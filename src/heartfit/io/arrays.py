"""Arrays by name in an .npz file, refused in one line when it is damaged; nothing in it is unpickled."""

from pathlib import Path
from zipfile import BadZipFile

import numpy as np

from heartfit.io.foreign import parsing
from heartfit.io.text import require_file


def read_arrays(path: Path, *names: str) -> dict[str, np.ndarray]:
    """The arrays of these names; raises InputError for a missing or damaged file and one that lacks a name."""
    expected = f"the arrays {', '.join(names)} in .npz format"
    require_file(path, expected)
    with (
        parsing(path, expected, BadZipFile, OSError),
        Path(path).open("rb") as file,
        np.load(file, allow_pickle=False) as stored,
    ):
        return {name: stored[name] for name in names}
