"""What the command line says: of a beat while it runs and when it is done, and of input that it refuses."""

import argparse
import sys
import time
from typing import NoReturn

from heartfit.beat import Beat
from heartfit.errors import InputError
from heartfit.observation.beat import beat_curves
from heartfit.observation.vector import cavity_indices

KILOPASCAL, MILLILITRE = 1e3, 1e-6
EVERY = 1.0  # s


class Parser(argparse.ArgumentParser):
    """Refuses arguments as all other input is refused, instead of with the whole usage."""

    def error(self, message: str) -> NoReturn:
        """Raises InputError."""
        raise InputError(f"{message}; `{self.prog} --help` tells what is expected")


def refusal(problem: BaseException) -> str:
    """What is wrong, on one line whatever characters it quotes."""
    said = str(problem)
    if isinstance(problem, OSError):
        place = "" if problem.filename is None else f"{problem.filename}: "
        fault = (problem.strerror or said).lower()
        said = f"{place}{fault}; expected what can be read or written: correct path or rights"
    if isinstance(problem, MemoryError):
        said = "the input asks for more memory than there is; expected the data of one heart: correct it"
    return one_line(said)


def one_line(text: str) -> str:
    """Text with whatever is no printable character written out."""
    return "".join(each if each.isprintable() else repr(each)[1:-1] for each in text)


class Progress:
    """Says on standard error, once a second, how much is done and how long the rest takes at this pace."""

    def __init__(self) -> None:
        self._begin = self._said = time.monotonic()

    def __call__(self, done: float) -> None:
        now = time.monotonic()
        if now - self._said >= EVERY:
            self._said = now
            left = (now - self._begin) * (1.0 - done) / done
            sys.stderr.write(f"{100 * done:3.0f} % of the most beats allowed, {left:.0f} s left or less\n")


def beat_summary(beat: Beat) -> list[str]:
    """Lines that tell cost, periodicity, volumes and pressures of a beat, or why there is none."""
    if not beat.completed:
        return [f"failed: {beat.reason}"]
    seen = beat.diagnostics
    return [
        f"{seen['beats']:.0f} beats, {seen['cpu_s'] / seen['beats']:.2f} CPU s a beat, "
        f"drift {100 * seen['drift']:.2f} %, wall volume loss {100 * seen['wall_volume_loss']:.2f} %",
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
