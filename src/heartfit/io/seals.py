"""Planted cases and their sealed answers; a diagnosis imports none of this.

A seal is two lines: the SHA-256 of an answer, and the answer in base 64, which is not legible at a glance.
"""

import base64
import hashlib
import json
from dataclasses import asdict
from pathlib import Path

from heartfit.core.errors import InputError
from heartfit.io.beats import MEASURED
from heartfit.io.curves import write_curves
from heartfit.io.files import write_text
from heartfit.io.results import decode
from heartfit.synthetic.case import REST, Answer, PlantedCase


def write_planted(case: PlantedCase, measured: Path, sealed: Path) -> None:
    """Write the recordings into the folder ``measured``/SEED, and seal the answer as ``sealed``/SEED.answer."""
    seed = str(case.answer.seed)
    for condition, curves in case.curves.items():
        write_curves(Path(measured, seed, MEASURED if condition == REST else f"{condition}.csv"), curves)
    seal(Path(sealed, f"{seed}.answer"), case.answer)


def seal(path: Path, answer: Answer) -> None:
    """Write an answer with its SHA-256, so that open_seal detects any change."""
    text = json.dumps(asdict(answer)).encode()
    write_text(path, f"{hashlib.sha256(text).hexdigest()}\n{base64.b64encode(text).decode()}\n")


def open_seal(path: Path) -> Answer:
    """Read a sealed answer; raises InputError for a missing file and for a broken seal."""
    try:
        digest, body = Path(path).read_text(encoding="utf-8").split()
        text = base64.b64decode(body, validate=True)
    except (OSError, ValueError) as problem:
        raise InputError(f"{path}: no sealed answer ({problem}); plant the case anew") from None
    if hashlib.sha256(text).hexdigest() != digest:
        raise InputError(f"{path}: the seal is broken: the answer was changed after it was planted")
    return decode(json.loads(text), Answer, str(path))
