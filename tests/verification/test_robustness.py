"""Hearts drawn from the prior: their distribution, their counts, and named failures."""

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
from verification.robustness import CAMPAIGNS, CUT, Campaign, attempt, normal, uniform
from verification.specimen import COARSE, specimen

STORED = Path(__file__).parents[2] / "docs" / "measured" / "robustness.tsv"
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
    campaign = CAMPAIGNS[2]
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


def test_campaigns_are_counted_and_failures_named(monkeypatch):
    monkeypatch.setattr(robustness, "specimen", lambda: specimen(COARSE))
    lines = []
    tables = robustness.robustness_tables((SPHERES,), lines.append)
    (row,) = tables["robustness"].to_dict("records")
    assert (row["distribution"], row["hearts"], row["completed"]) == ("spheres", "6", "6 (100.0 %)")
    assert row["negative cavity"] == "0"
    assert numbers_in(lines[-1]) == [6.0, 6.0, 6.0]
    assert tables["robustness_failures"].empty, "no heart failed"


def test_the_stored_table_meets_its_targets():
    """At least 99 % of the hearts of the prior complete, and so does the paper's scale at its means."""
    _, head, *rows = STORED.read_text().splitlines()
    by_name = {row.split("\t")[0]: dict(zip(head.split("\t"), row.split("\t"), strict=True)) for row in rows}
    stored = [(name, row["element"], row["seed"], row["hearts"]) for name, row in by_name.items()]
    assert stored == [(c.name, f"`{c.element}`", str(c.seed), str(c.count)) for c in CAMPAIGNS], (
        "python -m verification robustness"
    )
    assert numbers_in(by_name["the prior"]["completed"])[1] >= 99.0
    assert numbers_in(by_name["the paper's means"]["completed"])[1] == 100.0
