MEASURED_CASE = {
    "measured": "<results>/{case}/curves/measured.csv",
    "noise": noise_of,
}
IMAGED_CASE = MEASURED_CASE | {
    "mesh": "<results>/{case}/geometry/mesh.vtu",
    "registered": "<results>/{case}/registration/motion.npz",
}
CALIBRATED_CASE = IMAGED_CASE | {
    "known": sequences_of_known_truth,
    "beats": calibrated_beats("beat"),
    "motions": calibrated_beats("motion"),
    "fitted": calibrated_beats("fitted"),
}
REFITTED_CASE = IMAGED_CASE | {
    "kernels": "<results>/kernels.json",
}
GIVEN = {
    "case": case_of,
    "setting": setting_of,
    "mechanisms": mechanisms_of,
    "pressures": filling_of,
    "scheme": STUDY.numerics,
    "most_steps": DISCOVERY.most_steps,
    "stated": stated(case_of, setting_of, STUDY.numerics, filling_of, DISCOVERY),
}
ASKED = {
    "question": DISCOVERY.element,
    "scheme": STUDY.numerics,
    "heart": STUDY.cohort.heart,
    "size": STUDY.virtual_mesh,
    "pressures": STUDY.end_diastolic_pressure,
    "steps": DISCOVERY.most_steps,
}


rule plot_residual:
    input:
        **CALIBRATED_CASE,
    output:
        table="<results>/{case}/discovery/{setting}/residual.csv",
        figure=pictured("residual_{case}_{setting}", "residual"),
    log:
        "<logs>/{case}/{setting}/plot_residual.log",
    benchmark:
        "<benchmarks>/{case}/{setting}/plot_residual.tsv"
    resources:
        **needs("plot_residual"),
    params:
        setting=setting_of,
        mechanisms=mechanisms_of,
        stated=stated(setting_of),
        code=code("plot_residual.py"),
    script:
        "../scripts/plot_residual.py"


rule search_cause:
    input:
        **MEASURED_CASE,
        beats=sigma_point_beats,
        kernels="<results>/kernels.json",
    output:
        cause_card("<results>/{case}/discovery/{setting}/search"),
    log:
        "<logs>/{case}/{setting}/search_cause.log",
    benchmark:
        "<benchmarks>/{case}/{setting}/search_cause.tsv"
    resources:
        **needs("search_cause"),
    params:
        case=case_of,
        setting=setting_of,
        stated=stated(case_of, setting_of),
        mechanisms=every_mechanism,
        code=code("search_cause.py"),
    script:
        "../scripts/search_cause.py"


rule refit_case:
    input:
        **REFITTED_CASE,
    output:
        expand(
            "<results>/{{case}}/discovery/{{setting}}/none/{file}",
            file=("refit.json", "beat.json", "beat.csv", "motion.npz"),
        ),
    log:
        "<logs>/{case}/{setting}/refit_case.log",
    benchmark:
        "<benchmarks>/{case}/{setting}/refit_case.tsv"
    resources:
        **needs("refit_case"),
    params:
        **GIVEN,
        code=code("refit_case.py"),
    script:
        "../scripts/refit_case.py"


rule prove_cause:
    input:
        **REFITTED_CASE,
        beats=sigma_point_beats,
        refit="<results>/{case}/discovery/{setting}/none/refit.json",
    output:
        cause_card("<results>/{case}/discovery/{setting}"),
        "<results>/{case}/discovery/{setting}/refit.json",
    log:
        "<logs>/{case}/{setting}/prove_cause.log",
    benchmark:
        "<benchmarks>/{case}/{setting}/prove_cause.tsv"
    resources:
        **needs("prove_cause"),
    params:
        **GIVEN,
        every=every_mechanism,
        code=code("prove_cause.py"),
    script:
        "../scripts/prove_cause.py"


rule try_mechanism:
    input:
        **REFITTED_CASE,
        refit="<results>/{case}/discovery/{setting}/none/refit.json",
    output:
        "<results>/{case}/discovery/{setting}/trials/{mechanism}.json",
    log:
        "<logs>/{case}/{setting}/try_mechanism_{mechanism}.log",
    benchmark:
        "<benchmarks>/{case}/{setting}/try_mechanism_{mechanism}.tsv"
    resources:
        **needs("try_mechanism"),
    params:
        **GIVEN,
        tried=mechanism_of,
        code=code("try_mechanism.py"),
    script:
        "../scripts/try_mechanism.py"


rule compare_attempts:
    input:
        expand("<results>/{{case}}/discovery/{{setting}}/trials/{mechanism}.json", mechanism=DISCOVERY.trials),
    output:
        tables=expand("<results>/tables/{{case}}_{{setting}}_trials.{suffix}", suffix=("csv", "md", "tex")),
        figure=pictured("trials_{case}_{setting}", "trials"),
    log:
        "<logs>/{case}/{setting}/compare_attempts.log",
    benchmark:
        "<benchmarks>/{case}/{setting}/compare_attempts.tsv"
    resources:
        **needs("compare_attempts"),
    params:
        code=code("compare_attempts.py"),
    script:
        "../scripts/compare_attempts.py"


rule tabulate_discovery:
    input:
        causes=[f"<results>/{case}/discovery/{setting}/cause.json" for case, setting in EVALUATED],
        before=[f"<results>/{case}/discovery/{setting}/none/refit.json" for case, setting in EVALUATED],
        after=[f"<results>/{case}/discovery/{setting}/refit.json" for case, setting in EVALUATED],
        truths=[f"<results>/{case}/cohort/truth.json" for case, _ in EVALUATED],
    output:
        expand("<results>/tables/discovery.{suffix}", suffix=("csv", "md", "tex")),
    log:
        "<logs>/tabulate_discovery.log",
    benchmark:
        "<benchmarks>/tabulate_discovery.tsv"
    resources:
        **needs("tabulate_discovery"),
    params:
        proved=EVALUATED,
        planted=[CASES[case].planted_sizes() for case, _ in EVALUATED],
        code=code("tabulate_discovery.py"),
    script:
        "../scripts/tabulate_discovery.py"


rule compare_elements:
    input:
        generator="<results>/templates/generator.vtu",
        template="<results>/templates/calibrator.vtu",
        kernels="<results>/kernels.json",
    output:
        table=printed("element"),
        figure=expand("<results>/figures/element.{suffix}", suffix=("png", "pdf")),
    log:
        "<logs>/compare_elements.log",
    benchmark:
        "<benchmarks>/compare_elements.tsv"
    resources:
        **needs("compare_elements"),
    params:
        **ASKED,
        setting=questioned,
        mechanisms=every_mechanism,
        stated=stated(questioned, ASKED),
        code=code("compare_elements.py"),
    script:
        "../scripts/compare_elements.py"
