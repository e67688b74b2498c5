"""A number beside the one it should be."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Check:
    """``measured`` should be within ``tolerance`` of ``expected``, all in ``unit``; ``source`` says why."""

    name: str
    measured: float
    expected: float
    tolerance: float
    unit: str
    source: str

    @property
    def passed(self) -> bool:
        """Whether it is; a number that is not finite is not."""
        return abs(self.measured - self.expected) <= self.tolerance

    @property
    def limit(self) -> str:
        """What is asked, in words of a table: expected and tolerance."""
        return f"{self.expected:g} | ± {self.tolerance:g}"


@dataclass(frozen=True)
class AtLeast(Check):
    """``measured`` should not be below ``expected`` by more than ``tolerance``."""

    @property
    def passed(self) -> bool:
        return self.measured >= self.expected - self.tolerance

    @property
    def limit(self) -> str:
        return f"≥ {self.expected - self.tolerance:g} |"
