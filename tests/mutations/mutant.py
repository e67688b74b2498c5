"""A mutant: one change to the sources, and the tests that should notice it."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Mutant:
    """In ``file``, below the package, ``old`` becomes ``new``; ``tests`` should fail."""

    what: str
    file: str
    old: str
    new: str
    tests: str


def changes(file: str, tests: str, *of: tuple[str, str, str]) -> tuple[Mutant, ...]:
    """Mutants of one file that the same tests should notice: name, text of the sources, and text of the mutant."""
    return tuple(Mutant(what, file, old, new, tests) for what, old, new in of)
