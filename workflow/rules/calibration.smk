rule draw_sigma_points:
    output:
        "<results>/{case}/{setting}/calibration/points.json",
    log:
        "<logs>/{case}/{setting}/draw_sigma_points.log",
    benchmark:
        "<benchmarks>/{case}/{setting}/draw_sigma_points.tsv"
    resources:
        **needs("draw_sigma_points"),
    params:
        setting=setting_of,
        transform=STUDY.unscented,
        stated=stated(setting_of, STUDY.unscented),
        code=code("draw_sigma_points.py"),
    script:
        "../scripts/draw_sigma_points.py"


rule simulate_point:
    input:
        mesh="<results>/{case}/geometry/mesh.vtu",
        points="<results>/{case}/{setting}/calibration/points.json",
        kernels="<results>/kernels.json",
    output:
        beat="<results>/{case}/{setting}/calibration/beats/{point}.json",
        curves="<results>/{case}/{setting}/calibration/beats/{point}.csv",
    log:
        "<logs>/{case}/{setting}/simulate_point_{point}.log",
    benchmark:
        "<benchmarks>/{case}/{setting}/simulate_point_{point}.tsv"
    resources:
        **needs("simulate_point"),
    params:
        case=case_of,
        setting=setting_of,
        pressures=filling_of,
        scheme=STUDY.numerics,
        mechanisms=mechanisms_of,
        stated=stated(case_of, setting_of, STUDY.numerics, filling_of),
        code=code("simulate_point.py"),
    script:
        "../scripts/simulate_point.py"


rule update_parameters:
    input:
        points="<results>/{case}/{setting}/calibration/points.json",
        measured="<results>/{case}/curves/measured.csv",
        observations="<results>/{case}/curves/observations.json",
        beats=sigma_point_beats,
        sensitivity="<results>/sensitivity/{setting}/sensitivity.json",
    output:
        multiext("<results>/{case}/{setting}/calibration/posterior", met=".json", weighed="_noise.json"),
    log:
        "<logs>/{case}/{setting}/update_parameters.log",
    benchmark:
        "<benchmarks>/{case}/{setting}/update_parameters.tsv"
    resources:
        **needs("update_parameters"),
    params:
        setting=setting_of,
        mechanisms=mechanisms_of,
        operator=STUDY.observation,
        transform=STUDY.unscented,
        stated=stated(setting_of, STUDY.unscented, STUDY.observation),
        code=code("update_parameters.py"),
    script:
        "../scripts/update_parameters.py"
