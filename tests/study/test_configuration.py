"""Bad input is refused in one line with mistake, place, expected value and advice."""

import re
from pathlib import Path

import pytest
import yaml

from heartfit.core.errors import InputError
from heartfit.core.validation import validate
from heartfit.io.configuration import read_cases, read_configuration, schema
from heartfit.io.plan import plan_study
from heartfit.io.tables import read_published
from heartfit.mechanisms.image_shrinkage import ImageShrinkage
from heartfit.mechanisms.image_smoothing import ImageSmoothing
from heartfit.mechanisms.mitral_dynamics import MitralDynamics
from heartfit.mechanisms.relaxed_friction import RelaxedFriction
from heartfit.personalise.setting import declaration
from heartfit.study.case import Case
from heartfit.study.study import Study

ROOT = Path(__file__).parents[2]
CONFIG = ROOT / "config" / "config.yaml"


@pytest.fixture
def content():
    return yaml.safe_load(CONFIG.read_text())


def complaint(kind, content):
    with pytest.raises(InputError) as refused:
        validate(kind, content, "config.yaml")
    message = str(refused.value)
    assert message.startswith("config.yaml: ")
    assert "\n" not in message
    return message


def test_the_studies_that_are_shipped_are_valid():
    for over in CONFIG.parent.glob("*.yaml"):
        validate(Study, read_configuration([CONFIG, over]), over.name)
    assert read_cases(ROOT / "config" / "cases.tsv")


def test_the_setting_filling_is_the_physical_one_with_two_mechanisms():
    study = validate(Study, read_configuration([CONFIG, CONFIG.with_name("filling.yaml")]), "filling.yaml")
    extended, physical = (study.setting(name) for name in ("filling", "physical"))
    assert extended.base_heart(0.8).mechanisms[-2:] == (MitralDynamics(), RelaxedFriction())
    assert extended.estimate == physical.estimate
    assert extended.gaussian().physical() == physical.gaussian().physical()


@pytest.mark.parametrize(
    ("path", "key", "meant"),
    [
        ((), "mseh", "mesh"),
        (("mesh",), "edge_lenght", "edge_length"),
        (("settings", "locking"), "elment", "element"),
    ],
)
def test_an_unknown_key_names_the_nearest_known_one(content, path, key, meant):
    table = content
    for step in path:
        table = table[step]
    table[key] = 1
    message = complaint(Study, content)
    assert re.search(rf"{'.'.join((*path, key))}\b.*\b{meant}\b", message)


def test_an_unknown_mechanism_to_try_names_the_nearest_known_one(content):
    content["discovery"]["trials"] = ["AtrialSurgery"]
    assert re.search(r"discovery\.trials.*'AtrialSurgery'.*AtrialSurge\b", complaint(Study, content))


def test_an_unknown_parameter_names_the_nearest_known_one(content):
    content["settings"]["physical"]["estimate"] = ["sigma0"]
    assert "sigma_0" in complaint(Study, content)


@pytest.mark.parametrize(
    ("table", "key", "value", "expected"),
    [
        ("mesh", "edge_length", 13.5, "less than 0.05"),
        ("numerics", "time_step", "five", "number"),
        ("observation", "frames", 5, "greater than or equal to 8"),
        ("end_diastolic_pressure", "lv", 120e3, "less than 5000"),
    ],
)
def test_an_invalid_number_is_refused(content, table, key, value, expected):
    content[table][key] = value
    message = complaint(Study, content)
    assert f"{table}.{key} = {value!r}" in message
    assert expected in message


def test_an_invalid_parameter_is_refused(content):
    content["settings"]["physical"]["heart"] = {"alpha": -1.0}
    assert re.search(r"alpha = -1 .*\b0\b", complaint(Study, content))


@pytest.mark.parametrize("formats", [[], ["pdf"], ["png", "png"], ["svg"]])
def test_figures_are_drawn_as_png_and_on_request_as_pdf(content, formats):
    content["figures"] = ["pdf", "png"]
    assert validate(Study, content, "config.yaml").figures == ("png", "pdf")
    content["figures"] = formats
    assert re.search(r"\bfigures\b.*'?png\b.*\bpdf\b", complaint(Study, content))


def test_a_missing_table_is_named(content):
    del content["numerics"]
    assert "numerics" in complaint(Study, content)


def test_a_parameter_is_not_both_estimated_and_fixed(content):
    content["settings"]["locking"]["heart"] = {"K": 1e6}
    assert re.search(r"\bK\b.*estimated.*fixed", complaint(Study, content))


def test_a_parameter_without_prior_is_not_estimated(content):
    content["settings"]["locking"]["estimate"] = ["k_b"]
    assert re.search(r"\bk_b\b.*\bprior\b", complaint(Study, content))


def test_a_parameter_of_either_sign_is_not_estimated(content):
    content["settings"]["locking"] |= {"mechanisms": ["ImageShrinkage"], "estimate": ["shrinkage"]}
    content["settings"]["locking"]["prior"] = {"shrinkage": {"sd": 0.3}}
    message = complaint(Study, content)
    assert re.search(r"\bshrinkage\b.*\bnegative\b", message)


def test_the_sensors_of_a_setting_have_the_parameters_of_the_beat_they_look_at(content):
    content["settings"]["physical"] |= {
        "mechanisms": ["ImageSmoothing", "MitralRegurgitation", "ImageShrinkage"],
        "estimate": ["smoothing", "sigma_0"],
        "heart": {"shrinkage": -0.05},
    }
    setting = validate(Study, content, "config.yaml").setting("physical")
    sensors = setting.sensors({"smoothing": 0.04, "sigma_0": 2e5})
    assert sensors == (ImageSmoothing(0.04), ImageShrinkage(-0.05))


def test_the_prior_of_a_setting_stands_over_the_study_s_over_the_declared_one(content):
    content["prior"] = {"mu": {"mean": 8e3}}
    content["settings"]["physical"]["prior"] = {"sigma_0": {"sd": 0.1}}
    setting = validate(Study, content, "config.yaml").setting("physical")
    assert setting.prior["mu"].mean == 8e3
    assert setting.prior["mu"].sd == declaration("mu").sd
    assert setting.prior["sigma_0"].mean == declaration("sigma_0").value
    assert setting.prior["sigma_0"].sd == 0.1


def test_the_heart_stands_at_the_mean_of_the_prior(content):
    content["settings"]["physical"]["heart"] = {"k_0": 9e4}
    content["prior"]["mu"] = {"mean": 8e3}
    heart = validate(Study, content, "config.yaml").setting("physical").base_heart(0.9)
    assert heart.period == 0.9
    assert heart.tissue.active.k_0 == 9e4
    assert heart.tissue.active.mu == pytest.approx(8e3)


def test_a_virtual_case_needs_all_its_columns():
    row = {"case": "anna", "kind": "virtual", "period": 0.9}
    assert re.search(r"\banna\b.*\bseed, edv\b", complaint(Case, row))


def test_a_patient_states_the_duration_of_depolarisation():
    row = {"case": "anna", "kind": "measured", "period": 0.9, "conduction": "lbbb"}
    assert re.search(r"\banna\b.*\bqrs_ms\b", complaint(Case, row))
    assert not Case(**row, qrs=0.15).healthy


def test_pressures_add_parameters_to_those_that_are_estimated(content):
    content["settings"]["physical"]["with_pressure"] = ["k_RS", "tau"]
    study = validate(Study, content, "config.yaml")
    without = Case(case="anna", kind="measured", period=0.9)
    catheterised = without.model_copy(update={"catheter": True})
    usual = study.setting("physical", without).estimate
    assert usual == study.setting("physical").estimate
    assert study.setting("physical", catheterised).estimate == (*usual, "k_RS", "tau")
    assert study.setting("physical", catheterised).prior["tau"].mean == declaration("tau").value
    points = [len(study.sigma_points("physical", case)) for case in (without, catheterised)]
    assert points == [2 * len(usual) + 1, 2 * len(usual) + 5]


def test_a_parameter_is_not_estimated_twice(content):
    content["settings"]["physical"]["with_pressure"] = [content["settings"]["physical"]["estimate"][0]]
    assert re.search(r"\bestimated\b.*\btwice\b", complaint(Study, content))


def test_the_hidden_parameters_scatter_as_the_published_ones():
    table = read_published(ROOT / "resources" / "marchesseau2012" / "table2.csv").set_index("parameter")
    cases = {case.case: case for case in read_cases(ROOT / "config" / "cases.tsv")}
    for ours, theirs in (("sigma_0", "sigma_0"), ("mu", "mu"), ("c_1", "K"), ("R_p", "R_p")):
        published = table.loc[theirs, list("1234567")].to_numpy(float)
        hidden = [cases[f"volunteer{number}"].hidden[ours] for number in range(1, 8)]
        assert hidden == pytest.approx(published / published.mean(), abs=6e-4)
    assert all(cases[name].hidden["sigma_0"] < 0.69 for name in ("lbbb1", "lbbb2"))
    assert cases["lbbb2"].hidden["c_1"] == 1.48


def test_cases_are_read_in_si_units(tmp_path):
    table = tmp_path / "cases.tsv"
    table.write_text("case\tkind\tperiod_s\tedv_ml\na\tmeasured\t0.9\t150\n")
    (case,) = read_cases(table)
    assert case.edv == pytest.approx(1.5e-4)


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("case\tkind\tperiod_s\na\tmeasured\t900\n", "line 2: period = 900"),
        (
            "case\tkind\tperiod_s\na\tphantom\t0.9\n",
            "line 2: kind = 'phantom'.*'measured', 'virtual' or 'sealed'",
        ),
        (
            "case\tkind\tperiod_s\na\tmeasured\tfast\n",
            "line 2: period = 'fast'",
        ),
        ("case\tkind\tperiod_s\na\tmeasured\t0.9\na\tmeasured\t0.8\n", r"\ba\b.*\brows\b"),
        ("case\tkind\tperiod_s\n", "no case"),
    ],
)
def test_a_bad_table_of_cases_is_refused(tmp_path, text, expected):
    (tmp_path / "cases.tsv").write_text(text)
    with pytest.raises(InputError, match=expected):
        read_cases(tmp_path / "cases.tsv")


def test_without_the_measured_heart_virtual_cases_remain_and_one_line_reports_it(content, tmp_path):
    content |= {"cases": str(ROOT / "config" / "cases.tsv"), "measured_heart": str(tmp_path / "nowhere")}
    plan = plan_study(content)
    assert {case.kind for case in plan.cases.values()} == {"virtual", "sealed"}
    assert "patient1" in plan.left_out
    assert str(tmp_path / "nowhere") in plan.left_out
    assert "\n" not in plan.left_out


def test_without_its_images_the_measured_heart_remains_and_one_line_reports_it(
    content, tmp_path, measured_heart_folder
):
    for part in ("control_points", "template"):
        (tmp_path / part).symlink_to((measured_heart_folder / part).resolve())
    (tmp_path / "cine").mkdir()
    timing = measured_heart_folder / "cine" / "timing.json"
    (tmp_path / "cine" / "timing.json").write_text(timing.read_text())
    content |= {"cases": str(ROOT / "config" / "cases.tsv"), "measured_heart": str(tmp_path)}
    plan = plan_study(content)
    assert "patient1" in plan.cases
    assert plan.sources["patient1"].images is None
    assert re.search(r"\bpatient1\b.*cine/sax\*", plan.left_out)
    for name in ("sax.json", "sax.nii.gz"):
        (tmp_path / "cine" / name).touch()
    plan = plan_study(content, thorough=False)
    assert plan.sources["patient1"].images == str(tmp_path / "cine" / "sax.nii.gz")
    assert plan.left_out == ""


def test_a_period_that_is_not_the_measured_one_is_refused(content, tmp_path, measured_heart_folder):
    table = tmp_path / "cases.tsv"
    content |= {"cases": str(table), "measured_heart": str(measured_heart_folder)}
    content["sensitivity"]["case"] = "a"
    table.write_text("case\tkind\tperiod_s\na\tmeasured\t0.829\n")
    assert set(plan_study(content).cases) == {"a"}
    table.write_text("case\tkind\tperiod_s\na\tmeasured\t0.90\n")
    with pytest.raises(InputError, match=r"\ba\b.*period_s.*\b0\.9\b.*\b0\.829 s"):
        plan_study(content)


def test_the_schema_is_in_step():
    assert (ROOT / "config" / "schema.json").read_text() == schema(), (
        "regenerate: heartfit configuration-schema > config/schema.json"
    )


def test_hearts_of_the_sphere_study_are_observed_by_volume_or_by_both(content):
    study = validate(Study, content, "config.yaml")
    hearts = study.known_hearts()
    assert {name: len(heart.prior.names) for name, heart in hearts.items()} == {
        "volume": 4,
        "volume and pressure": 7,
    }
    assert [len(heart.noise) for heart in hearts.values()] == [3, 6]
    assert hearts["volume"].model.cavity == study.sphere_study.cavity


def test_a_sphere_study_states_the_noise_of_every_observation(content):
    del content["sphere_study"]["noise"]["P_max"]
    with pytest.raises(InputError, match=r"\['P_max'"):
        validate(Study, content, "config.yaml")
