"""From which differences of ln evidence a verdict follows.

Measured on simulated hearts by a prototype of this search, 80 without an effect and 150 with: among 18 mechanisms the
best of those without an effect reaches ln BF 4.2 in one of twenty, so that the usual 3 of Kass and Raftery (1995) would
give a false alarm in one of nine.
"""

from dataclasses import dataclass


@dataclass(frozen=True)
class Rules:
    """Thresholds in ln evidence.

    - detected: best explanation over none, below which there is none; 5 where the model differs from the data's
      source by integrator, valves and roughness, more where its structure does (see CENTRED and STRICT).
    - suspected: the same after the first round of fits, below which there is no second.
    - switched: the amplitude with which every effect starts from the centre of the priors; from 1 a leak of 3
      is missed.
    - settled, spread: how many effects the second round takes, and how many of these start on every side once
      more, with slopes of their own.
    - rival: the best single effect over the Gaussian process alone.
    - on_top: the largest gain of a Gaussian process on top of the explanation that is named.
    - strong, strong_share: an effect over the Gaussian process by ``strong`` is named although one on top of it
      gains, if that is at most ``strong_share`` of what the effect gains: a strong effect shows a small error
      of its model.
    - second: a pair over the best single effect, which then is not the whole answer; at 3, one in twenty single
      effects is given a false companion.
    - group: effects whose evidence is so near to the best are not told apart (Kass and Raftery's "positive").
    - polished, polish: the best so many effects start again from these amplitudes before "unknown" is said.
    - partners, pairs, promising: beside how many of the best single effects a second one is tried, how many
      pairs are fitted at most, and what the linear model must promise from both over the better.
    """

    detected: float = 5.0
    suspected: float = 2.0
    switched: float = 2.0
    settled: int = 8
    spread: int = 2
    rival: float = 2.0
    on_top: float = 4.0
    strong: float = 10.0
    strong_share: float = 0.35
    second: float = 7.0
    group: float = 3.0
    polished: int = 6
    polish: tuple[float, ...] = (0.7, 3.0)
    partners: int = 4
    pairs: int = 6
    promising: float = 2.0


RULES = Rules()
CENTRED = Rules(detected=7.0)
"""For data of a 3-D heart about a model that is centred on a 3-D beat of it: of nine such hearts without an effect,
seen through images, the largest ln Bayes factors were 5.9, 5.6 and 5.0."""
STRICT = Rules(detected=10.0)
"""For a model that differs in structure from what made the data and is not centred on it."""
