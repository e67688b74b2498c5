"""Sealed cases: apart from the cohort, coarse, searched under the settings of the search, and refitted by default."""

from pathlib import Path

import pytest

from heartfit.core.errors import InputError
from heartfit.io.configuration import read_cases, read_study
from heartfit.io.plan import outline
from heartfit.study.case import Case

ROOT = Path(__file__).parents[2]
CONFIG = ROOT / "config"
STUDY = read_study([CONFIG / "config.yaml"])
CASES = {case.case: case for case in read_cases(CONFIG / "cases.tsv")}


def with_discovery(**changes):
    return STUDY.model_copy(update={"discovery": STUDY.discovery.model_copy(update=changes)})


def recorded(case):
    return case.model_copy(update={"catheter": True})


def test_the_standard_study_hides_an_effect_beside_a_sound_twin():
    sealed = [case for case in CASES.values() if case.kind == "sealed"]
    hidden, sound = sealed
    assert (hidden.plant, sound.plant) == ("drawn", None)
    assert hidden.model_dump(exclude={"case", "plant"}) == sound.model_dump(exclude={"case", "plant"})
    smoke = [case for case in read_cases(CONFIG / "smoke_cases.tsv") if case.kind == "sealed"]
    assert len(smoke) == 2
    assert smoke[0].seed != hidden.seed


def test_a_sealed_case_is_calibrated_only_as_it_is_searched():
    assert STUDY.settings_of(CASES["hidden1"]) == STUDY.discovery.settings == ("physical",)
    assert STUDY.settings_of(CASES["volunteer1"]) == ("locking", "physical")


def test_a_sealed_case_has_the_coarse_mesh_throughout_and_another_one_is_generated_on():
    coarse = STUDY.discovery.coarse
    assert STUDY.calibrator(CASES["hidden1"]) == STUDY.refit_model(CASES["hidden1"]) == coarse
    assert STUDY.cohort_of(CASES["hidden1"]).mesh == STUDY.discovery.generator.mesh
    assert STUDY.cohort_of(CASES["hidden1"]).scanner == STUDY.cohort.scanner
    assert STUDY.cohort_of(CASES["volunteer1"]) is STUDY.cohort
    assert STUDY.calibrator(CASES["volunteer1"]).mesh == STUDY.virtual_mesh
    assert STUDY.calibrator(CASES["patient1"]).mesh == STUDY.mesh


def test_without_coarse_sizes_those_of_the_study_serve():
    study = with_discovery(coarse=None, generator=None)
    assert study.calibrator(CASES["hidden1"]).mesh == study.virtual_mesh
    assert study.refit_model(CASES["patient1"]).mesh == study.mesh
    assert study.cohort_of(CASES["hidden1"]) is study.cohort


def test_sealed_cases_and_recorded_pressures_are_refitted_by_default():
    assert STUDY.refitted(CASES) == [("hidden1", "physical"), ("sound1", "physical")]
    own = {"anna": recorded(CASES["patient1"]), "lbbb1": CASES["lbbb1"]}
    assert STUDY.refitted(own) == [("anna", "physical")]
    assert with_discovery(cases=("lbbb1", "absent")).refitted(own) == [("lbbb1", "physical")]
    assert with_discovery(cases=()).refitted(CASES) == []


def test_a_volunteer_hides_nothing():
    row = CASES["volunteer1"].model_dump() | {"plant": "MitralRegurgitation"}
    with pytest.raises(ValueError, match="expected kind sealed"):
        Case.model_validate(row)


def test_a_sealed_case_without_a_search_is_refused():
    content = {**read_study([CONFIG / "config.yaml"]).model_dump(exclude_unset=True)}
    content["discovery"] = {**content["discovery"], "settings": ()}
    with pytest.raises(InputError, match="hidden1 is sealed and no setting is searched"):
        outline(content)


@pytest.mark.parametrize("key", ["cases", "walls"])
def test_a_search_of_no_case_is_refused(key):
    content = {**read_study([CONFIG / "config.yaml"]).model_dump(exclude_unset=True)}
    content["discovery"] = {**content["discovery"], key: ("volunteer1", "nobody")}
    with pytest.raises(InputError, match=f"discovery.{key}: 'nobody' is no case of"):
        outline(content)


def test_walls_without_a_search_are_refused():
    content = {**read_study([CONFIG / "config.yaml"]).model_dump(exclude_unset=True)}
    content["discovery"] = {**content["discovery"], "settings": (), "walls": ("volunteer1",)}
    with pytest.raises(InputError, match=r"discovery\.walls names volunteer1 and no setting is searched"):
        outline(content)
