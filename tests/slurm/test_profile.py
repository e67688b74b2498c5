"""The profile for SLURM names existing rules and options."""

import re
import tomllib
from pathlib import Path

import yaml

ROOT = Path(__file__).parents[2]
PROFILE = yaml.safe_load((ROOT / "profiles" / "slurm" / "config.yaml").read_text())


def rules():
    text = "".join(file.read_text() for file in (ROOT / "workflow" / "rules").glob("*.smk"))
    return set(re.findall(r"^(?:use )?rule (?:\w+ as )?(\w+)", text, re.MULTILINE))


def test_every_rule_that_is_grouped_exists():
    assert set(PROFILE["groups"]) <= rules()
    assert set(PROFILE["group-components"]) <= set(PROFILE["groups"].values())


def test_all_beats_are_grouped():
    assert {"simulate_point", "simulate_surroundings", "simulate_calibrated", "draw_volunteer"} <= set(
        PROFILE["groups"]
    )


def test_status_comes_from_squeue_and_lost_jobs_are_repeated_by_snakemake():
    assert PROFILE["slurm-status-command"] == "squeue"
    assert PROFILE["slurm-no-requeue"]
    assert PROFILE["retries"] >= 2


def test_the_lock_holds_the_group_of_dependencies():
    group = tomllib.loads((ROOT / "pyproject.toml").read_text())["dependency-groups"]["slurm"]
    locked = (ROOT / "profiles" / "slurm" / "requirements.lock").read_text()
    assert {re.match(r"[\w-]+", wanted)[0] for wanted in group} == set(
        re.findall(r"^([\w-]+)==", locked, re.M)
    )
    assert "://" not in locked
