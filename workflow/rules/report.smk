report: "../report/workflow.rst"


# reads the benchmarks of all jobs; the results of the study as input are a shorter list with the same effect
rule tabulate_costs:
    input:
        study_results(),
    output:
        reported_tables("costs"),
        figure=figure_files("costs", "costs", "Cohort"),
    params:
        results=results_folder,
    script:
        "../scripts/tabulate_costs.py"


REPORTED_FILES = {
    "meshes": expand("<results>/{case}/geometry/mesh.vtu", case=CASES),
    "registered": expand("<results>/{case}/registration/motion.npz", case=CASES),
    "measured": expand("<results>/{case}/curves/measured.csv", case=CASES),
    "points": [f"<results>/{case}/{setting}/calibration/points.json" for case, setting in CALIBRATIONS],
    "calibrated": [
        f"<results>/{case}/{setting}/verification/{file}"
        for case, setting in CALIBRATIONS
        for file in ("beat.json", "motion.npz", "errors.json")
    ],
    "noise": [NOISE_MODEL] if VIRTUAL else [],
    "stills": expand("<results>/figures/{case}_activation.png", case=CASES),
}


# the results of the study include the beats and the cause cards that the report shows
rule report_study:
    input:
        study_results(),
        table_files(*TITLES),
        **POSTERIORS_AND_TRUTHS,
        **REPORTED_FILES,
        parts=report_templates,
    output:
        "<results>/report.html",
    resources:
        mem_mb=1500,
        runtime=10,
    params:
        results=results_folder,
        study=STUDY,
        cases=CASES,
        left_out=PLAN.left_out,
        stated=configuration_text(STUDY, CASES),
    script:
        "../scripts/report_study.py"
