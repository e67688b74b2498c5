"""Messages of the command line, and options shared by several commands."""

import argparse
import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import NoReturn

from heartfit.core.errors import InputError
from heartfit.heart.beat import Beat
from heartfit.observation.beat import beat_curves
from heartfit.observation.operator import cavity_indices

KILOPASCAL, MILLILITRE = 1e3, 1e-6
"""SI values of the printed units."""
PROGRESS_INTERVAL = 1.0
"""Time between messages of progress [s]."""


class Parser(argparse.ArgumentParser):
    """Parser that rejects arguments with the same one-line message as other input, instead of the usage."""

    def error(self, message: str) -> NoReturn:
        """Raise InputError with the message and a reference to the help."""
        raise InputError(f"{message}; `{self.prog} --help` lists what is expected")


def refusal(problem: BaseException) -> str:
    """Return the message of a problem on one line, whatever characters it quotes."""
    message = str(problem)
    if isinstance(problem, OSError):
        place = "" if problem.filename is None else f"{problem.filename}: "
        fault = (problem.strerror or message).lower()
        message = (
            f"{place}{fault}; expected what can be read or written: correct the path or its access rights"
        )
    if isinstance(problem, MemoryError):
        message = (
            "the input needs more memory than available; expected the data of one heart: correct the input"
        )
    return one_line(message)


def one_line(text: str) -> str:
    """Return the text with unprintable characters as escape sequences."""
    return "".join(character if character.isprintable() else repr(character)[1:-1] for character in text)


class Progress:
    """Progress on standard error, once a second: completed share and remaining time at the mean pace."""

    def __init__(self) -> None:
        self._begin = self._printed = time.monotonic()

    def __call__(self, completed: float) -> None:
        now = time.monotonic()
        if now - self._printed >= PROGRESS_INTERVAL:
            self._printed = now
            left = (now - self._begin) * (1.0 - completed) / completed
            sys.stderr.write(
                f"{100 * completed:3.0f} % of the maximal number of beats, at most {left:.0f} s remaining\n"
            )


def beat_summary(beat: Beat) -> list[str]:
    """Return lines with cost, periodicity, volumes and pressures of a beat, or the reason of its failure."""
    if not beat.completed:
        return [f"failed: {beat.reason}"]
    diagnostics = beat.diagnostics
    return [
        f"{diagnostics['beats']:.0f} beats, {diagnostics['cpu_s'] / diagnostics['beats']:.2f} CPU s a beat, "
        f"drift {100 * diagnostics['drift']:.2f} %, wall volume loss {100 * diagnostics['wall_volume_loss']:.2f} %",
        _ventricle(beat, "lv", "aorta"),
        _ventricle(beat, "rv", "pulmonary_artery"),
    ]


def _ventricle(beat: Beat, side: str, artery: str) -> str:
    indices = cavity_indices(beat_curves(beat), side)
    end_diastolic, end_systolic = (indices[name] / MILLILITRE for name in ("EDV", "ESV"))
    pressure, peak = beat.pressure[artery] / KILOPASCAL, beat.pressure[side].max() / KILOPASCAL
    return (
        f"{side.upper()}: EDV {end_diastolic:.1f} mL, ESV {end_systolic:.1f} mL, "
        f"EF {100 * indices['EF']:.1f} %, peak {peak:.2f} kPa, "
        f"{artery.replace('_', ' ')} {pressure.min():.2f} to {pressure.max():.2f} kPa"
    )


STANDARD = Path("config/config.yaml")
"""Configuration of a study if none is named."""

Command = tuple[Callable[[argparse.Namespace], int], Callable[[argparse.ArgumentParser], None], str]
"""Function that runs a command, function that adds its arguments, and line of help."""


def add_configuration(command: argparse.ArgumentParser) -> None:
    """Add ``--config``: files of a study, later ones override earlier ones; config/config.yaml by default."""
    command.add_argument(
        "--config",
        type=Path,
        nargs="+",
        default=[STANDARD],
        metavar="YAML",
        help="configuration files; later ones override earlier ones",
    )


def add_no_arguments(_: argparse.ArgumentParser) -> None:
    """Add no argument."""
