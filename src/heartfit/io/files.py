"""Atomic writing, checksums and download of files.

A file is written to a draft that replaces it once it is complete. A folder of results keeps in its subfolder `.sums`,
under the same name, the SHA-256 of every file as `sha256sum` prints it, so that a damaged file is never taken for
whole. A file outside such a folder has no checksum and is not checked.
"""

import csv
import hashlib
import os
import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from tempfile import TemporaryDirectory

from heartfit.core.errors import InputError

FOLDER = ".sums"
DRAFT = ".draft-"
"""Prefix of the folder that holds a file until it is complete."""


def keep_sums(results: Path) -> None:
    """Record from now on the checksum of every file that is written below this folder."""
    Path(results, FOLDER).mkdir(parents=True, exist_ok=True)


def note(path: Path, draft: Path) -> None:
    """Record the checksum of a draft that is about to become `path`, if checksums are kept there."""
    noted = _note_of(path)
    if noted is None:
        return
    noted.parent.mkdir(parents=True, exist_ok=True)
    fresh = noted.with_name(f"{DRAFT}{noted.name}")
    fresh.write_text(f"{checksum(draft)}  {path.name}\n", encoding="utf-8")
    fresh.replace(noted)


def altered(results: Path) -> list[Path]:
    """Files below the folder whose content differs from the recorded checksum; missing files are left out."""
    kept = Path(results, FOLDER)
    files = [Path(results, noted.relative_to(kept)) for noted in sorted(kept.rglob("*")) if noted.is_file()]
    return [file for file in files if file.is_file() and not is_as_written(file)]


def is_as_written(path: Path) -> bool:
    """Return False if the content of the file differs from its recorded checksum."""
    noted = _note_of(path)
    if noted is None or not noted.is_file():
        return True
    return noted.read_text(encoding="utf-8", errors="replace").split()[:1] == [checksum(path)]


def require_as_written(path: Path) -> None:
    """Raise InputError for a file whose content differs from its recorded checksum."""
    if not is_as_written(path):
        raise InputError(f"{path}: not what was written there; delete it and run the stage again")


def forget(path: Path) -> None:
    """Delete the checksum of a file."""
    noted = _note_of(path)
    if noted is not None:
        noted.unlink(missing_ok=True)


def _note_of(path: Path) -> Path | None:
    """File of the checksum; None outside folders that keep checksums, and for a part of a draft."""
    root = next((folder for folder in Path(path).parents if Path(folder, FOLDER).is_dir()), None)
    if root is None:
        return None
    inside = Path(path).relative_to(root)
    return None if any(part.startswith(DRAFT) for part in inside.parts) else root / FOLDER / inside


def checksum(path: Path) -> str:
    """SHA-256 of a file, hexadecimal."""
    with Path(path).open("rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()


@contextmanager
def replacing(path: Path) -> Iterator[Path]:
    """Yield a draft of the same name, which replaces `path` if the block raises nothing."""
    path = Path(path)
    path.parent.mkdir(parents=True, exist_ok=True)
    with TemporaryDirectory(dir=path.parent, prefix=DRAFT) as folder:
        draft = Path(folder) / path.name
        yield draft
        _sync(draft)  # the content must reach the disk before the new name
        note(path, draft)
        draft.replace(path)
    _sync(path.parent)


def write_text(path: Path, text: str) -> None:
    """Write UTF-8 text."""
    with replacing(path) as draft:
        draft.write_text(text, encoding="utf-8")


def _sync(path: Path) -> None:
    """Wait until the content is on the disk."""
    if os.name == "nt" and path.is_dir():
        return  # Windows cannot open a folder
    descriptor = os.open(path, os.O_RDONLY)
    try:
        os.fsync(descriptor)
    finally:
        os.close(descriptor)


def require_inside(folder: Path, key: str) -> None:
    """Raise InputError if the folder of a configuration key leads out of the working directory by a link."""
    place, here = Path(folder).resolve(), Path.cwd().resolve()
    if not place.is_relative_to(here):
        raise InputError(
            f"{key} = {folder} leads to {place}; expected a folder within {here}: choose another or remove the link"
        )


def require_writable(folder: Path) -> None:
    """Raise InputError unless files can be written into a folder, which need not exist yet."""
    nearest = next(place for place in (folder, *folder.absolute().parents) if place.exists())
    if not nearest.is_dir():
        raise InputError(f"{folder}: {nearest} is a file; expected a folder to write into: choose another")
    if not os.access(nearest, os.W_OK):
        raise InputError(
            f"{folder}: nothing may be written into {nearest}; choose another folder or change its rights"
        )


DOWNLOAD_TIMEOUT = 60
"""[s]"""


def fetch(manifest: Path, address: str, folder: Path) -> None:
    """Download the files of a manifest from below `address`, which ends in a slash, into `folder`.

    Files with the right checksum are kept. Raises InputError for a download with another checksum.
    """
    for row in read_manifest(manifest):
        _fetch_one(address + row["source"], folder / row["file"], row["sha256"])


def read_manifest(manifest: Path) -> list[dict[str, str]]:
    """Rows of a manifest: file (path in the folder), source (path below the address of a download) and sha256."""
    with manifest.open(newline="", encoding="utf-8") as lines:
        return list(csv.DictReader((line for line in lines if not line.startswith("#")), delimiter="\t"))


def _fetch_one(address: str, path: Path, sha256: str) -> None:
    if path.is_file() and checksum(path) == sha256:
        return
    from urllib.request import urlopen  # every job imports this module

    with replacing(path) as draft:
        with urlopen(address, timeout=DOWNLOAD_TIMEOUT) as source, draft.open("wb") as target:
            shutil.copyfileobj(source, target)
        downloaded = checksum(draft)
        if downloaded != sha256:
            raise InputError(
                f"{address}: sha256 {downloaded}, expected {sha256}; it is not the published file"
            )
