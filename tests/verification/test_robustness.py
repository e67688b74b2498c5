"""Hearts drawn from the prior: their distribution, their counts, and named failures."""

import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from heartfit.heart.circulation.coupling import Tolerances
from heartfit.heart.finite_elements.body import StepFailed
from heartfit.heart.heart import PAPER_PARAMETERS
from heartfit.heart.simulation import Numerics
from heartfit.personalise.setting import declaration
from tests.printed import numbers_in
from verification import robustness
from verification import robustness as page
from verification.robustness import CAMPAIGNS, CUT, Campaign, attempt, normal, uniform
from verification.specimen import COARSE, specimen

COMMITTED = Path(__file__).parents[2] / "docs" / "robustness.md"
SPHERES = Campaign("spheres", "sphere", normal, 6, 4, {"sigma_0": 150e3})


def test_normal_draws_are_cut_and_uniform_ones_fill_the_box():
    rng = np.random.default_rng(0)
    z = normal(rng, (3000, 14))
    assert np.abs(z).max() <= CUT
    assert z.std() == pytest.approx(0.9866, abs=0.01)  # of a normal variable cut at 3
    flat = uniform(rng, (3000, 14))
    assert np.abs(flat).max() <= CUT
    assert flat.std() == pytest.approx(CUT / np.sqrt(3.0), abs=0.01)


def test_hearts_are_log_normal_about_the_centre():
    """ln(theta / theta_0) over the declared deviation is z; the mean changes only the parameters that it names."""
    campaign = CAMPAIGNS[-1]
    heart, z = next(campaign.hearts()), campaign.draws()[0]
    values = heart.parameters()
    for name, drawn in zip(PAPER_PARAMETERS, z, strict=True):
        middle = campaign.centre.get(name, declaration(name).value)
        assert np.log(values[heart.parameter_path(name)] / middle) / declaration(name).sd == pytest.approx(
            drawn
        )
    assert heart.tissue.element == "p1"


def test_the_same_seed_gives_the_same_hearts():
    assert list(SPHERES.hearts()) == list(SPHERES.hearts())
    assert list(SPHERES.hearts()) != list(replace(SPHERES, seed=5).hearts())


def test_failures_to_unload_or_fill_end_with_a_reason(monkeypatch):
    heart = next(SPHERES.hearts())
    impatient = Numerics(max_beats=1, cuts=0, tolerances=Tolerances(iterations=1))
    hopeless = attempt(heart, specimen(COARSE), impatient)
    assert (hopeless.unloaded, hopeless.completed) == (True, False)
    assert hopeless.reason.startswith("beat 1: at ")
    monkeypatch.setattr(robustness, "ventricles", too_soft)
    lost = attempt(heart, specimen(COARSE))
    assert (lost.unloaded, lost.completed, lost.reason) == (False, False, "no unloaded reference")


def too_soft(*_: object) -> None:
    raise StepFailed("no unloaded reference")


def test_the_page_counts_and_names(monkeypatch):
    monkeypatch.setattr(page, "specimen", lambda: specimen(COARSE))
    monkeypatch.setattr(page, "CAMPAIGNS", (SPHERES,))
    lines = []
    text = page.robustness_page((SPHERES,), lines.append)
    assert "| spheres | `sphere` | 4 | 6 | 6 | 6 (100.0 %) |" in text
    assert numbers_in(lines[-1]) == [6.0, 6.0, 6.0]
    assert "\n- " not in text, "no heart failed"
    assert text.rsplit("##", 1)[0].count("mL") == 0
    assert len(volumes(text)) == 2, "the beat at the centre completes"


def volumes(text):
    """Largest and least volume of both ventricles at the paper's scale, mL; none if that beat failed."""
    centre = text.split("\n## ")[-1]
    return [(float(most), float(least)) for most, least in re.findall(r"(-?\d+) to (-?\d+) mL", centre)]


def test_the_committed_page_meets_its_targets():
    """At least 99 % of the hearts of the prior complete, and so does the paper's scale; regenerate by
    `python -m verification robustness`.
    """
    text = COMMITTED.read_text()
    rows = {
        row[0]: row
        for row in re.findall(r"^\| (.*?) \| `(\w+)` \| (\d+) \| (\d+) \| .*?\((.*?) %\)", text, re.M)
    }
    assert [row[:4] for row in rows.values()] == [
        (campaign.name, campaign.element, str(campaign.seed), str(campaign.count)) for campaign in CAMPAIGNS
    ]
    assert float(rows["the prior"][4]) >= 99.0
    (left, emptied), (right, least) = volumes(text)
    assert left > emptied > 0.0
    assert right > least
