"""Figure of performance with its target."""

import math
from dataclasses import dataclass


@dataclass(frozen=True)
class Figure:
    """A measured value with its target: an upper limit, or with ``at_least`` a lower one; infinite for none.

    before: value of an earlier version, measured in the same run.
    """

    name: str
    measured: float
    target: float
    unit: str
    at_least: bool = False
    before: float = math.nan

    @property
    def met(self) -> bool:
        """Return True if the target is met; NaN is not."""
        return self.measured >= self.target if self.at_least else self.measured <= self.target

    def row(self) -> dict[str, str]:
        """Return the row of the table."""
        limited, compared = math.isfinite(self.target), math.isfinite(self.before)
        sign, verdict = "≥" if self.at_least else "≤", "met" if self.met else "**missed**"
        target, verdict = (f"{sign} {self.target:g}", verdict) if limited else ("", "")
        before, ratio = (f"{self.before:.3g}", f"{self.measured / self.before:.2f}") if compared else ("", "")
        return {
            "figure": self.name,
            "before": before,
            "now": f"{self.measured:.3g}",
            "ratio": ratio,
            "target": target,
            "unit": self.unit,
            "verdict": verdict,
        }
