"""Clocks that jump: they act on a study through the dates of its files."""

import os
import threading
import time
from random import Random

from tests.faults.outcome import Outcome, one_more_call
from tests.faults.tiny import RESULTS, TinyStudy, finish

HOUR = 3600.0


def clocks(study: TinyStudy, expected: dict[str, str], chance: Random, ways: int) -> list[Outcome]:
    """Results dated in the future and in the past; some of these ways."""
    jumps = {
        "every result dated at a random time within a day of now": lambda: chance.uniform(-24, 24) * HOUR,
        "the clock was an hour ahead: all results are dated in the future": lambda: HOUR,
        "the clock was ten years behind: all results are old": lambda: -87660 * HOUR,
    }
    outcomes = []
    for fault, jump in list(jumps.items())[:ways]:
        study.put_back()
        for file in sorted((study.folder / RESULTS).rglob("*")):
            date = file.stat().st_mtime + jump()
            os.utime(file, (date, date))
        study.remove("volunteer1/physical", "tables", "figures")
        mended = one_more_call(study, expected)
        outcomes.append(Outcome(fault, "results older than their input are made again", mended))
    return outcomes


def jumping_clock(study: TinyStudy, expected: dict[str, str], chance: Random) -> list[Outcome]:
    """The clock goes back by an hour while a call is at work."""
    study.put_back()
    study.remove("volunteer1/physical", "tables", "figures")
    process = study.start()
    timer = threading.Timer(chance.uniform(6.0, 10.0), lambda: _age(study))
    timer.start()
    code, _ = finish(process)
    timer.cancel()
    mended = one_more_call(study, expected)
    fault = "the clock goes back by an hour during a call"
    return [Outcome(fault, f"that call ended with {code}", mended)]


def _age(study: TinyStudy) -> None:
    """All existing files become an hour newer for the clock."""
    date = time.time() + HOUR
    for file in list((study.folder / RESULTS).rglob("*")):
        if file.is_file() and not any(part.startswith(".") for part in file.parts[-2:]):
            os.utime(file, (date, date))
