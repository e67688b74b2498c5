"""What was done to a study and what came of it."""

import sys
from dataclasses import dataclass

from tests.faults.tiny import TinyStudy


@dataclass(frozen=True)
class Outcome:
    """A row of the page; mended: one more call completed, with every result identical to the bit."""

    done: str
    came: str
    mended: bool


def one_more_call(study: TinyStudy, expected: dict[str, str], *arguments: str) -> bool:
    """Whether one more call completes and every result is as expected, with nothing left over."""
    code, said = study.run(*arguments)
    differing = differences(study.sums(), expected)
    if code or differing:
        sys.stderr.write(f"{said[-3000:]}\nexit code {code}; different: {differing[:8]}\n")
    return code == 0 and not differing


def differences(found: dict[str, str], expected: dict[str, str]) -> list[str]:
    """What is wrong with the results, each named."""
    wrong = {name: "missing" for name in expected.keys() - found.keys()}
    wrong |= {name: "too many" for name in found.keys() - expected.keys()}
    wrong |= {name: "other bytes" for name in found.keys() & expected.keys() if found[name] != expected[name]}
    return [f"{name}: {what}" for name, what in sorted(wrong.items())]


def half_written(study: TinyStudy, expected: dict[str, str]) -> list[str]:
    """Names of results that are there, but not as expected; none that is missing."""
    return sorted(name for name, found in study.sums().items() if expected.get(name) != found)


def last_words(said: str, *known: str) -> str:
    """The line of a run's output that says one of these, or its last one."""
    lines = [line.strip() for line in said.splitlines() if line.strip()]
    return next((line for line in lines if any(word in line for word in known)), (lines or [""])[-1])
