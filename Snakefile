"""The study: from measured hearts and virtual volunteers to calibrated models and their tables."""


configfile: "config/config.yaml"


include: "workflow/common.smk"


pathvars:
    results=STUDY.results,
    logs=f"{STUDY.results}/logs",
    benchmarks=f"{STUDY.results}/benchmarks",


rule all:
    default_target: True
    input:
        whole_study(),
        "<results>/tables/costs.md",
        "<results>/report.html",


include: "workflow/rules/resources.smk"
include: "workflow/rules/cohort.smk"
include: "workflow/rules/geometry.smk"
include: "workflow/rules/registration.smk"
include: "workflow/rules/registration_error.smk"
include: "workflow/rules/curves.smk"
include: "workflow/rules/calibration.smk"
include: "workflow/rules/sensitivity.smk"
include: "workflow/rules/verification.smk"
include: "workflow/rules/discovery.smk"
include: "workflow/rules/tables.smk"
include: "workflow/rules/meaning.smk"
include: "workflow/rules/alternatives.smk"
include: "workflow/rules/discovery_ventricles.smk"
include: "workflow/rules/discovery_benchmark.smk"
include: "workflow/rules/costs.smk"
include: "workflow/rules/report.smk"
