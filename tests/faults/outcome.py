"""Outcome of a fault: its description and its result."""

import sys
from dataclasses import dataclass

from tests.faults.tiny import TinyStudy


@dataclass(frozen=True)
class Outcome:
    """A row of the page; mended: one more call completed, with every result identical to the bit."""

    fault: str
    came: str
    mended: bool


def one_more_call(study: TinyStudy, expected: dict[str, str], *arguments: str) -> bool:
    """True if one more call completes with exactly the expected results."""
    code, output = study.run(*arguments)
    differing = differences(study.sums(), expected)
    if code or differing:
        sys.stderr.write(f"{output[-3000:]}\nexit code {code}; different: {differing[:8]}\n")
    return code == 0 and not differing


def differences(sums: dict[str, str], expected: dict[str, str]) -> list[str]:
    """Names of missing, additional and differing results."""
    wrong = {name: "missing" for name in expected.keys() - sums.keys()}
    wrong |= {name: "too many" for name in sums.keys() - expected.keys()}
    wrong |= {name: "other bytes" for name in sums.keys() & expected.keys() if sums[name] != expected[name]}
    return [f"{name}: {what}" for name, what in sorted(wrong.items())]


def half_written(study: TinyStudy, expected: dict[str, str]) -> list[str]:
    """Names of results that are there, but not as expected; none that is missing."""
    return sorted(name for name, checksum in study.sums().items() if expected.get(name) != checksum)


def last_words(output: str, *known: str) -> str:
    """Line of a run's output that holds one of the known texts, or its last line."""
    lines = [line.strip() for line in output.splitlines() if line.strip()]
    return next((line for line in lines if any(word in line for word in known)), (lines or [""])[-1])
