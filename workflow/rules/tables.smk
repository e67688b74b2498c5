ORIGIN = Origin(
    STUDY.results,
    GROUPS,
    {name: case.period for name, case in CASES.items()},
    {name: case.seed for name, case in CASES.items()},
)


rule make_tables:
    input:
        cases=[f"<results>/{case}/{setting}/verification/errors.json" for case, setting in CALIBRATIONS],
        truths=TRUTHS,
        paper=expand("resources/marchesseau2012/{name}.csv", name=("table1", "table2", "patients")),
    output:
        reported_tables("table1", "table2", "table3", "table3_parameters", "plausibility"),
        reported_tables("table1_as_printed", "table2_as_printed"),
        numbers="<results>/tables/numbers.csv",
    params:
        origin=ORIGIN,
        planted_ratios=STUDY.cohort.planted_ratios,
        stated=configuration_text(ORIGIN),
    script:
        "../scripts/make_tables.py"


rule make_cards:
    input:
        **POSTERIORS_AND_TRUTHS,
    output:
        reported_tables("cards", "coverage_cohort"),
        figures=[f"<results>/figures/{name}" for name in CASE_FIGURES if "_card." in name],
    params:
        results=results_folder,
        calibrated=CALIBRATIONS,
        groups=GROUPS,
        colours=COLOURS,
        stated=configuration_text(GROUPS),
    script:
        "../scripts/make_cards.py"


rule compare_groups:
    input:
        **COMMON_POSTERIORS,
        truths=TRUTHS,
        claims="resources/marchesseau2012/claims.tsv",
    output:
        reported_tables("specificity", "specificity_claims"),
        figure=figure_files("specificity", "specificity", "Cohort"),
    params:
        results=results_folder,
        calibrated=COMMON_CALIBRATIONS,
        groups=GROUPS,
        stated=configuration_text(GROUPS),
    script:
        "../scripts/compare_groups.py"


# reads the benchmarks of the calibrations; that they ran is stated by their errors
rule judge_claims:
    input:
        claims="resources/marchesseau2012/claims.tsv",
        cases=[
            f"<results>/{case}/{setting}/verification/errors.json" for case, setting in COMMON_CALIBRATIONS
        ],
        sensitivities=expand("<results>/sensitivity/{setting}/sensitivity.json", setting=PERTURBED_SETTINGS),
        selection=["<results>/tables/selection.csv"] if VIRTUAL else [],
        noise=[NOISE_MODEL] if VIRTUAL else [],
    output:
        reported_tables("claims"),
    resources:
        mem_mb=1000,
        runtime=2,
    params:
        results=results_folder,
        settings=PERTURBED_SETTINGS,
        groups=GROUPS,
        planted_ratios=STUDY.cohort.planted_ratios,
        stated=configuration_text(GROUPS),
    script:
        "../scripts/judge_claims.py"


rule tabulate_meshes:
    input:
        list(MESHES.values()),
    output:
        "<results>/tables/meshes.csv",
    resources:
        mem_mb=500,
        runtime=2,
    params:
        names=list(MESHES),
    script:
        "../scripts/tabulate_meshes.py"


EXCHANGED_FILES = {
    "measured": expand(
        "<results>/{case}/curves/{file}", case=CASES, file=("measured.csv", "observations.json")
    ),
    "calibrated": [
        f"<results>/{case}/{setting}/verification/{file}"
        for case, setting in CALIBRATIONS
        for file in ("beat.json", "beat.csv", "errors.json")
    ],
}


rule exchange_results:
    input:
        **EXCHANGED_FILES,
        **POSTERIORS,
    output:
        inference_data(),
        tables=expand("<results>/tables/{name}.csv", name=("posteriors", "curves")),
    resources:
        mem_mb=1000,
        runtime=5,
    params:
        results=results_folder,
        calibrated=CALIBRATIONS,
    script:
        "../scripts/exchange_results.py"


CHECK_PARAMS = {
    "tables": tables_folder,
    "reference": STUDY.reference,
    "left_out": PLAN.left_out,
}


# reads all tables; the results of the study as input have the same effect
rule check_numbers:
    input:
        study_results(),
        stored_tables,
    output:
        table="<results>/tables/drift.csv",
        line="<results>/tables/agreement.txt",
    resources:
        mem_mb=500,
        runtime=2,
    params:
        **CHECK_PARAMS,
    script:
        "../scripts/check_numbers.py"


# the same check of the tables that `discover` makes
use rule check_numbers as check_discovered with:
    input:
        [f"<results>/tables/{case}_{setting}_extension.csv" for case, setting in REFITTED],
        ["<results>/tables/discovery.csv"] if REFITTED else [],
        "<results>/tables/meshes.csv",
        stored_tables,
