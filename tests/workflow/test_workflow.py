"""Graph of jobs: their number, their inputs, repeated jobs and refused configurations."""

import json
import re

import pytest

VOLUNTEERS, PATIENTS, SEALED, SETTINGS = 7, 2, 2, 2
POINTS_OF_COHORT = SETTINGS * (VOLUNTEERS * 9 + PATIENTS * 15) + SEALED * 15


LIST_RULES = """
import json

with open("rules.json", "w") as file:
    json.dump(
        {
            item.name: {
                "log": [str(path) for path in item.log],
                "benchmark": str(item.benchmark),
                "resources": list(item.resources),
                "params": list(item.params.keys()),
            }
            for item in workflow.rules
            if item.script
        },
        file,
    )
"""


def job_counts(output):
    table = output.rsplit("Job stats:", 1)[1]
    return {name: int(count) for name, count in re.findall(r"^(\w+) +(\d+)$", table, re.MULTILINE)}


def jobs(output):
    """Rule and the text of its job, of each job that a dry run shows."""
    return re.findall(r"^(?:local)?rule (\w+):\n((?: +.*\n)+)", output, re.MULTILINE)


def inputs(job):
    match = re.search(r"^ +input: (.*)$", job, re.MULTILINE)
    return match[1].split(", ") if match else []


def outputs(job):
    return re.search(r"^ +output: (.*)$", job, re.MULTILINE)[1].split(", ")


def readers(output, part):
    """The rules that read a file with ``part`` in its name."""
    return {rule for rule, job in jobs(output) if any(part in name for name in inputs(job))}


def test_one_job_for_each_sigma_point_and_the_truth_is_read_by_the_evaluation_only(planned):
    counts = job_counts(planned.stdout)
    assert planned.returncode == 0, planned.stdout
    assert counts["simulate_point"] == POINTS_OF_COHORT
    assert counts["simulate_calibrated"] == SETTINGS * (VOLUNTEERS + PATIENTS) + SEALED
    assert counts["generate_volunteer"] == VOLUNTEERS + PATIENTS + SEALED
    assert counts["record_pressure"] == PATIENTS + SEALED
    assert counts["make_tables"] == 1
    assert counts["compile_kernels"] == 1
    evaluation = {"make_tables", "make_cards", "compare_groups", "report_study", "tabulate_discovery"}
    assert readers(planned.stdout, "truth") == evaluation
    assert readers(planned.stdout, "effects.sealed") == {"generate_volunteer", "tabulate_discovery"}
    everybody = {"make_cards", "compare_groups", "report_study", "exchange_results"}
    assert readers(planned.stdout, "posterior_noise") == everybody
    assert readers(planned.stdout, "cohort/motion") == {"image_volunteer", "plot_septal_flash"}
    assert readers(planned.stdout, "cohort/beat") == {"record_pressure"}
    assert readers(planned.stdout, "cohort/heart") == {
        "image_volunteer",
        "build_volunteer_mesh",
        "plot_septal_flash",
    }
    assert readers(planned.stdout, "images/cine") == {"register_volunteer", "plot_contours", "plot_overlay"}
    assert readers(planned.stdout, "verification/motion") == {"plot_overlay", "plot_residual", "report_study"}
    assert counts["plot_overlay"] == PATIENTS + 1
    assert not {"draw_volunteer", "try_acquisition", "learn_noise"} & counts.keys(), (
        "the noise model is stored"
    )
    assert readers(planned.stdout, "resources/noise_model.json") >= {"extract_curves", "plot_residual"}
    assert "build_template" not in counts, "templates are stored"
    assert counts["tabulate_meshes"] == 1
    assert counts["tabulate_costs"] == counts["report_study"] == 1
    assert counts["judge_claims"] == 1
    (claims,) = (inputs(job) for rule, job in jobs(planned.stdout) if rule == "judge_claims")
    errors = sum(name.endswith("verification/errors.json") for name in claims)
    assert errors == counts["simulate_calibrated"] - SEALED
    assert "diagnose_planted" not in counts, "the search takes hours and was not requested"
    assert counts["simulate_surroundings"] == SETTINGS
    beating = {"generate_volunteer", "simulate_point", "simulate_calibrated"}
    beating |= {
        "simulate_surroundings",
        "search_cause",
        "refit_case",
        "prove_cause",
    }
    assert readers(planned.stdout, "kernels") == beating
    targets = inputs(dict(jobs(planned.stdout))["all"])
    assert sum("/beats/" in name for name in targets) == (
        counts["simulate_point"] + SETTINGS * (2 * 14 + 1)
    ), "a deleted beat would go unnoticed"


@pytest.mark.long
def test_the_full_study_adds_comparisons_of_methods_and_changes_no_other_job(workflow, planned):
    run = workflow.snakemake("-n", "--configfile", "config/full.yaml")
    assert run.returncode == 0, run.stdout
    default, full = job_counts(planned.stdout), job_counts(run.stdout)
    once = (
        "draw_sigma_points",
        "update_parameters",
        "simulate_calibrated",
        "compare_case",
        "plot_case",
        "plot_residual",
    )
    second_iteration = {"simulate_point": 9, **dict.fromkeys(once, 1)}  # of volunteer6
    added = {rule: count - default.get(rule, 0) for rule, count in full.items()}
    assert {rule: count for rule, count in added.items() if count and rule != "total"} == {
        **second_iteration,
        "compare_alternatives": 1,
        "cover_spheres": 1,
        "study_sphere": 1,
        "plot_sobol": 1,
        "draw_volunteer": 21 + 3,
        "try_acquisition": 21 + 3 + 6 * 2,
        "learn_noise": 1,
        "tabulate_registration": 1,
        "tabulate_noise": 1,
    }
    assert not default.keys() - full.keys()


def test_without_the_measured_heart_the_virtual_cases_run_and_one_line_reports_it(planned):
    assert planned.returncode == 0, planned.stdout
    assert "build_measured_mesh" not in job_counts(planned.stdout)
    assert job_counts(planned.stdout)["simulate_point"] == POINTS_OF_COHORT
    lines = [line for line in planned.stdout.splitlines() if "left out" in line]
    assert len(lines) == 1
    assert "measured_heart" in lines[0]


def test_a_run_says_at_its_end_too_what_it_left_out(drawing):
    _, _, run = drawing
    start, end = (place for place, line in enumerate(run.stdout.splitlines()) if "patient1 left out" in line)
    (last_step,) = (place for place, line in enumerate(run.stdout.splitlines()) if "(100%) done" in line)
    assert start < last_step < end


def test_numbers_are_checked_on_request(workflow, planned):
    assert "check_numbers" not in job_counts(planned.stdout)
    run = workflow.snakemake("-n", "check_numbers", "--configfile", "config/smoke.yaml")
    assert job_counts(run.stdout)["check_numbers"] == job_counts(run.stdout)["make_tables"] == 1
    job = dict(jobs(run.stdout))["check_numbers"]
    read = inputs(job)
    tables = [f"results/smoke/tables/{name}.md" for name in ("table1", "claims", "discovery", "selection")]
    assert [table for table in tables if table not in read] == []
    assert any(text.startswith("resources/reference/smoke/") for text in read)


def test_a_figure_is_drawn_as_pdf_on_request_only(workflow, planned):
    card = "results/figures/volunteer5_physical_card"
    run = workflow.snakemake("-n", f"{card}.pdf", "--config", "figures=[png, pdf]")
    (drawn,) = (outputs(job) for rule, job in jobs(run.stdout) if rule == "make_cards")
    assert {f"{card}.png", f"{card}.pdf"} <= {*drawn}
    (drawn,) = (outputs(job) for rule, job in jobs(planned.stdout) if rule == "make_cards")
    assert f"{card}.png" in drawn
    assert ".pdf" not in planned.stdout


def test_the_measured_heart_is_one_more_case(workflow, measured_heart_folder):
    workflow.link_measured_heart(measured_heart_folder)
    workflow.keep_cases("patient1", "volunteer5")
    run = workflow.snakemake("-n")
    counts = job_counts(run.stdout)
    assert run.returncode == 0, run.stdout
    assert counts["build_measured_mesh"] == counts["register_measured"] == 1
    assert counts["register_cine"] == counts["compare_cine"] == 1
    assert "left out" not in run.stdout
    assert counts["simulate_point"] == 2 * SETTINGS * 9
    assert counts["simulate_calibrated"] == 2 * SETTINGS
    assert counts["simulate_surroundings"] == SETTINGS


def test_a_spoilt_measured_heart_is_refused_in_one_line_before_anything_runs(workflow):
    workflow.add_spoilt_heart()
    run = workflow.snakemake("--cores", "1")
    assert run.returncode != 0
    assert len([line for line in run.stdout.splitlines() if "resources/measured_heart" in line]) == 1
    assert "Traceback" not in run.stdout
    assert not (workflow.folder / "results").exists()


def test_an_edit_of_the_library_repeats_only_the_jobs_that_import_it(drawn):
    workflow, points = drawn
    with workflow.edited("src/heartfit/geometry/carry.py", "# elsewhere\n"):
        assert "Nothing to be done" in workflow.snakemake("-n", points).stdout
    with workflow.edited("src/heartfit/calibration/gaussian.py", "# below\n"):
        assert job_counts(workflow.snakemake("-n", points).stdout)["draw_sigma_points"] == 1


def test_an_edit_of_the_configuration_repeats_only_the_jobs_it_concerns(drawn):
    workflow, points = drawn
    elsewhere, here = "observation: {window: 5}\n", "prior: {sigma_0: {mean: 2.9e+5}}\n"
    for text, expected in ((elsewhere, "Nothing to be done"), (here, "draw_sigma_points")):
        (workflow.folder / "config" / "other.yaml").write_text(text)
        assert expected in workflow.snakemake("-n", "--configfile", "config/other.yaml", "--", points).stdout


def test_every_job_has_a_log_a_benchmark_resources_and_a_code_fingerprint(workflow):
    workflow.edit("Snakefile", LIST_RULES)
    run = workflow.snakemake("--list")
    assert run.returncode == 0, run.stdout
    rules = json.loads((workflow.folder / "rules.json").read_text())
    paths = {name: item["benchmark"] for name, item in rules.items()}
    assert [item["log"] for item in rules.values()] == [
        [path.replace("results/benchmarks/", "results/logs/").replace(".tsv", ".log")]
        for path in paths.values()
    ]
    assert not [name for name, item in rules.items() if not {"mem_mb", "runtime"} <= {*item["resources"]}]
    assert [name for name, item in rules.items() if "code" not in item["params"]] == ["fetch_measured_heart"]
    expected = {
        "compile_kernels": "compile_kernels",
        "build_template": "templates/{template}",
        "build_measured_mesh": "{case}/build_mesh",
        "simulate_point": "{case}/{setting}/simulate_point_{point}",
        "simulate_surroundings": "sensitivity/{setting}/simulate_surroundings",
        "try_acquisition": "registration_error/{acquisition}/try_{number}",
        "try_mechanism": "{case}/{setting}/try_mechanism_{mechanism}",
        "diagnose_planted": "discovery_benchmark/diagnose_planted_{batch}",
    }
    without_constraints = {name: re.sub(r",[^}]*", "", paths[name]) for name in expected}
    assert without_constraints == {name: f"results/benchmarks/{path}.tsv" for name, path in expected.items()}


def test_a_rule_without_measured_costs_is_refused_in_one_line(workflow):
    costs = workflow.folder / "resources" / "costs.tsv"
    lines = costs.read_text().splitlines(keepends=True)
    costs.write_text("".join(line for line in lines if not line.startswith("plot_case\t")))
    run = workflow.snakemake("-n")
    assert run.returncode != 0
    refusal = "costs.tsv: no job plot_case; expected its measured costs: state mem_mb and runtime in the rule"
    assert len([line for line in run.stdout.splitlines() if refusal in line]) == 1
    assert "Traceback" not in run.stdout


def test_no_input_is_ancient(workflow):
    """Snakemake does not recheck a job after an ancient input is to be made: its stale beats would stay."""
    rules = "".join(path.read_text() for path in (workflow.folder / "workflow" / "rules").glob("*.smk"))
    assert "kernels.json" in rules
    assert "ancient(" not in rules


@pytest.mark.parametrize(
    ("file", "text", "expected"),
    [
        ("config/config.yaml", "mehs: 1\n", "unknown key mehs; did you mean mesh?"),
        ("config/cases.tsv", "x\tvirtual\t0.9" + 14 * "\t" + "\n", "x is virtual and lacks seed"),
    ],
)
def test_bad_input_is_refused_in_one_line_before_anything_runs(workflow, file, text, expected):
    workflow.edit(file, text)
    run = workflow.snakemake("--cores", "1")
    assert run.returncode != 0
    assert len([line for line in run.stdout.splitlines() if expected in line]) == 1
    assert "Traceback" not in run.stdout
    assert not (workflow.folder / "results").exists()


def test_a_proof_reads_the_search_and_none_of_its_beats(workflow):
    proof = "results/lbbb1/discovery/physical/cause.json"
    run = workflow.snakemake("-n", "--", proof)
    assert run.returncode == 0, run.stdout
    assert job_counts(run.stdout)["search_cause"] == 1
    assert (
        readers(run.stdout, "/search/cause.json")
        == readers(run.stdout, "/search/traces.json")
        == {"prove_cause"}
    )
    (read,) = (inputs(job) for rule, job in jobs(run.stdout) if rule == "prove_cause")
    assert not [name for name in read if "/beats/" in name]


def test_answers_are_read_by_the_scorer_only(workflow):
    targets = "discovery_benchmark", "check_discovery"
    run = workflow.snakemake(
        "-n", *targets, "--config", "discovery_benchmark={cases: 8, misspecified: {nulls: 4}}"
    )
    counts = job_counts(run.stdout)
    assert run.returncode == 0, run.stdout
    assert readers(run.stdout, "/sealed/") == {*targets, "discovery_ventricles", "check_ventricles"}
    assert readers(run.stdout, "/measured/") == {"diagnose_planted", "diagnose_ventricles"}
    assert counts["plant_effects"] == counts["diagnose_planted"] == 2 + 8, (
        "batches of four, of both populations"
    )
    assert counts["plant_ventricles"] == counts["diagnose_ventricles"] == 35
