"""An input that is wrong in one way, and what a command makes of it."""

import os
import re
import signal
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from pathlib import Path

from heartfit.cli import main as cli

Content = str | bytes | Callable[[Path], None]
PATIENCE = 20
"""Seconds after which a command hangs."""


@dataclass(frozen=True)
class Malformed:
    """The files that are laid over sound ones, the command, and a pattern that its one line holds.

    A file is text, bytes, or a function that makes it at its path.
    """

    name: str
    command: str
    says: str
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
        """Whether there is one line, or where everything is checked at once several, and one says what is wrong."""
        several = self.command.startswith("check")
        return (several or len(lines) == 1) and any(re.search(self.says, line) for line in lines)


def folder(path: Path) -> None:
    """A folder in the place of a file."""
    path.unlink(missing_ok=True)
    path.mkdir()


def pipe(path: Path) -> None:
    """A pipe that nobody fills."""
    path.unlink(missing_ok=True)
    os.mkfifo(path)


def hole(path: Path) -> None:
    """A file of a terabyte that takes no room."""
    path.touch()
    os.truncate(path, 1 << 40)


def exit_code(command: str) -> int:
    """Of the command in this process, however it leaves; raises Hang where it hangs."""
    signal.signal(signal.SIGALRM, _hangs)
    signal.alarm(PATIENCE)
    try:
        return cli.main(command.split("|"))
    except SystemExit as left:
        return int(left.code or 0)
    finally:
        signal.alarm(0)


class Hang(BaseException):
    """No command catches it."""


def _hangs(*_: object) -> None:
    raise Hang(f"no answer after {PATIENCE} s")


def files_in(folder: Path) -> set[str]:
    """Every name below the folder."""
    return {str(path.relative_to(folder)) for path in folder.rglob("*")}
