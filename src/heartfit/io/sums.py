"""The sum of every file of a study as it was written, so that none is taken for whole that is not.

A folder of results keeps in its folder `.sums`, by the same name, the SHA-256 of each file as `sha256sum` prints it. A
file below no such folder has none, and nothing is known of it.
"""

import hashlib
from pathlib import Path

from heartfit.errors import InputError

FOLDER = ".sums"
DRAFT = ".draft-"
"""How the folder begins in which a file is written until it is whole."""


def keep_sums(results: Path) -> None:
    """From now on, note the sum of each file that is written below this folder."""
    Path(results, FOLDER).mkdir(parents=True, exist_ok=True)


def note(path: Path, draft: Path) -> None:
    """Note the sum of a draft that is about to become `path`, if sums are kept there."""
    noted = _note_of(path)
    if noted is None:
        return
    noted.parent.mkdir(parents=True, exist_ok=True)
    fresh = noted.with_name(f"{DRAFT}{noted.name}")
    fresh.write_text(f"{checksum(draft)}  {path.name}\n", encoding="utf-8")
    fresh.replace(noted)


def altered(results: Path) -> list[Path]:
    """Files below the folder that are not what was written there; one that is missing is not among them."""
    kept = Path(results, FOLDER)
    files = [Path(results, noted.relative_to(kept)) for noted in sorted(kept.rglob("*")) if noted.is_file()]
    return [file for file in files if file.is_file() and not is_as_written(file)]


def is_as_written(path: Path) -> bool:
    """Whether the file is what was written, as far as is known."""
    noted = _note_of(path)
    if noted is None or not noted.is_file():
        return True
    return noted.read_text(encoding="utf-8", errors="replace").split()[:1] == [checksum(path)]


def require_as_written(path: Path) -> None:
    """Raises InputError for a file that is not what was written."""
    if not is_as_written(path):
        raise InputError(f"{path}: not what was written there; delete it and run the stage again")


def forget(path: Path) -> None:
    """Nothing is known of the file any longer."""
    noted = _note_of(path)
    if noted is not None:
        noted.unlink(missing_ok=True)


def _note_of(path: Path) -> Path | None:
    """Where the sum of the file stands or would stand; None where none are kept, and for a part of a draft."""
    root = next((folder for folder in Path(path).parents if Path(folder, FOLDER).is_dir()), None)
    if root is None:
        return None
    inside = Path(path).relative_to(root)
    return None if any(part.startswith(DRAFT) for part in inside.parts) else root / FOLDER / inside


def checksum(path: Path) -> str:
    """The SHA-256 of a file, hexadecimal."""
    with Path(path).open("rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()
