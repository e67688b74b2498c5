"""Verdicts on hearts of other simulators, counted by world and kind of heart."""

from collections.abc import Sequence
from dataclasses import dataclass

import pandas as pd

from heartfit.observation.noise_model import Share
from heartfit.synthetic.other_worlds import OtherHeart
from heartfit.synthetic.scoring import SILENT
from heartfit.synthetic.trial import ScoredDiagnosis

OUTCOMES = ("right", "unknown", "nothing", "wrong")
"""Right: the illness named, alone or in a group, or nothing in a heart that needs no mechanism; wrong: other names."""
HEALTHY, PARAMETERS, MECHANISM = "healthy", "ill by parameters", "ill by a mechanism"


@dataclass(frozen=True, eq=False)
class Judged:
    """A heart of another simulator and its diagnosis.

    misfit: root mean square residual of the model without a mechanism, over that of the noise, by curve.
    """

    heart: OtherHeart
    finding: ScoredDiagnosis
    misfit: dict[str, float]

    @property
    def kind(self) -> str:
        """Kind of heart: one of HEALTHY, PARAMETERS and MECHANISM."""
        if self.heart.expected:
            return MECHANISM
        return PARAMETERS if self.heart.illness else HEALTHY

    @property
    def outcome(self) -> str:
        """One of OUTCOMES."""
        verdict, expected = self.finding.verdict, self.heart.expected
        if verdict in SILENT:
            return "nothing" if expected else "right"
        if verdict == "unknown":
            return "unknown"
        return "right" if self.finding.names & expected else "wrong"


def outcomes_table(judged: Sequence[Judged]) -> pd.DataFrame:
    """Return the outcomes by world and kind: counts, the share of right ones with its exact interval, and misfits."""
    groups: dict[tuple[str, str], list[Judged]] = {}
    for one in judged:
        groups.setdefault((one.heart.world, one.kind), []).append(one)
    return pd.DataFrame([_row(world, kind, group) for (world, kind), group in groups.items()])


def _row(world: str, kind: str, group: Sequence[Judged]) -> dict[str, object]:
    counts = {outcome: sum(one.outcome == outcome for one in group) for outcome in OUTCOMES}
    share = Share.from_count(counts["right"], len(group))
    misfits = {
        f"{curve} residual over noise": f"{pd.Series([one.misfit[curve] for one in group]).median():.1f}"
        for curve in group[0].misfit
    }
    interval = f"{100.0 * share.low:.0f} to {100.0 * share.high:.0f}"
    return {"world": world, "hearts": kind, "number": len(group), **counts, "right (%)": interval, **misfits}
