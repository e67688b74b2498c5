"""Benchmark of hidden effects: enough cases of every kind, on seeds not used for tuning."""

from collections import Counter
from pathlib import Path

import pytest

from heartfit.core.errors import InputError
from heartfit.core.validation import validate
from heartfit.io.configuration import read_configuration, read_study
from heartfit.study.discovery import SCORING, DiscoveryBenchmark, VentricularBenchmark
from heartfit.synthetic.campaign import plantable

CONFIG = Path(__file__).parents[2] / "config"


def plans(*files):
    study = read_study([CONFIG / file for file in files])
    return [plan for batch in study.discovery_benchmark.batches() for plan in batch]


def test_the_benchmark_plants_enough_cases_of_every_kind():
    kinds = Counter(plan.kind for plan in plans("config.yaml") if plan.population == "as searched")
    assert sum(kinds.values()) >= 300
    assert kinds["none"] >= 100
    assert kinds["single"] >= 120
    assert kinds["outside"] >= 40
    assert kinds["two"] >= 40


def test_continuous_integration_plants_forty_on_seeds_of_its_own():
    few, many = plans("config.yaml", "planted.yaml"), plans("config.yaml")
    assert len(few) >= 40
    assert not {plan.seed for plan in few} & {plan.seed for plan in many}


def test_the_benchmark_plants_a_misspecified_heart_for_each_mechanism_beside_forty_without():
    planted = plans("config.yaml")
    others = [plan for plan in planted if plan.population == "misspecified"]
    assert len(others) >= 60
    assert [plan.kind for plan in others].count("none") == 40
    assert sorted(plan.names for plan in others if plan.names) == sorted((name,) for name in plantable())
    assert {plan.scales for plan in others if plan.names} == {2.5}
    assert len({plan.seed for plan in planted}) == len(planted)


def test_misspecified_cases_change_no_batch_of_the_others():
    content = read_configuration([CONFIG / "config.yaml"])["discovery_benchmark"]
    without = content | {"misspecified": content["misspecified"] | {"nulls": 0, "singles": 0}}
    many, few = (validate(DiscoveryBenchmark, table, "here") for table in (content, without))
    assert many.batches()[: len(few.batches())] == few.batches()
    assert {plan.population for batch in few.batches() for plan in batch} == {"as searched"}
    assert many.planned() == few.planned() == sum(map(len, few.batches()))


@pytest.mark.parametrize("beyond", [-3, 0, 5])
def test_a_limit_of_cases_is_one_of_hearts_as_searched(beyond):
    content = read_configuration([CONFIG / "config.yaml"])["discovery_benchmark"]
    planned = validate(DiscoveryBenchmark, content, "here").planned()
    limited = validate(DiscoveryBenchmark, content | {"cases": planned + beyond}, "here")
    kinds = Counter(plan.population for batch in limited.batches() for plan in batch)
    assert kinds["as searched"] == planned + min(0, beyond)
    assert kinds["misspecified"] == 66


def test_seeds_of_tuning_are_refused():
    content = read_configuration([CONFIG / "config.yaml"])["discovery_benchmark"]
    tuned = content["misspecified"] | {"first_seed": SCORING - 1}
    for change in ({"first_seed": SCORING - 1}, {"misspecified": tuned}):
        with pytest.raises(InputError, match="first_seed"):
            validate(DiscoveryBenchmark, content | change, "here")


@pytest.mark.parametrize(
    "change", [{"effects": ["Nose"]}, {"outsiders": ["Nose"]}, {"pairs": [["Scar", "Nose"]]}]
)
def test_an_effect_that_cannot_be_planted_in_3d_is_refused_by_name(change):
    content = read_configuration([CONFIG / "config.yaml"])["discovery_benchmark"]["ventricles"]
    with pytest.raises(InputError, match="'Nose'"):
        validate(VentricularBenchmark, content | change, "here")
