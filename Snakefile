"""Workflow from measured and virtual hearts to calibrated models, missing mechanisms, tables and figures."""


configfile: "config/config.yaml"


include: "workflow/common/study.smk"
include: "workflow/common/files.smk"
include: "workflow/common/jobs.smk"


pathvars:
    results=STUDY.results,
    logs=f"{STUDY.results}/logs",
    benchmarks=f"{STUDY.results}/benchmarks",


rule all:
    default_target: True
    input:
        tables=study_tables(),
        inference=inference_data(),
        figures=study_figures(),
        beats=study_beats(),
        causes=study_causes(),
        costs="<results>/tables/costs.md",
        report="<results>/report.html",


# Further targets, made only on request:
#   fetch_measured_heart   download the fit of patient1 as published into resources/bivme_patient1
#   discover               search and refit the cases of `discovery.cases`; config/measured_heart.yaml has the measured heart
#   check_numbers          compare the tables with the stored ones of resources/reference
#   discovery_benchmark    diagnose planted effects in spheres and in ventricles, score the diagnoses, write the pages
#   check_discovery        compare these scores with the claims of config/discovery_claims.tsv
#   discovery_ventricles   score the diagnoses of ventricles alone; check_ventricles compares them with their claims
#   warped_cine            warp the measured cine by a simulation, register it back and compare: studies/calibration/deviations.md
#   compare_elements       test whether linear tetrahedra explain the misfit of a heart on a finer mesh


# the data flow
include: "workflow/rules/geometry.smk"
include: "workflow/rules/registration.smk"
include: "workflow/rules/curves.smk"
include: "workflow/rules/calibration.smk"
include: "workflow/rules/verification.smk"
include: "workflow/rules/discovery.smk"
include: "workflow/rules/tables.smk"
include: "workflow/rules/figures.smk"
include: "workflow/rules/report.smk"
# beside it: virtual hearts of known truth, and the limits of calibration and discovery
include: "workflow/rules/cohort.smk"
include: "workflow/rules/sensitivity.smk"
include: "workflow/rules/registration_error.smk"
include: "workflow/rules/warped_cine.smk"
include: "workflow/rules/discovery_benchmark.smk"


complete_rules(workflow.rules)
