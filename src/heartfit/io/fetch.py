"""Brings published files here, each checked against its known checksum."""

import csv
import shutil
from pathlib import Path
from urllib.request import urlopen

from heartfit.errors import InputError
from heartfit.io.atomic import replacing
from heartfit.io.sums import checksum

TIMEOUT = 60  # s


def fetch(manifest: Path, address: str, folder: Path) -> None:
    """Fetch what `manifest` lists from below `address` (its end a slash) into `folder`.

    The manifest has the columns file (place in the folder), source (place below the address) and sha256.
    Files that are there and right are kept. Raises InputError for bytes that are not those of the checksum.
    """
    with manifest.open(newline="", encoding="utf-8") as lines:
        rows = list(csv.DictReader((line for line in lines if not line.startswith("#")), delimiter="\t"))
    for row in rows:
        _fetch_one(address + row["source"], folder / row["file"], row["sha256"])


def _fetch_one(address: str, path: Path, sha256: str) -> None:
    if path.is_file() and checksum(path) == sha256:
        return
    with replacing(path) as draft:
        with urlopen(address, timeout=TIMEOUT) as source, draft.open("wb") as target:
            shutil.copyfileobj(source, target)
        found = checksum(draft)
        if found != sha256:
            raise InputError(f"{address}: sha256 {found}, expected {sha256}; it is not the published file")
