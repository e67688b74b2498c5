"""Comparison of the diagnosis of a planted case with its answer."""

from dataclasses import dataclass, replace

from heartfit.discovery.sphere_model.cause import Cause
from heartfit.synthetic.campaign import Effect
from heartfit.synthetic.case import Answer
from heartfit.synthetic.trial import REFUSED, ScoredDiagnosis

SILENT = ("none", "insufficient", REFUSED)
"""Verdicts that claim nothing."""


@dataclass(frozen=True)
class Scored:
    """Diagnosis of a planted case beside the answer."""

    answer: Answer
    finding: ScoredDiagnosis

    @property
    def truth(self) -> frozenset[str]:
        return frozenset(effect.name for effect in self.answer.effects)

    @property
    def planted(self) -> str:
        """Names of the planted effects as text."""
        return " + ".join(effect.name for effect in self.answer.effects) or "nothing"

    @property
    def scales(self) -> float:
        """Size of the planted effects [scales]; 0 without an effect."""
        return max((effect.scales for effect in self.answer.effects), default=0.0)

    @property
    def detected(self) -> bool:
        """True if the verdict claims that the model lacks something."""
        return self.finding.verdict not in SILENT

    @property
    def named(self) -> bool:
        """True if the verdict names one or two mechanisms."""
        return self.finding.verdict in ("named", "two")

    @property
    def right(self) -> bool:
        """True if the verdict names exactly the planted effects."""
        return self.named and self.finding.names == self.truth

    @property
    def in_group(self) -> bool:
        """True if the verdict is a group that contains the planted effects."""
        return self.finding.verdict == "group" and self.truth <= self.finding.names

    @property
    def conclusion(self) -> str:
        """Name of the mechanism if one is named, otherwise the verdict."""
        (*_, name) = [self.finding.verdict, *sorted(self.finding.names)]
        return name if self.finding.verdict == "named" else self.finding.verdict

    def with_data(self, data: str) -> "Scored":
        """Return the case with the diagnosis of another data set; raise KeyError if that was not searched."""
        return replace(self, finding=self.finding.other[data])

    def ratio(self, effect: Effect) -> float:
        """Return the estimated over the planted amplitude, both relative to the off value."""
        return (self._cause_of(effect).amplitude - effect.off) / (effect.amplitude - effect.off)

    def covered(self, effect: Effect) -> bool:
        """Return whether the interval of the amplitude contains the planted amplitude."""
        low, high = self._cause_of(effect).interval
        return low <= effect.amplitude <= high

    def _cause_of(self, effect: Effect) -> Cause:
        return next(cause for cause in self.finding.mechanisms if cause.name == effect.name)
