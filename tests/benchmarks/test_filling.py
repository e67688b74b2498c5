"""Filling: normal ranges, shares of hearts within them, the kept prior, and the setting it leads to."""

import numpy as np
import pytest

from benchmarks import filling, filling_hearts
from benchmarks.filling import ROOT, measured_volume
from benchmarks.filling_hearts import (
    DECLARED,
    HEARTS,
    Kept,
    alternated_costs,
    drawn_indices,
    holds,
    kept_prior,
)
from benchmarks.filling_tables import PRINTED, Measured, Range, tables
from benchmarks.measured_table import read_table
from heartfit.calibration.plausible import Limit
from heartfit.core.parameter import parameters_of
from heartfit.heart.beat import Beat
from heartfit.io.configuration import read_cases, read_study
from heartfit.mechanisms.mitral_dynamics import MitralDynamics
from heartfit.mechanisms.relaxed_friction import RelaxedFriction
from heartfit.observation.filling import volume_indices

NORMAL = {"E/A": (0.5, 2.3), "deceleration time": (0.14, 0.22)}
INDICES = dict.fromkeys(PRINTED, 1.0) | {"E/A": 1.5, "deceleration time": 0.25, "dip": 1e-6}


def test_tables_mark_what_is_not_normal_and_count_hearts() -> None:
    ranges = [Range(name, *limits, "somewhere") for name, limits in NORMAL.items()]
    usual = INDICES | {"deceleration time": 0.18, "dip": 0.0}
    drawn = {heart: [INDICES, usual, usual, None] for heart in HEARTS}
    prior = filling_hearts.KeptPrior(
        [Kept("slowness", (1.0, 0.5), (1.5, 0.9), (1.4, 0.6), (0.1, 0.2, 0.1))], 267, 0.15
    )
    groups = {name: dict.fromkeys(HEARTS, INDICES) for name in ("sphere", "3-D")}
    costs = {"sphere": dict.fromkeys(HEARTS, 1e-3), "3-D": dict.fromkeys(HEARTS, 2.0)}
    costs["3-D"]["both"] = 3.0
    rows = {
        name: {row[0]: row[1:] for row in table.to_numpy().tolist()}
        for name, table in tables(Measured(groups, {"dip": 4e-6}, drawn, prior, costs), ranges).items()
    }
    assert rows["indices"]["deceleration time, ms"][:2] == ["140 to 220", "**250**"]
    assert rows["indices"]["E/A"][:2] == ["0.50 to 2.30", "1.50"]
    assert rows["shares"]["both"] == ["75 %", "50 %", "50 %", "25 %"]
    assert rows["costs"]["both"] == ["1.00", "1.00", "3.00", "1.50", "+6"]
    slowness = ["1.00 +- 0.50", "1.50 +- 0.90", "1.40 +- 0.60", "+0.80", "10 %, 20 %, 10 %"]
    assert rows["prior"]["slowness"] == slowness


def test_kept_draws_are_those_within_the_limits() -> None:
    values = np.array([0.0, 1.0, 2.0, 3.0, 4.0, 5.0])
    entry = Kept.from_draws("slowness", (1.0, 0.5), values, np.array([False, True, True, True, False, False]))
    assert entry.kept == pytest.approx((2.0, np.sqrt(2.0 / 3.0)))
    assert entry.shift == pytest.approx(2.0)
    assert entry.shares == (0.5, 1.0, 0.0)
    assert holds(INDICES, [Limit("E/A", 1.0, 2.0)])
    assert not holds(INDICES, [Limit("E/A", 1.0, 2.0), Limit("dip", 0.0, 0.5e-6)])
    assert not holds(None, [])
    everything = kept_prior([], 12)
    assert everything.hearts > 6
    assert [kept.parameter for kept in everything.parameters] == list(DECLARED)


def test_draws_are_the_same_for_every_heart_and_reproducible() -> None:
    first, again = drawn_indices(4), drawn_indices(4)
    assert first == again
    assert first["as it is"] != first["both"]
    assert all(len(entries) == 4 for entries in first.values())


def test_the_declared_prior_is_that_of_the_mechanisms() -> None:
    declared = {
        entry.name: entry for kind in (MitralDynamics, RelaxedFriction) for entry in parameters_of(kind)
    }
    assert DECLARED["slowness"] == (declared["slowness"].value, declared["slowness"].sd)
    assert DECLARED["ln closing rate"] == (0.0, declared["closing"].sd)
    assert DECLARED["slackening"] == (declared["slackening"].value, declared["slackening"].scale)


def test_costs_are_taken_in_turn_and_the_first_turn_does_not_count() -> None:
    turns: list[str] = []

    def run(name: str) -> Beat:
        turns.append(name)
        return Beat(np.zeros(1), {}, {}, {}, 1.0, 0.0, diagnostics={"beats": 2.0})

    costs = alternated_costs({name: lambda name=name: run(name) for name in ("off", "on")}, 2)
    assert turns == ["off", "on"] * 3
    assert set(costs) == {"off", "on"}


def test_the_setting_filling_is_the_extended_heart() -> None:
    study = read_study([ROOT / "config" / "config.yaml", ROOT / "config" / "filling.yaml"])
    extended, physical = (study.setting(name) for name in ("filling", "physical"))
    assert extended.base_heart(0.8).mechanisms[-2:] == HEARTS["both"]
    assert extended.estimate == physical.estimate
    assert extended.gaussian().physical() == physical.gaussian().physical()


def test_every_normal_range_of_filling_has_its_source() -> None:
    table = filling.read_published(filling.NORMAL_FILLING)
    assert set(table["quantity"]) <= set(PRINTED)
    assert (table["low"] < table["high"]).all()
    assert table[["source", "url", "status"]].notna().all(axis=None)


def test_the_measured_volume_has_a_dip(measured_heart_folder) -> None:
    study = read_study([ROOT / "config" / "config.yaml"])
    (case,) = (case for case in read_cases(ROOT / study.cases) if case.case == filling.CASE)
    indices = volume_indices(measured_volume(study, case))
    assert 3e-6 < indices["dip"] < 6e-6
    assert indices["E"] == pytest.approx(474e-6, rel=0.01)


def test_the_stored_shares_compare_the_four_hearts() -> None:
    """Both mechanisms bring more drawn hearts within all normal ranges; python -m benchmarks.filling MESH."""
    shares = read_table("filling_shares").set_index("heart")["all of these"]
    assert list(shares.index) == list(HEARTS)
    within = {heart: int(share.split()[0]) for heart, share in shares.items()}
    assert within["both"] > within["as it is"] > 0
