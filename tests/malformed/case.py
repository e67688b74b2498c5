"""Input with one mistake, and the response of a command."""

import os
import re
import signal
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from pathlib import Path

from heartfit.cli import main as cli

Content = str | bytes | Callable[[Path], object]
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


def exchanged(text: str, old: str, new: str) -> str:
    """The sound text with one part exchanged."""
    assert old in text, old
    return text.replace(old, new, 1)


def edited(change: Callable[[str], str]) -> Content:
    """The sound file with its text changed."""
    return lambda path: path.write_text(change(path.read_text()))


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


def files_in(folder: Path) -> dict[str, tuple[int, int]]:
    """Size and date of every file below the folder."""
    stats = {str(path.relative_to(folder)): path.lstat() for path in folder.rglob("*")}
    return {name: (stat.st_size, stat.st_mtime_ns) for name, stat in stats.items()}
