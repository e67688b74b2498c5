rule simulate_calibrated:
    input:
        mesh="<results>/{case}/geometry/mesh.vtu",
        registered="<results>/{case}/registration/motion.npz",
        posterior="<results>/{case}/{setting}/calibration/posterior.json",
        kernels="<results>/kernels.json",
    output:
        verified("beat.json", "beat.csv", "shape.csv", "motion.npz"),
    log:
        "<logs>/{case}/{setting}/simulate_calibrated.log",
    benchmark:
        "<benchmarks>/{case}/{setting}/simulate_calibrated.tsv"
    resources:
        **needs("simulate_calibrated"),
    params:
        case=case_of,
        setting=setting_of,
        pressures=filling_of,
        scheme=STUDY.numerics,
        mechanisms=mechanisms_of,
        stated=stated(case_of, setting_of, STUDY.numerics, filling_of),
        code=code("simulate_calibrated.py"),
    script:
        "../scripts/simulate_calibrated.py"


rule compare_case:
    input:
        posterior="<results>/{case}/{setting}/calibration/posterior.json",
        observations="<results>/{case}/curves/observations.json",
        measured="<results>/{case}/curves/measured.csv",
        reference="<results>/{case}/{setting}/calibration/beats/0.json",
        calibrated="<results>/{case}/{setting}/verification/beat.json",
    output:
        "<results>/{case}/{setting}/verification/errors.json",
    log:
        "<logs>/{case}/{setting}/compare_case.log",
    benchmark:
        "<benchmarks>/{case}/{setting}/compare_case.tsv"
    resources:
        **needs("compare_case"),
    params:
        setting=setting_of,
        mechanisms=mechanisms_of,
        operator=STUDY.observation,
        stated=stated(setting_of, STUDY.observation),
        code=code("compare_case.py"),
    script:
        "../scripts/compare_case.py"
