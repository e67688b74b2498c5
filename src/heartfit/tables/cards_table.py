"""What the data say of each parameter of each case, and how often the intervals hold the truth."""

from collections.abc import Callable, Sequence

import numpy as np
import pandas as pd

from heartfit.calibration.gaussian import Gaussian
from heartfit.observation.coverage import Share
from heartfit.tables.card import Card

POSTERIORS: dict[str, Callable[[Card], Gaussian]] = {
    "observations met": lambda card: card.met.estimate,
    "noise and fixed": lambda card: card.weighed.estimate,
}
"""The two posteriors as the tables name them."""

ALL = "all"


def cards_table(cards: Sequence[Card]) -> pd.DataFrame:
    """One row per case, setting and parameter; places are in prior standard deviations from the prior's mean.

    "seen" is the share of the prior's variance that the data took away, of the direction's best and least seen in
    "rank" and "least seen"; "covered" whether the 95 % interval holds the truth, blank where there is none.
    """
    return pd.DataFrame([row for card in cards for row in _rows(card)])


def coverage_table(cards: Sequence[Card]) -> pd.DataFrame:
    """How many truths lie in their 95 % intervals, per setting, posterior and parameter, and of all parameters.

    Every heart is one trial of the exact interval, of which the share of its parameters is covered: the errors of one
    heart's parameters are not independent.
    """
    rows = [
        {"setting": setting, "posterior": posterior} | row
        for setting in dict.fromkeys(card.setting for card in cards)
        for posterior, estimate in POSTERIORS.items()
        for row in _shares([card.covered(estimate(card)) for card in cards if card.setting == setting])
    ]
    return pd.DataFrame(rows)


def _rows(card: Card) -> list[dict[str, object]]:
    seen, met, weighed = card.seen, card.met.estimate, card.weighed.estimate
    covered = {name: card.covered(estimate(card)) for name, estimate in POSTERIORS.items()}
    common = {
        "rank": f"{seen.rank} of {len(seen.names)}",
        "effective number": seen.degrees,
        "least seen": f"{card.weakest()} ({100 * seen.reduction[-1]:.0f} %)",
    }
    return [
        {
            "setting": card.setting,
            "case": card.case,
            "parameter": name,
            "prior sd (%)": 100 * card.prior.sd[i],
            "met": card.place(met)[i],
            "met sd over prior": met.sd[i] / card.prior.sd[i],
            "weighed": card.place(weighed)[i],
            "weighed sd over prior": seen.sd_ratio[i],
            "seen": 1.0 - seen.sd_ratio[i] ** 2,
            "truth": card.true_place()[i],
            "met covered": _answer(covered["observations met"].get(name)),
            "weighed covered": _answer(covered["noise and fixed"].get(name)),
        }
        | common
        for i, name in enumerate(card.prior.names)
    ]


def _answer(covered: bool | None) -> str:
    return "" if covered is None else "yes" if covered else "no"


def _shares(held: Sequence[dict[str, bool]]) -> list[dict[str, object]]:
    names = dict.fromkeys(name for each in held for name in each)
    by_name = {name: [float(each[name]) for each in held if name in each] for name in names}
    pooled = {ALL: [float(np.mean(list(each.values()))) for each in held if each]}
    return [_share(name, values) for name, values in (by_name | pooled).items() if values]


def _share(name: str, values: Sequence[float]) -> dict[str, object]:
    share = Share.of(sum(values), len(values))
    return {
        "parameter": name,
        "hearts": share.sequences,
        "covered (%)": 100 * share.covered,
        "from (%)": 100 * share.low,
        "to (%)": 100 * share.high,
    }
