"""Where a study may write: below the working directory, also by links."""

import os
from pathlib import Path

from heartfit.errors import InputError


def require_inside(folder: Path, what: str) -> None:
    """Raises InputError where a link leads out of the working directory."""
    place, here = Path(folder).resolve(), Path.cwd().resolve()
    if not place.is_relative_to(here):
        raise InputError(
            f"{what} = {folder} leads to {place}; expected a folder within {here}: choose another or remove the link"
        )


def require_writable(folder: Path) -> None:
    """Raises InputError where no file can be written into a folder that is there or to be made."""
    nearest = next(each for each in (folder, *folder.absolute().parents) if each.exists())
    if not nearest.is_dir():
        raise InputError(f"{folder}: {nearest} is a file; expected a folder to write into: choose another")
    if not os.access(nearest, os.W_OK):
        raise InputError(
            f"{folder}: nothing may be written into {nearest}; choose another folder or change its rights"
        )
