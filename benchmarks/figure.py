"""Figure of the page of performance with its target."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Figure:
    """A measured value with its target: an upper limit, or with ``at_least`` a lower one.

    tried: attempts to reach a missed target.
    """

    name: str
    measured: float
    target: float
    unit: str
    at_least: bool = False
    tried: str = ""

    @property
    def met(self) -> bool:
        """Return True if the target is met; NaN is not."""
        return self.measured >= self.target if self.at_least else self.measured <= self.target

    def row(self) -> str:
        """Return the row of the table."""
        sign, verdict = "≥" if self.at_least else "≤", "met" if self.met else "**missed**"
        return f"| {self.name} | {self.measured:.3g} | {sign} {self.target:g} | {self.unit} | {verdict} |\n"
