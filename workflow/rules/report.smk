report: "../report/workflow.rst"


SHOWN = {
    "meshes": expand("<results>/{case}/geometry/mesh.vtu", case=CASES),
    "registered": expand("<results>/{case}/registration/motion.npz", case=CASES),
    "measured": expand("<results>/{case}/curves/measured.csv", case=CASES),
    "points": [f"<results>/{case}/{setting}/calibration/points.json" for case, setting in CALIBRATED],
    "calibrated": [
        f"<results>/{case}/{setting}/verification/{file}"
        for case, setting in CALIBRATED
        for file in ("beat.json", "motion.npz", "errors.json")
    ],
    "noise": [NOISE_MODEL] if VIRTUAL else [],
    "stills": expand("<results>/figures/{case}_activation.png", case=CASES),
}


# beside the whole study, which holds the beats and the causes that it shows
rule report_study:
    input:
        whole_study(),
        printed("table1", "table2", "table3", "table3_parameters", "plausibility", "costs"),
        **POSTERIORS,
        **SHOWN,
        parts=report_parts,
    output:
        "<results>/report.html",
    log:
        "<logs>/report_study.log",
    benchmark:
        "<benchmarks>/report_study.tsv"
    resources:
        mem_mb=1500,
        runtime=10,
    params:
        results=results_folder,
        study=STUDY,
        cases=CASES,
        left_out=PLAN.left_out,
        stated=stated(STUDY, CASES),
        code=code("report_study.py"),
    script:
        "../scripts/report_study.py"
