"""Sealed records of hidden effects; a diagnosis imports none of this.

A seal is two lines: the SHA-256 of a record, and the record in base 64, which is not legible at a glance.
"""

import base64
import hashlib
import json
from collections.abc import Iterable
from pathlib import Path
from typing import Any, TypeVar

from heartfit.core.errors import InputError
from heartfit.io.files import write_text
from heartfit.io.results import decode, encode
from heartfit.synthetic.campaign import Effect

T = TypeVar("T")


def seal(path: Path, record: Any) -> None:
    """Write a record with its SHA-256, so that open_seal detects any change."""
    text = json.dumps(encode(record)).encode()
    write_text(path, f"{hashlib.sha256(text).hexdigest()}\n{base64.b64encode(text).decode()}\n")


def open_seal(path: Path, kind: type[T]) -> T:
    """Read a sealed record of a kind; raises InputError for a missing file and for a broken seal."""
    try:
        digest, body = Path(path).read_text(encoding="utf-8").split()
        text = base64.b64decode(body, validate=True)
    except (OSError, ValueError) as problem:
        raise InputError(f"{path}: no sealed record ({problem}); plant the case anew") from None
    if hashlib.sha256(text).hexdigest() != digest:
        raise InputError(f"{path}: the seal is broken: the record was changed after it was planted")
    return decode(json.loads(text), kind, str(path))


def open_effects(paths: Iterable[Path]) -> list[Effect]:
    """Read the hidden effects of one heart from its seal, or none without a seal."""
    return [effect for path in paths for effect in open_seal(Path(path), tuple[Effect, ...])]
