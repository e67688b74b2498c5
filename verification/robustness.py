r"""Beats of hearts drawn at random from the prior of the paper's fourteen parameters.

Each parameter is log-normal about its declared value, :math:`\theta = \theta_0 e^{s z}` with its declared
deviation s and :math:`|z| \le 3`: a truncated normal variable, or a uniform one, which reaches the corners that a
normal one hardly ever does in fourteen dimensions.
"""

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from types import MappingProxyType

import numpy as np
import pandas as pd

from heartfit.core.arrays import Floats
from heartfit.geometry.mesh import VentricularMesh
from heartfit.heart.beat import Beat
from heartfit.heart.finite_elements.body import StepFailed, Tissue
from heartfit.heart.heart import PAPER_PARAMETERS, Heart
from heartfit.heart.simulation import Numerics, simulate
from heartfit.personalise.run import ventricles
from heartfit.personalise.setting import declaration
from verification.specimen import END_DIASTOLIC_PRESSURE, specimen

CUT = 3.0
"""Largest |z|."""

PAPER_SCALE = MappingProxyType({"sigma_0": 5.8e6, "mu": 0.3e6, "K": 12.9e6, "R_p": 1.137e8})
"""Means of the paper's Table 2, SI."""

Law = Callable[[np.random.Generator, tuple[int, int]], Floats]


def normal(rng: np.random.Generator, shape: tuple[int, int]) -> Floats:
    """Draw standard normal numbers, again while beyond the cut."""
    z = rng.standard_normal(shape)
    while (far := np.abs(z) > CUT).any():
        z[far] = rng.standard_normal(int(far.sum()))
    return z


def uniform(rng: np.random.Generator, shape: tuple[int, int]) -> Floats:
    """Draw uniform numbers up to the cut."""
    return rng.uniform(-CUT, CUT, shape)


@dataclass(frozen=True)
class Campaign:
    """Draw ``count`` hearts of an element, around the declared values or those of ``centre``, from one seed."""

    name: str
    element: str
    law: Law
    count: int
    seed: int
    centre: Mapping[str, float] = field(default_factory=dict)

    def draws(self) -> Floats:
        """z (count, 14)."""
        return self.law(np.random.default_rng(self.seed), (self.count, len(PAPER_PARAMETERS)))

    def hearts(self) -> Iterator[Heart]:
        """The hearts in the order of the draws."""
        known = [declaration(name) for name in PAPER_PARAMETERS]
        centre = np.array([self.centre.get(entry.name, entry.value) for entry in known])
        deviation = np.array([entry.sd for entry in known], dtype=float)
        for z in self.draws():
            values = dict(zip(PAPER_PARAMETERS, centre * np.exp(deviation * z), strict=True))
            yield Heart(tissue=Tissue(element=self.element)).with_parameters(values)


CAMPAIGNS = (
    Campaign("the prior", "mixed", normal, 300, 1),
    Campaign("its corners", "mixed", uniform, 100, 2),
    Campaign("the paper's scale", "p1", normal, 50, 3, PAPER_SCALE),
    Campaign("the paper's means", "p1", lambda _, shape: np.zeros(shape), 1, 0, PAPER_SCALE),
)
FAILURE = ["distribution", "draw", "reason", "farthest parameters"]
"""Columns of the table of hearts without a complete beat."""


@dataclass(frozen=True)
class Trial:
    """Outcome of one heart: its unloading, its first beat, or the reason of the failure."""

    unloaded: bool
    beat: Beat | None
    reason: str

    @property
    def completed(self) -> bool:
        """Return True if there is a beat to observe."""
        return self.beat is not None and self.beat.completed


def attempt(heart: Heart, mesh: VentricularMesh, numerics: Numerics | None = None) -> Trial:
    """Unload the ventricles and run their first beat."""
    try:
        body = ventricles(mesh, heart.muscle, END_DIASTOLIC_PRESSURE)
    except StepFailed as failure:
        return Trial(False, None, str(failure))
    beat = simulate(heart, body, numerics or Numerics(max_beats=1))
    return Trial(True, beat, beat.reason)


Say = Callable[[str], None]


def robustness_tables(
    campaigns: Sequence[Campaign] = CAMPAIGNS, say: Say = lambda _: None
) -> dict[str, pd.DataFrame]:
    """Return counts by campaign and the failures, a quarter of an hour; ``say`` receives messages of progress."""
    mesh = specimen()
    outcomes = [(campaign, _run(campaign, mesh, say)) for campaign in campaigns]
    return {
        "robustness": pd.DataFrame([_row(campaign, trials) for campaign, trials in outcomes]),
        "robustness_failures": pd.DataFrame(_failures(outcomes), columns=FAILURE),
    }


def _run(campaign: Campaign, mesh: VentricularMesh, say: Say) -> list[Trial]:
    trials = []
    for number, heart in enumerate(campaign.hearts(), start=1):
        trials.append(attempt(heart, mesh))
        say(
            f"{campaign.name}: {number} of {campaign.count}, {sum(trial.completed for trial in trials)} completed"
        )
    return trials


def _row(campaign: Campaign, trials: Sequence[Trial]) -> dict[str, str]:
    cuts = [trial.beat.diagnostics["step_cuts"] for trial in trials if trial.beat is not None]
    completed = sum(trial.completed for trial in trials)
    return {
        "distribution": campaign.name,
        "element": f"`{campaign.element}`",
        "seed": str(campaign.seed),
        "hearts": str(campaign.count),
        "unloaded": str(sum(trial.unloaded for trial in trials)),
        "completed": f"{completed} ({100 * completed / campaign.count:.1f} %)",
        "with steps cut": str(sum(cut > 0 for cut in cuts)),
        "most cuts": f"{max(cuts, default=0):.0f}",
        "EF, range": " to ".join(f"{100 * ejected:.0f} %" for ejected in _range(trials)),
        "negative cavity": str(sum(map(_inverted, trials))),
    }


def _range(trials: Sequence[Trial]) -> list[float]:
    outcomes = [_ejection_fraction(trial) for trial in trials if trial.completed]
    return [min(outcomes), max(outcomes)] if outcomes else []


def _ejection_fraction(trial: Trial) -> float:
    assert trial.beat is not None
    volume = trial.beat.volume["lv"]
    return float(1.0 - volume.min() / volume.max())


def _failures(outcomes: Sequence[tuple[Campaign, Sequence[Trial]]]) -> list[tuple[str, int, str, str]]:
    """Campaign, number of the draw, reason and farthest parameters of each heart without a complete beat."""
    return [
        (campaign.name, number, trial.reason, _far(z))
        for campaign, trials in outcomes
        for number, (trial, z) in enumerate(zip(trials, campaign.draws(), strict=True), start=1)
        if not trial.completed
    ]


def _far(z: np.ndarray) -> str:
    """The three parameters farthest from the centre."""
    farthest = np.argsort(-np.abs(z))[:3]
    return ", ".join(f"{PAPER_PARAMETERS[i]} {z[i]:+.1f} sd" for i in farthest)


def _inverted(trial: Trial) -> bool:
    return trial.completed and min(v.min() for v in trial.beat.volume.values()) < 0.0  # type: ignore[union-attr]
