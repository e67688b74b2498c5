CALIBRATED = [(case, setting) for case in CASES for setting in SETTINGS]
POSTERIORS = {
    "met": [f"<results>/{case}/{setting}/calibration/posterior.json" for case, setting in CALIBRATED],
    "weighed": [
        f"<results>/{case}/{setting}/calibration/posterior_noise.json" for case, setting in CALIBRATED
    ],
    "truths": expand("<results>/{case}/cohort/truth.json", case=GROUPS.virtual),
}

EXCHANGED = {
    "measured": expand(
        "<results>/{case}/curves/{file}", case=CASES, file=("measured.csv", "observations.json")
    ),
    "calibrated": [
        f"<results>/{case}/{setting}/verification/{file}"
        for case, setting in CALIBRATED
        for file in ("beat.json", "beat.csv", "errors.json")
    ],
}


rule make_cards:
    input:
        **POSTERIORS,
    output:
        tabulated("cards", "coverage_cohort"),
        [f"<results>/figures/{name}" for name in CASE_PICTURES if "_card." in name],
    log:
        "<logs>/make_cards.log",
    benchmark:
        "<benchmarks>/make_cards.tsv"
    resources:
        **needs("make_cards"),
    params:
        results=results_folder,
        calibrated=CALIBRATED,
        groups=GROUPS,
        stated=stated(GROUPS),
        code=code("make_cards.py"),
    script:
        "../scripts/make_cards.py"


rule compare_groups:
    input:
        **POSTERIORS,
    output:
        tabulated("specificity", "claims"),
        pictured("specificity", "specificity", "Cohort"),
    log:
        "<logs>/compare_groups.log",
    benchmark:
        "<benchmarks>/compare_groups.tsv"
    resources:
        **needs("compare_groups"),
    params:
        results=results_folder,
        calibrated=CALIBRATED,
        groups=GROUPS,
        stated=stated(GROUPS),
        code=code("compare_groups.py"),
    script:
        "../scripts/compare_groups.py"


rule exchange_results:
    input:
        **EXCHANGED,
        met=POSTERIORS["met"],
        weighed=POSTERIORS["weighed"],
    output:
        [f"<results>/{case}/{setting}/inference.nc" for case, setting in CALIBRATED],
        tables=expand("<results>/tables/{name}.csv", name=("posteriors", "curves")),
    log:
        "<logs>/exchange_results.log",
    benchmark:
        "<benchmarks>/exchange_results.tsv"
    resources:
        mem_mb=1000,
        runtime=5,
    params:
        results=results_folder,
        calibrated=CALIBRATED,
        code=code("exchange_results.py"),
    script:
        "../scripts/exchange_results.py"


rule check_numbers:
    input:
        numbers="<results>/tables/numbers.csv",
        tolerances=STUDY.tolerances,
    output:
        "<results>/tables/drift.csv",
    log:
        "<logs>/check_numbers.log",
    benchmark:
        "<benchmarks>/check_numbers.tsv"
    resources:
        **needs("check_numbers"),
    params:
        code=code("check_numbers.py"),
    script:
        "../scripts/check_numbers.py"
