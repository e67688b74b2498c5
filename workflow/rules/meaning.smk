CALIBRATED = [(case, setting) for case in CASES for setting in SETTINGS]
POSTERIORS = {
    "met": [f"<results>/{case}/{setting}/calibration/posterior.json" for case, setting in CALIBRATED],
    "weighed": [
        f"<results>/{case}/{setting}/calibration/posterior_noise.json" for case, setting in CALIBRATED
    ],
    "truths": expand("<results>/{case}/cohort/truth.json", case=GROUPS.virtual),
}


rule make_cards:
    input:
        **POSTERIORS,
    output:
        printed("cards", "coverage_cohort"),
        [f"<results>/figures/{name}" for name in CASE_PICTURES if "_card." in name],
    log:
        "<logs>/make_cards.log",
    benchmark:
        "<benchmarks>/make_cards.tsv"
    resources:
        mem_mb=1000,
        runtime=5,
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
        printed("specificity", "claims"),
        expand("<results>/figures/specificity.{suffix}", suffix=("png", "pdf")),
    log:
        "<logs>/compare_groups.log",
    benchmark:
        "<benchmarks>/compare_groups.tsv"
    resources:
        mem_mb=1000,
        runtime=5,
    params:
        results=results_folder,
        calibrated=CALIBRATED,
        groups=GROUPS,
        stated=stated(GROUPS),
        code=code("compare_groups.py"),
    script:
        "../scripts/compare_groups.py"


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
        mem_mb=500,
        runtime=5,
    params:
        code=code("check_numbers.py"),
    script:
        "../scripts/check_numbers.py"
