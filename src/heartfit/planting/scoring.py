"""Verdicts beside the answers: who was named rightly, what was missed, and how far the counts can be trusted."""

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field

from heartfit.observation.coverage import Share
from heartfit.planting.case import Answer
from heartfit.planting.effects import Effect

SILENT = ("none", "insufficient")
"""Verdicts that claim nothing."""


@dataclass(frozen=True)
class Named:
    """A mechanism that was named: ln Bayes factor against none, amplitude and its 95 % interval, SI."""

    name: str
    ln_bayes_factor: float
    amplitude: float
    interval: tuple[float, float]


@dataclass(frozen=True)
class Finding:
    """What a diagnosis said of a case; ``gain`` are error ratios by curve on what was held out."""

    verdict: str
    mechanisms: tuple[Named, ...] = ()
    gain: Mapping[str, float] = field(default_factory=dict)
    simulations: int = 0
    seconds: float = 0.0

    @property
    def names(self) -> frozenset[str]:
        return frozenset(each.name for each in self.mechanisms)


@dataclass(frozen=True)
class Scored:
    """A finding beside its answer."""

    answer: Answer
    finding: Finding

    @property
    def truth(self) -> frozenset[str]:
        return frozenset(effect.name for effect in self.answer.effects)

    @property
    def detected(self) -> bool:
        """Whether anything at all was said to be missing from the model."""
        return self.finding.verdict not in SILENT

    @property
    def names_given(self) -> bool:
        """Whether it committed itself to one name, or to two."""
        return self.finding.verdict in ("named", "two")

    @property
    def right(self) -> bool:
        """Whether exactly what was planted was named."""
        return self.names_given and self.finding.names == self.truth

    @property
    def in_group(self) -> bool:
        """Whether the answer was a group that holds what was planted."""
        return self.finding.verdict == "group" and self.truth <= self.finding.names

    @property
    def said(self) -> str:
        """The verdict, or the name where one was given."""
        (*_, name) = [self.finding.verdict, *sorted(self.finding.names)]
        return name if self.finding.verdict == "named" else self.finding.verdict

    def ratio(self, effect: Effect, off: float) -> float:
        """Estimated amplitude over the planted one, both from ``off``."""
        return (self._named(effect.name).amplitude - off) / (effect.amplitude - off)

    def covered(self, effect: Effect) -> bool:
        """Whether the interval of the amplitude holds the planted one."""
        low, high = self._named(effect.name).interval
        return low <= effect.amplitude <= high

    def _named(self, name: str) -> Named:
        return next(each for each in self.finding.mechanisms if each.name == name)


def share(cases: Iterable[Scored], holds: Callable[[Scored], bool]) -> Share | None:
    """The share of the cases of which this holds, with its exact 95 % interval; None of no case."""
    held = [holds(each) for each in cases]
    return Share.of(float(sum(held)), len(held)) if held else None


@dataclass(frozen=True)
class Rate:
    """A figure of the benchmark: what is counted, its share, and the target it was set, if any."""

    name: str
    share: Share | None
    target: float | None = None
    at_most: bool = False

    @property
    def met(self) -> bool | None:
        """Whether the share itself meets the target; None without one, or without a case."""
        if self.target is None or self.share is None:
            return None
        return self.share.covered <= self.target if self.at_most else self.share.covered >= self.target


def rates(scored: Sequence[Scored]) -> list[Rate]:
    """The figures that the project set itself, and those that explain them."""
    of = {
        kind: [each for each in scored if each.answer.kind == kind]
        for kind in ("none", "single", "outside", "two")
    }
    singles, outside, pairs = of["single"], of["outside"], of["two"]
    given = [each for each in singles if each.names_given]
    seen = [each for each in outside if each.detected]
    said = [each for each in scored if each.names_given]
    return [
        Rate("false alarms of nulls", share(of["none"], lambda each: each.detected), 0.04, at_most=True),
        Rate("names of nulls", share(of["none"], lambda each: each.names_given)),
        *(
            Rate(
                f"detected at {size:g} scales",
                share(_of_size(singles, size), lambda each: each.detected),
                target,
            )
            for size, target in _sizes(singles)
        ),
        Rate("named right, of the names given to singles", share(given, lambda each: each.right), 0.95),
        Rate("named right, of the names given to all", share(said, lambda each: each.right)),
        Rate(
            "groups that hold the cause, of the groups", share(_groups(singles), lambda each: each.in_group)
        ),
        Rate("outsiders detected", share(outside, lambda each: each.detected)),
        Rate(
            "unknown, of the outsiders detected",
            share(seen, lambda each: each.finding.verdict == "unknown"),
            0.85,
        ),
        Rate("pairs: both right", share(pairs, lambda each: each.right)),
        Rate("pairs: a wrong pair", share(pairs, _wrong_pair), 0.02, at_most=True),
        Rate("pairs: one, and right", share(pairs, _one_right)),
    ]


def _groups(cases: Iterable[Scored]) -> list[Scored]:
    return [each for each in cases if each.finding.verdict == "group"]


def _of_size(singles: Iterable[Scored], scales: float) -> list[Scored]:
    return [each for each in singles if each.answer.effects[0].scales == scales]


def _sizes(singles: Iterable[Scored]) -> list[tuple[float, float | None]]:
    """Sizes that were planted; the target concerns two scales."""
    return [
        (size, 0.75 if size == 2.0 else None)
        for size in sorted({e.answer.effects[0].scales for e in singles})
    ]


def _wrong_pair(each: Scored) -> bool:
    return each.finding.verdict == "two" and not each.right


def _one_right(each: Scored) -> bool:
    return each.finding.verdict == "named" and each.finding.names < each.truth
