"""Benchmark of hidden effects: enough cases of every kind, on seeds not used for tuning."""

from collections import Counter
from pathlib import Path

import pytest

from heartfit.core.errors import InputError
from heartfit.core.validation import validate
from heartfit.io.configuration import read_configuration, read_study
from heartfit.study.discovery import SCORING, DiscoveryBenchmark, VentricularBenchmark

CONFIG = Path(__file__).parents[2] / "config"


def plans(*files):
    study = read_study([CONFIG / file for file in files])
    return [plan for batch in study.discovery_benchmark.batches() for plan in batch]


def test_the_benchmark_plants_enough_cases_of_every_kind():
    kinds = Counter(plan.kind for plan in plans("config.yaml"))
    assert sum(kinds.values()) >= 300
    assert kinds["none"] >= 100
    assert kinds["single"] >= 120
    assert kinds["outside"] >= 40
    assert kinds["two"] >= 40


def test_continuous_integration_plants_forty_on_seeds_of_its_own():
    few, many = plans("config.yaml", "planted.yaml"), plans("config.yaml")
    assert len(few) >= 40
    assert not {plan.seed for plan in few} & {plan.seed for plan in many}


def test_seeds_of_tuning_are_refused():
    content = read_configuration([CONFIG / "config.yaml"])["discovery_benchmark"]
    with pytest.raises(InputError, match="first_seed"):
        validate(DiscoveryBenchmark, content | {"first_seed": SCORING - 1}, "here")


@pytest.mark.parametrize(
    "change", [{"effects": ["Nose"]}, {"outsiders": ["Nose"]}, {"pairs": [["Scar", "Nose"]]}]
)
def test_an_effect_that_cannot_be_planted_in_3d_is_refused_by_name(change):
    content = read_configuration([CONFIG / "config.yaml"])["discovery_benchmark"]["ventricles"]
    with pytest.raises(InputError, match="'Nose'"):
        validate(VentricularBenchmark, content | change, "here")
