ORIGIN = Origin(
    STUDY.results,
    GROUPS,
    {name: case.period for name, case in CASES.items()},
    {name: case.seed for name, case in CASES.items()},
)


rule make_tables:
    input:
        cases=expand(
            "<results>/{case}/{setting}/verification/errors.json",
            case=CASES,
            setting=SETTINGS,
        ),
        truths=expand("<results>/{case}/cohort/truth.json", case=GROUPS.virtual),
        paper=expand("resources/marchesseau2012/{name}.csv", name=("table1", "table2", "patients")),
    output:
        tabulated("table1", "table2", "table3", "table3_parameters", "plausibility"),
        numbers="<results>/tables/numbers.csv",
    log:
        "<logs>/make_tables.log",
    benchmark:
        "<benchmarks>/make_tables.tsv"
    resources:
        **needs("make_tables"),
    params:
        origin=ORIGIN,
        stated=stated(ORIGIN),
        code=code("make_tables.py"),
    script:
        "../scripts/make_tables.py"


rule plot_case:
    input:
        measured="<results>/{case}/curves/measured.csv",
        reference="<results>/{case}/{setting}/calibration/beats/0.json",
        calibrated="<results>/{case}/{setting}/verification/beat.json",
        errors="<results>/{case}/{setting}/verification/errors.json",
    output:
        pictured("{case}_{setting}", "curves"),
    log:
        "<logs>/{case}/{setting}/plot_case.log",
    benchmark:
        "<benchmarks>/{case}/{setting}/plot_case.tsv"
    resources:
        **needs("plot_case"),
    params:
        setting=setting_of,
        mechanisms=mechanisms_of,
        operator=STUDY.observation,
        stated=stated(setting_of, STUDY.observation),
        code=code("plot_case.py"),
    script:
        "../scripts/plot_case.py"


rule plot_sensitivity:
    input:
        "<results>/{case}/{setting}/calibration/posterior.json",
    output:
        pictured("{case}_{setting}_sensitivity", "sensitivity"),
    log:
        "<logs>/{case}/{setting}/plot_sensitivity.log",
    benchmark:
        "<benchmarks>/{case}/{setting}/plot_sensitivity.tsv"
    resources:
        **needs("plot_sensitivity"),
    params:
        code=code("plot_sensitivity.py"),
    script:
        "../scripts/plot_sensitivity.py"


rule compare_shape:
    input:
        mesh="<results>/{case}/geometry/mesh.vtu",
        motion="<results>/{case}/registration/motion.npz",
        calibrated="<results>/{case}/{setting}/verification/shape.csv",
    output:
        table=expand("<results>/tables/{{case}}_{{setting}}_shape.{suffix}", suffix=("csv", "md", "tex")),
        figure=pictured("{case}_{setting}_shape", "shape"),
    log:
        "<logs>/{case}/{setting}/compare_shape.log",
    benchmark:
        "<benchmarks>/{case}/{setting}/compare_shape.tsv"
    resources:
        **needs("compare_shape"),
    params:
        code=code("compare_shape.py"),
    script:
        "../scripts/compare_shape.py"


rule plot_contours:
    input:
        mesh="<results>/{case}/geometry/mesh.vtu",
        motion="<results>/{case}/registration/motion.npz",
        images="<results>/{case}/images/cine.nrrd",
    output:
        figure=pictured("{case}_contours", "contours"),
        animation="<results>/figures/{case}_beat.gif",
    log:
        "<logs>/{case}/plot_contours.log",
    benchmark:
        "<benchmarks>/{case}/plot_contours.tsv"
    wildcard_constraints:
        case=one_of(VIRTUAL + IMAGED),
    resources:
        **needs("plot_contours"),
    params:
        code=code("plot_contours.py"),
    script:
        "../scripts/plot_contours.py"


rule plot_overlay:
    input:
        mesh="<results>/{case}/geometry/mesh.vtu",
        registered="<results>/{case}/registration/motion.npz",
        calibrated="<results>/{case}/{setting}/verification/motion.npz",
        images="<results>/{case}/images/cine.nrrd",
    output:
        pictured("{case}_{setting}_overlay", "overlay"),
    log:
        "<logs>/{case}/{setting}/plot_overlay.log",
    benchmark:
        "<benchmarks>/{case}/{setting}/plot_overlay.tsv"
    wildcard_constraints:
        case=one_of(VIRTUAL + IMAGED),
    resources:
        **needs("plot_overlay"),
    params:
        code=code("plot_overlay.py"),
    script:
        "../scripts/plot_overlay.py"


rule plot_activation:
    input:
        "<results>/{case}/geometry/mesh.vtu",
    output:
        pictured("{case}_activation", "activation"),
    log:
        "<logs>/{case}/plot_activation.log",
    benchmark:
        "<benchmarks>/{case}/plot_activation.tsv"
    resources:
        **needs("plot_activation"),
    params:
        case=case_of,
        stated=stated(case_of),
        code=code("plot_activation.py"),
    script:
        "../scripts/plot_activation.py"


rule plot_septal_flash:
    input:
        hearts=expand("<results>/{case}/cohort/heart.vtu", case=DYSSYNCHRONY),
        true=expand("<results>/{case}/cohort/motion.npz", case=DYSSYNCHRONY),
        meshes=expand("<results>/{case}/geometry/mesh.vtu", case=DYSSYNCHRONY),
        registered=expand("<results>/{case}/registration/motion.npz", case=DYSSYNCHRONY),
        calibrated=shapes_of(DYSSYNCHRONY),
    output:
        table=expand("<results>/tables/septal_flash.{suffix}", suffix=("csv", "md", "tex")),
        figure=pictured("septal_flash", "septal_flash", "Cohort"),
    log:
        "<logs>/plot_septal_flash.log",
    benchmark:
        "<benchmarks>/plot_septal_flash.tsv"
    resources:
        **needs("plot_septal_flash"),
    params:
        cases=DYSSYNCHRONY,
        settings=SETTINGS,
        code=code("plot_septal_flash.py"),
    script:
        "../scripts/plot_septal_flash.py"
