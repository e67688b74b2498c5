"""Rows on disk, so that a run that was interrupted can go on."""

import json
import sys
from collections.abc import Callable
from dataclasses import asdict
from pathlib import Path

from benchmarks.registration.row import Errors, Row
from heartfit.io.files import write_text


class Kept:
    """Rows by name in a file; what is not there is measured, said and written."""

    def __init__(self, path: Path, again: bool) -> None:
        self._path = path
        self._rows = {} if again or not path.exists() else json.loads(path.read_text())

    def row(self, name: str, measure: Callable[[], Row]) -> Row:
        """The row of this name."""
        if name not in self._rows:
            self._rows[name] = asdict(measure())
            sys.stdout.write(f"{name}: {self._rows[name]}\n")
            sys.stdout.flush()
            write_text(self._path, json.dumps(self._rows, indent=1))
        stored = self._rows[name]
        return Row(stored["cpu"], stored["errors"] and Errors(**stored["errors"]), stored["refused"])
