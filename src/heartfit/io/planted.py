"""Planted cases on disk: what was measured in one folder, sealed answers in another that no diagnosis is given.

A seal is two lines: the SHA-256 of an answer, and the answer in base 64, which nobody reads in passing.
"""

import base64
import hashlib
import json
from dataclasses import asdict
from pathlib import Path

from heartfit.errors import InputError
from heartfit.io.atomic import write_text
from heartfit.io.curves import write_curves
from heartfit.planting.case import REST, Answer, PlantedCase
from heartfit.planting.effects import Effect

MEASURED = "MEASURED.csv"
"""The recording at rest; that of another condition is NAME.csv beside it."""


def write_planted(case: PlantedCase, folder: Path, answer: Path) -> None:
    """Write the recordings into a folder of the case's own, and seal the answer in a file elsewhere."""
    for condition, curves in case.curves.items():
        write_curves(Path(folder, MEASURED if condition == REST else f"{condition}.csv"), curves)
    seal(answer, case.answer)


def seal(path: Path, answer: Answer) -> None:
    """Write an answer so that a change of it is noticed."""
    text = json.dumps(asdict(answer)).encode()
    write_text(path, f"{hashlib.sha256(text).hexdigest()}\n{base64.b64encode(text).decode()}\n")


def open_seal(path: Path) -> Answer:
    """The answer; raises InputError for a missing file and for a broken seal."""
    try:
        digest, body = Path(path).read_text(encoding="utf-8").split()
        text = base64.b64decode(body, validate=True)
    except (OSError, ValueError) as problem:
        raise InputError(f"{path}: no sealed answer ({problem}); plant the case anew") from None
    if hashlib.sha256(text).hexdigest() != digest:
        raise InputError(f"{path}: the seal is broken: the answer was changed after it was planted")
    content = json.loads(text)
    return Answer(**content | {"effects": tuple(Effect(**each) for each in content["effects"])})
