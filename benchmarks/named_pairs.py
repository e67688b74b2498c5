"""Rules for a pair beside the Gaussian process: python -m benchmarks.named_pairs choose [N], then score [N]

Hearts of the benchmark's generator on seeds that nothing else uses. Each is searched once by half of its samples; its
evidences are kept, so that every rule decides on the same ones, and the other half judges the name. Stores
docs/measured/named_pairs_*.tsv after each of the first N. A quarter of a minute of a core for each heart.

The rule was to be chosen so: of those that give no more wrong names than the rule for single effects alone did, the one
with the most right names; of equals the one with the larger margin. A name is wrong if a sound heart or an effect from
outside the library has it, or if it is not that of the planted effect or effects.
"""

import sys
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from math import inf

import numpy as np
import pandas as pd

from benchmarks.in_turn import searched_in_turn, spread_evenly
from benchmarks.measured_table import store_table
from heartfit.discovery.inference.decide import (
    DEFAULT_RULES,
    Decision,
    Effects,
    Evidences,
    Rules,
    decide,
    is_explained,
    leading_effects,
)
from heartfit.discovery.sphere_model.diagnose import predict_explanation
from heartfit.discovery.sphere_model.recording import Recording
from heartfit.discovery.sphere_model.searched_recording import SearchedRecording
from heartfit.observation.noise_model import Share
from heartfit.synthetic.campaign import PlantedPlan, plantable
from heartfit.synthetic.case import REST, plant
from heartfit.synthetic.out_of_library import OUT_OF_LIBRARY


@dataclass(frozen=True)
class Hearts:
    """Hearts of consecutive seeds: sound ones, singles and pairs of drawn names, and effects from outside the library.

    scales: sizes; of pairs by turns, of effects from outside once each.
    """

    first_seed: int
    nulls: int
    singles: int
    pairs: int
    single_scales: float
    pair_scales: tuple[float, ...]
    outside_scales: tuple[float, ...]

    def plans(self) -> list[PlantedPlan]:
        """Return the plans, each kind spread evenly, so that a stopped run has the same share of each."""
        rng, library = np.random.default_rng(self.first_seed), sorted(plantable())
        single = rng.choice(library, self.singles, replace=False).tolist()
        pairs = [tuple(rng.choice(library, 2, replace=False).tolist()) for _ in range(self.pairs)]
        sizes = self.pair_scales * len(pairs)
        groups = [
            [PlantedPlan(0, "none")] * self.nulls,
            [PlantedPlan(0, "single", (name,), self.single_scales) for name in single],
            [PlantedPlan(0, "two", names, size) for names, size in zip(pairs, sizes, strict=False)],
            [
                PlantedPlan(0, "outside", (kind.__name__,), size)
                for size in self.outside_scales
                for kind in OUT_OF_LIBRARY
            ],
        ]
        return [replace(plan, seed=seed) for seed, plan in enumerate(spread_evenly(groups), self.first_seed)]


HEARTS = {
    "choose": Hearts(700000, 4, 12, 20, 3.0, (2.5, 4.0), (2.0, 3.0, 4.0)),
    "score": Hearts(710000, 4, 6, 12, 3.0, (2.5, 4.0), (3.0, 4.0)),
}


@dataclass(frozen=True)
class Candidate:
    """A rule: of single effects, of pairs, and whether the best single effect stands in for a pair without a name."""

    singles: Rules
    pairs: Rules
    single_instead: bool = False

    def decide(self, evidences: Evidences) -> Decision:
        """Return the decision of this rule."""
        leading = leading_effects(evidences)
        rules = self.pairs if leading in evidences.pairs else self.singles
        if self.single_instead and not is_explained(evidences, leading, rules):
            return decide(replace(evidences, pairs={}), self.singles)
        return decide(evidences, rules)


def _same(margin: float, single_instead: bool = False) -> Candidate:
    rules = replace(DEFAULT_RULES, over_discrepancy=margin)
    return Candidate(rules, rules, single_instead)


WITHOUT_STRONG = replace(DEFAULT_RULES, strong=inf)
CANDIDATES = {
    "single effects by 2, pairs by none": Candidate(
        DEFAULT_RULES, replace(DEFAULT_RULES, over_discrepancy=-inf, strong=inf)
    ),
    "both by -2": _same(-2.0),
    "both by 0": _same(0.0),
    "both by 2": _same(2.0),
    "both by 2, else the best single effect": _same(2.0, single_instead=True),
    "both by 2, at most 4 left beside either": Candidate(WITHOUT_STRONG, WITHOUT_STRONG),
    "both by 10": _same(10.0),
}
"""Rules by the margin over the process that they demand; the first is the one before."""


@dataclass(frozen=True)
class SearchedHeart:
    """Evidences of a heart without its answer's use, and what of the best the other half of the samples confirms."""

    plan: PlantedPlan
    evidences: Evidences
    helps: Mapping[Effects, bool]

    def names(self, rule: Candidate) -> Effects:
        """Return the names that the rule gives and the other half confirms; a group has none."""
        decision = rule.decide(self.evidences)
        named = decision.verdict in ("named", "two") and self.helps[decision.effects]
        return decision.effects if named else ()

    def right(self, rule: Candidate) -> bool:
        """Return whether exactly the planted mechanisms of the library are named."""
        planted = self.plan.names if self.plan.kind in ("single", "two") else ()
        return bool(planted) and set(self.names(rule)) == set(planted)

    def wrong(self, rule: Candidate) -> bool:
        """Return whether a name is given that was not planted; one of two is incomplete, not wrong."""
        planted = self.plan.names if self.plan.kind in ("single", "two") else ()
        return not set(self.names(rule)) <= set(planted)


def searched(plan: PlantedPlan) -> SearchedHeart:
    """Search a planted heart by half of its samples, and judge its best explanations by the other half."""
    first, unseen = Recording.from_curves(plant(plan).curves[REST]).halves()
    case = SearchedRecording.search(first, unseen=unseen)
    evidences = case.findings.evidences
    best = [effects for effects in (evidences.single, evidences.pair) if effects]
    tests = {effects: predict_explanation(case, effects, {}) for effects in best}
    helps = {
        effects: all(test and test.helps() for test in predictions) for effects, predictions in tests.items()
    }
    return SearchedHeart(plan, evidences, helps)


def hearts_table(hearts: Sequence[SearchedHeart]) -> pd.DataFrame:
    """Return one row for each heart: ln Bayes factors of the leading explanations, and the names by each rule."""
    return pd.DataFrame(list(map(_row, hearts)))


def _row(heart: SearchedHeart) -> dict[str, str]:
    evidences = heart.evidences
    single, pair = (
        f"{' + '.join(effects)} {evidences.log_evidence(effects) - evidences.baseline:.1f}, "
        f"{evidences.on_top[effects] - evidences.log_evidence(effects):.1f}, "
        f"{'yes' if heart.helps[effects] else 'no'}"
        if effects
        else ""
        for effects in (evidences.single, evidences.pair)
    )
    named = {rule: " + ".join(heart.names(candidate)) for rule, candidate in CANDIDATES.items()}
    return {
        "seed": str(heart.plan.seed),
        "hidden": " + ".join(heart.plan.names) or "nothing",
        "scales": f"{heart.plan.scales:g}",
        "process": f"{evidences.discrepancy - evidences.baseline:.1f}",
        "best single effect: factor, left beside it, confirmed": single,
        "best pair": pair,
        "named before": named["single effects by 2, pairs by none"],
        "named by 2": named["both by 2"],
    }


def rates_table(hearts: Sequence[SearchedHeart]) -> pd.DataFrame:
    """Return the right and wrong names of each rule, with exact 95 % intervals [%] of the wrong ones of all hearts."""
    return pd.DataFrame([_rates(name, rule, hearts) for name, rule in CANDIDATES.items()])


def _rates(name: str, rule: Candidate, hearts: Sequence[SearchedHeart]) -> dict[str, str]:
    def count(kind: str, right: bool) -> str:
        outcomes = [
            heart.right(rule) if right else heart.wrong(rule) for heart in hearts if heart.plan.kind == kind
        ]
        if not outcomes:
            return ""
        share = Share.from_count(float(sum(outcomes)), len(outcomes))
        return f"{sum(outcomes)} of {len(outcomes)} ({100.0 * share.low:.0f} to {100.0 * share.high:.0f} %)"

    return {
        "margin over the process": name,
        "pairs: right": count("two", right=True),
        "pairs: wrong": count("two", right=False),
        "single effects: right": count("single", right=True),
        "single effects: wrong": count("single", right=False),
        "outside the library: named": count("outside", right=False),
        "sound: named": count("none", right=False),
    }


def main(arguments: list[str]) -> int:
    """Search the first hearts of a purpose and store their tables."""
    purpose, *first = arguments or [""]
    if purpose not in HEARTS or len(first) > 1:
        sys.stderr.write(f"{__doc__}\n")
        return 2
    plans = HEARTS[purpose].plans()[: int(first[0]) if first else None]
    for hearts in searched_in_turn(searched, plans, hearts_table):
        store(purpose, hearts)
    return 0


def store(purpose: str, hearts: Sequence[SearchedHeart]) -> None:
    """Write the tables of the first hearts of a purpose."""
    made_by = f"benchmarks.named_pairs {purpose} {len(hearts)}"
    store_table(f"named_pairs_{purpose}_hearts", hearts_table(hearts), made_by)
    store_table(f"named_pairs_{purpose}", rates_table(hearts), made_by)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
