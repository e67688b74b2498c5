"""Plan of a study: cases that can be run, their data, and all mistakes before the first job."""

import pytest
import yaml

from heartfit.core.errors import InputErrors
from heartfit.io.plan import outline, plan_study

ROOT_CONFIG = "config/config.yaml"
HEADER = "case\tkind\tperiod_s\tconduction\tqrs_ms\tcatheter\n"


@pytest.fixture
def content(tmp_path, request):
    study = yaml.safe_load((request.config.rootpath / ROOT_CONFIG).read_text())
    study |= {"cases": str(tmp_path / "cases.tsv"), "measured_heart": None}
    study["sensitivity"]["case"] = "heart1"
    study["settings"] |= {"locking": None}
    return study


def cases(tmp_path, *rows):
    (tmp_path / "cases.tsv").write_text(HEADER + "".join(f"{row}\n" for row in rows))


def problems(content, read=outline):
    with pytest.raises(InputErrors) as refused:
        read(content)
    return refused.value.problems


def test_measured_hearts_alone_are_a_study_and_a_recording_makes_seven_parameters(content, tmp_path):
    cases(tmp_path, "heart1\tmeasured\t0.83\thealthy\t\t", "heart2\tmeasured\t0.9\tlbbb\t150\t")
    content["sources"] = {
        "heart1": {"fit": "one"},
        "heart2": {"fit": "two", "pressure": {"file": "p.csv", "unit": "kPa"}},
    }
    plan = outline(content)
    assert list(plan.study.settings) == ["physical"]
    assert {name: source.fit for name, source in plan.sources.items()} == {"heart1": "one", "heart2": "two"}
    assert [len(plan.study.setting("physical", case).estimate) for case in plan.cases.values()] == [4, 7]


def test_contradictions_between_table_and_sources_are_refused(content, tmp_path):
    cases(tmp_path, "heart1\tmeasured\t0.83\thealthy\t\ttrue")
    content["sources"] = {"heart1": {"fit": "one"}, "heart_1": {"fit": "two"}}
    stranger, silent = problems(content)
    assert [part for part in ("sources.heart_1", "heart1") if part not in stranger] == []
    assert silent.startswith("heart1: ")
    assert [part for part in ("catheter", "pressure") if part not in silent] == []


def test_the_mistakes_of_all_rows_are_kept(content, tmp_path):
    cases(tmp_path, "heart1\tmeasured\t830\thealthy\t\t", "heart2\tmeasured\t0.9\tlbbb\t\t")
    first, second = problems(content)
    assert "line 2: period = 830" in first
    assert [part for part in ("line 3", "heart2", "qrs") if part not in second] == []


def test_the_mistakes_in_the_data_of_all_cases_are_kept(content, tmp_path):
    cases(tmp_path, "heart1\tmeasured\t0.83\thealthy\t\t", "heart2\tmeasured\t0.9\thealthy\t\t")
    pressure = {"file": str(tmp_path / "none.csv"), "unit": "kPa"}
    content["sources"] = {
        "heart1": {"fit": str(tmp_path / "nowhere"), "pressure": pressure},
        "heart2": {"fit": str(tmp_path), "images": str(tmp_path / "cine.nrrd")},
    }
    mistakes = problems(content, plan_study)
    assert [line.split(":")[0] for line in mistakes] == ["heart1", "heart1", "heart2", "heart2"]
    assert "none.csv" in mistakes[1]


@pytest.mark.parametrize("results", ["../results", "/tmp/results", "a/../../b", ""])
def test_results_stay_within_the_working_directory(content, tmp_path, results):
    cases(tmp_path, "heart1\tmeasured\t0.83\thealthy\t\t")
    content["results"] = results
    assert "is not within the working directory" in problems(content)[0]
