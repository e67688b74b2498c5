"""A verdict beside the answer: what was said of a case in which it is known what was hidden."""

from dataclasses import dataclass, replace

from heartfit.diagnosis.cause import Cause
from heartfit.planting.case import Answer
from heartfit.planting.effects import Effect
from heartfit.planting.trial import REFUSED, Finding

SILENT = ("none", "insufficient", REFUSED)
"""Verdicts that claim nothing."""


@dataclass(frozen=True)
class Scored:
    """A finding beside its answer."""

    answer: Answer
    finding: Finding

    @property
    def truth(self) -> frozenset[str]:
        return frozenset(effect.name for effect in self.answer.effects)

    @property
    def planted(self) -> str:
        """What was planted, in words."""
        return " + ".join(effect.name for effect in self.answer.effects) or "nothing"

    @property
    def scales(self) -> float:
        """Size of what was planted; 0 where nothing was."""
        return max((effect.scales for effect in self.answer.effects), default=0.0)

    @property
    def detected(self) -> bool:
        """Whether anything at all was said to be missing from the model."""
        return self.finding.verdict not in SILENT

    @property
    def named(self) -> bool:
        """Whether it committed itself to one name, or to two."""
        return self.finding.verdict in ("named", "two")

    @property
    def right(self) -> bool:
        """Whether exactly what was planted was named."""
        return self.named and self.finding.names == self.truth

    @property
    def in_group(self) -> bool:
        """Whether the answer was a group that holds what was planted."""
        return self.finding.verdict == "group" and self.truth <= self.finding.names

    @property
    def said(self) -> str:
        """The verdict, or the name where one was given."""
        (*_, name) = [self.finding.verdict, *sorted(self.finding.names)]
        return name if self.finding.verdict == "named" else self.finding.verdict

    def told(self, data: str) -> "Scored":
        """The same case with what was said of less or more data; raises KeyError where these were not searched."""
        return replace(self, finding=self.finding.other[data])

    def ratio(self, effect: Effect) -> float:
        """Estimated amplitude over the planted one, both from where it is off."""
        return (self._of(effect).amplitude - effect.off) / (effect.amplitude - effect.off)

    def covered(self, effect: Effect) -> bool:
        """Whether the interval of the amplitude holds the planted one."""
        low, high = self._of(effect).interval
        return low <= effect.amplitude <= high

    def _of(self, effect: Effect) -> Cause:
        return next(each for each in self.finding.mechanisms if each.name == effect.name)
