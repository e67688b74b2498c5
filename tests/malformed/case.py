"""Input with one mistake, and the response of a command."""

import os
import re
import signal
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from pathlib import Path

from heartfit.cli import main as cli

Content = str | bytes | Callable[[Path], None]
PATIENCE = 20
"""Time after which a command counts as hanging [s]."""


@dataclass(frozen=True)
class Malformed:
    """Files that replace sound ones, the command, and a pattern of its one line.

    A file is text, bytes, or a function that makes it at its path.
    """

    name: str
    command: str
    message: str
    files: Mapping[str, Content] = field(default_factory=dict)

    def lay(self, folder: Path) -> None:
        """Write the files."""
        for name, content in self.files.items():
            path = folder / name
            path.parent.mkdir(parents=True, exist_ok=True)
            if callable(content):
                content(path)
            else:
                path.write_bytes(content.encode() if isinstance(content, str) else content)

    def refused_by(self, lines: list[str]) -> bool:
        """True for one line, or several from a check of everything, one of which matches the pattern."""
        several = self.command.startswith("check")
        return (several or len(lines) == 1) and any(re.search(self.message, line) for line in lines)


def folder(path: Path) -> None:
    """A folder in the place of a file."""
    path.unlink(missing_ok=True)
    path.mkdir()


def pipe(path: Path) -> None:
    """Pipe without a writer."""
    path.unlink(missing_ok=True)
    os.mkfifo(path)


def hole(path: Path) -> None:
    """Sparse file of a terabyte."""
    path.touch()
    os.truncate(path, 1 << 40)


def exit_code(command: str) -> int:
    """Exit code of the command in this process, however it ends; raises Hang after the time limit."""
    signal.signal(signal.SIGALRM, _hangs)
    signal.alarm(PATIENCE)
    try:
        return cli.main(command.split("|"))
    except SystemExit as left:
        return int(left.code or 0)
    finally:
        signal.alarm(0)


class Hang(BaseException):
    """A command exceeds its time limit; no command catches this exception."""


def _hangs(*_: object) -> None:
    raise Hang(f"no answer after {PATIENCE} s")


def files_in(folder: Path) -> set[str]:
    """Every name below the folder."""
    return {str(path.relative_to(folder)) for path in folder.rglob("*")}
