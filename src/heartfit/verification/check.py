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
