"""The page of robustness, in Markdown: how many hearts of the prior beat, and what stops the others."""

from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np

from heartfit.geometry.mesh import VentricularMesh
from heartfit.heart import FOURTEEN
from heartfit.verification.robustness import CAMPAIGNS, Campaign, Trial, attempt
from heartfit.verification.specimen import specimen

HEADER = """# Robustness

Hearts drawn at random from the prior of the paper's fourteen parameters, all at once: each is unloaded from
1.30 / 0.52 kPa on {tets} tetrahedra of parametric ventricles and beats once, at 5 ms. "The prior" is the declared
log-normal one, cut at 3 standard deviations; "its corners" are uniform over those 6 deviations in each of the fourteen;
"the paper's scale" has the means of its Table 2 for sigma_0, mu, K and R_p, and linear tetrahedra. This page is written
by `heartfit robustness`.

| draws about | element | seed | hearts | unloaded | completed | with steps cut | most cuts | EF, least to largest |
|---|---|---|---|---|---|---|---|---|
"""

CENTRE = """
## At the paper's scale

sigma_0 = 5.8 MPa, mu = 0.3 MPa.s, K = 12.9 MPa, R_p = 113.7 MPa.s/m^3 on linear tetrahedra, everything else as
declared: {text}
"""

ENDED = "\n## What ended otherwise\n\n"
COLLAPSED = """
{count} of the completed beats, {where}, empty a cavity below zero: no contact keeps opposite walls apart.
"""

Say = Callable[[str], None]


def robustness_page(campaigns: Sequence[Campaign] = CAMPAIGNS, say: Say = lambda _: None) -> str:
    """The page; a quarter of an hour. ``say`` is told how far it is."""
    mesh = specimen()
    found = [(campaign, _run(campaign, mesh, say)) for campaign in campaigns]
    table = "".join(_row(campaign, trials) for campaign, trials in found)
    text = HEADER.format(tets=len(mesh.tets)) + table + _failures(found) + _collapsed(found)
    return text + CENTRE.format(text=_summary(_centre(mesh)))


def _run(campaign: Campaign, mesh: VentricularMesh, say: Say) -> list[Trial]:
    trials = []
    for number, heart in enumerate(campaign.hearts(), start=1):
        trials.append(attempt(heart, mesh))
        say(
            f"{campaign.name}: {number} of {campaign.count}, {sum(trial.completed for trial in trials)} completed"
        )
    return trials


def _row(campaign: Campaign, trials: Sequence[Trial]) -> str:
    beats = [trial.beat for trial in trials if trial.beat is not None]
    cuts = [beat.diagnostics["step_cuts"] for beat in beats]
    done = sum(trial.completed for trial in trials)
    cells = (
        campaign.name,
        f"`{campaign.element}`",
        campaign.seed,
        campaign.count,
        sum(trial.unloaded for trial in trials),
        f"{done} ({100 * done / campaign.count:.1f} %)",
        sum(cut > 0 for cut in cuts),
        f"{max(cuts, default=0):.0f}",
        " to ".join(f"{100 * ejected:.0f} %" for ejected in _range(trials)),
    )
    return f"| {' | '.join(map(str, cells))} |\n"


def _range(trials: Sequence[Trial]) -> list[float]:
    found = [_ejection_fraction(trial) for trial in trials if trial.completed]
    return [min(found), max(found)] if found else []


def _ejection_fraction(trial: Trial) -> float:
    assert trial.beat is not None
    volume = trial.beat.volume["lv"]
    return float(1.0 - volume.min() / volume.max())


def _failures(found: Sequence[tuple[Campaign, Sequence[Trial]]]) -> str:
    lines = [
        f"- {campaign.name}, draw {number}: {trial.reason} ({_far(z)})\n"
        for campaign, trials in found
        for number, (trial, z) in enumerate(zip(trials, campaign.draws(), strict=True), start=1)
        if not trial.completed
    ]
    return ENDED + "".join(lines or ["Nothing.\n"])


def _far(z: np.ndarray) -> str:
    """The three parameters farthest from the centre."""
    farthest = np.argsort(-np.abs(z))[:3]
    return ", ".join(f"{FOURTEEN[i]} {z[i]:+.1f} sd" for i in farthest)


def _collapsed(found: Sequence[tuple[Campaign, Sequence[Trial]]]) -> str:
    counts = {campaign.name: sum(map(_inverted, trials)) for campaign, trials in found}
    where = ", ".join(f"{count} of {name}" for name, count in counts.items() if count)
    return COLLAPSED.format(count=sum(counts.values()), where=where) if where else ""


def _inverted(trial: Trial) -> bool:
    return trial.completed and min(v.min() for v in trial.beat.volume.values()) < 0.0  # type: ignore[union-attr]


def _centre(mesh: VentricularMesh) -> Trial:
    campaign = replace(CAMPAIGNS[-1], count=1, law=lambda _, shape: np.zeros(shape))
    return attempt(next(campaign.hearts()), mesh)


def _summary(trial: Trial) -> str:
    if trial.beat is None or not trial.completed:
        return f"failed, {trial.reason}."
    volumes = [f"{1e6 * v.max():.0f} to {1e6 * v.min():.0f} mL" for v in trial.beat.volume.values()]
    cuts = trial.beat.diagnostics["step_cuts"]
    return f"the beat completes with {cuts:.0f} steps cut; left ventricle {volumes[0]}, right ventricle {volumes[1]}."
