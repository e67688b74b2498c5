"""The hidden heart of a virtual volunteer.

It differs from the calibrator's model on purpose, as a real heart does: valves obey Bernoulli's law instead
of a conductance, the number of bridges depends on length, the trigger comes earlier, and parameters that nobody
estimates are not at their standard values either. Where the left bundle is blocked, the wave runs through the wall at
other speeds, although it takes as long.
"""

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np

from heartfit.circulation.network import Circulation
from heartfit.circulation.valves import OrificeValve
from heartfit.electrophysiology.conduction import HEALTHY, LBBB
from heartfit.heart import FOURTEEN, Heart
from heartfit.mechanism import Mechanism

ESTIMATED = ("sigma_0", "mu", "c_1", "R_p")
OTHERS = ("k_RS", "k_ATP", "k_0", "alpha", "tau", "Z_c", "L")
ESTIMATED_SPREAD, OTHER_SPREAD = 0.15, 0.08
"""Standard deviations of the logarithms: healthy adults scatter, but not to the edges of the prior."""

VALVES = Circulation(
    mitral=OrificeValve(area=5e-4),
    aortic=OrificeValve(area=4e-4),
    tricuspid=OrificeValve(area=6e-4),
    pulmonary=OrificeValve(area=4e-4),
)
OTHER_MODEL = {"slope": 0.3, "trigger_delay": 0.03}
OTHER_CONDUCTIONS = {"healthy": HEALTHY, "lbbb": replace(LBBB, speed=0.5, ratio=0.5)}


def draw_heart(standard: Mapping[str, float], period: float, seed: int) -> tuple[Heart, dict[str, float]]:
    """A heart scattered about the ``standard`` values, and the truth: its value of the paper's parameters."""
    return _scattered(standard, period, seed, dict.fromkeys(ESTIMATED, ESTIMATED_SPREAD))


def hide_heart(
    standard: Mapping[str, float],
    ratios: Mapping[str, float],
    period: float,
    seed: int,
    planted: Sequence[Mechanism] = (),
) -> tuple[Heart, dict[str, float]]:
    """A heart whose estimated parameters are these ``ratios`` of the ``standard`` values; the others scatter.

    planted: what it has and the calibrator's model lacks.
    """
    values = Heart().with_parameters(standard)
    given = {name: values.parameters()[values.path_of(name)] * ratio for name, ratio in ratios.items()}
    heart, truth = _scattered({**standard, **given}, period, seed, {})
    for each in planted:
        heart = heart + each
    return heart, truth


def _scattered(
    standard: Mapping[str, float], period: float, seed: int, spreads: Mapping[str, float]
) -> tuple[Heart, dict[str, float]]:
    rng = np.random.default_rng(seed)
    heart = Heart(circulation=VALVES, period=period).with_parameters({**standard, **OTHER_MODEL})
    values = heart.parameters()
    drawn = {
        name: values[heart.path_of(name)] * float(np.exp(spread * rng.standard_normal()))
        for name, spread in {**spreads, **dict.fromkeys(OTHERS, OTHER_SPREAD)}.items()
    }
    heart = heart.with_parameters(drawn)
    return heart, {name: heart.parameters()[heart.path_of(name)] for name in FOURTEEN}
