SENSITIVITY = STUDY.sensitivity
REFERENCE = CASES[SENSITIVITY.case]
REFERENCE_MESH = f"<results>/{SENSITIVITY.case}/geometry/mesh.vtu"
SPHERE = STUDY.sphere()


use rule draw_sigma_points as draw_surroundings with:
    output:
        "<results>/sensitivity/{setting}/points.json",
    log:
        "<logs>/sensitivity/{setting}/draw_surroundings.log",
    benchmark:
        "<benchmarks>/sensitivity/{setting}/draw_surroundings.tsv"
    params:
        setting=surroundings_of,
        transform=SENSITIVITY,
        stated=stated(surroundings_of, SENSITIVITY),


use rule simulate_point as simulate_surrounding with:
    input:
        mesh=REFERENCE_MESH,
        points="<results>/sensitivity/{setting}/points.json",
        kernels="<results>/kernels.json",
    output:
        beat="<results>/sensitivity/{setting}/beats/{point}.json",
        curves="<results>/sensitivity/{setting}/beats/{point}.csv",
    log:
        "<logs>/sensitivity/{setting}/simulate_surrounding_{point}.log",
    benchmark:
        "<benchmarks>/sensitivity/{setting}/simulate_surrounding_{point}.tsv"
    params:
        case=REFERENCE,
        setting=surroundings_of,
        pressures=STUDY.filling(REFERENCE),
        stated=stated(REFERENCE, surroundings_of, STUDY.numerics, STUDY.filling(REFERENCE)),


rule analyse_sensitivity:
    input:
        points="<results>/sensitivity/{setting}/points.json",
        beats=surrounding_beats,
        limits="resources/plausible_beat.csv",
    output:
        sensitivity="<results>/sensitivity/{setting}/sensitivity.json",
        ranges="<results>/sensitivity/{setting}/ranges.json",
    log:
        "<logs>/sensitivity/{setting}/analyse_sensitivity.log",
    benchmark:
        "<benchmarks>/sensitivity/{setting}/analyse_sensitivity.tsv"
    resources:
        **needs("analyse_sensitivity"),
    params:
        setting=surroundings_of,
        study=SENSITIVITY,
        operator=STUDY.observation,
        stated=stated(surroundings_of, SENSITIVITY, STUDY.observation),
        code=code("analyse_sensitivity.py"),
    script:
        "../scripts/analyse_sensitivity.py"


rule study_sphere:
    input:
        mesh=REFERENCE_MESH,
        kernels="<results>/kernels.json",
    output:
        "<results>/sensitivity/sobol.json",
    log:
        "<logs>/sensitivity/study_sphere.log",
    benchmark:
        "<benchmarks>/sensitivity/study_sphere.tsv"
    resources:
        **needs("study_sphere"),
    params:
        case=REFERENCE,
        setting=SPHERE,
        sphere=SENSITIVITY.sphere,
        pressures=STUDY.end_diastolic_pressure,
        operator=STUDY.observation,
        scheme=STUDY.numerics,
        stated=stated(REFERENCE, SPHERE, SENSITIVITY.sphere, STUDY.numerics, STUDY.observation),
        code=code("study_sphere.py"),
    script:
        "../scripts/study_sphere.py"


rule plot_surroundings:
    input:
        points="<results>/sensitivity/{setting}/points.json",
        beats=surrounding_beats,
        sensitivity="<results>/sensitivity/{setting}/sensitivity.json",
    output:
        curves=pictured("sensitivity_curves_{setting}", "surroundings", "Parameters"),
        figure=pictured("sensitivity_{setting}", "surroundings", "Parameters"),
        table=expand("<results>/tables/sensitivity_{{setting}}.{suffix}", suffix=("csv", "md", "tex")),
    log:
        "<logs>/sensitivity/{setting}/plot_surroundings.log",
    benchmark:
        "<benchmarks>/sensitivity/{setting}/plot_surroundings.tsv"
    resources:
        **needs("plot_surroundings"),
    params:
        setting=surroundings_of,
        study=SENSITIVITY,
        code=code("plot_surroundings.py"),
    script:
        "../scripts/plot_surroundings.py"


rule tabulate_selection:
    input:
        found=expand("<results>/sensitivity/{setting}/sensitivity.json", setting=SETTINGS),
        ranges=expand("<results>/sensitivity/{setting}/ranges.json", setting=SETTINGS),
        sobol="<results>/sensitivity/sobol.json",
    output:
        selection=printed("selection"),
        prior=printed("prior"),
        sobol=printed("sobol"),
        bulk_modulus=printed("bulk_modulus"),
        figure=pictured("sobol", "sobol", "Parameters"),
    log:
        "<logs>/sensitivity/tabulate_selection.log",
    benchmark:
        "<benchmarks>/sensitivity/tabulate_selection.tsv"
    resources:
        **needs("tabulate_selection"),
    params:
        settings=SETTINGS,
        estimated=STUDY.estimated(),
        units=SPHERE.units(),
        code=code("tabulate_selection.py"),
    script:
        "../scripts/tabulate_selection.py"
