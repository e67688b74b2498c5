"""Checks of a measured number against an expected one."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Check:
    """Expectation that ``measured`` is within ``tolerance`` of ``expected``, all in ``unit``, by ``source``."""

    name: str
    measured: float
    expected: float
    tolerance: float
    unit: str
    source: str

    @property
    def passed(self) -> bool:
        """True within the tolerance; a number that is not finite fails."""
        return abs(self.measured - self.expected) <= self.tolerance

    @property
    def limit(self) -> str:
        """Expected value and tolerance."""
        return f"{self.expected:g} ± {self.tolerance:g}"


@dataclass(frozen=True)
class AtLeast(Check):
    """Expectation that ``measured`` is not below ``expected`` by more than ``tolerance``."""

    @property
    def passed(self) -> bool:
        return self.measured >= self.expected - self.tolerance

    @property
    def limit(self) -> str:
        return f"≥ {self.expected - self.tolerance:g}"
