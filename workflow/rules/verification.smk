rule simulate_calibrated:
    input:
        mesh="<results>/{case}/geometry/mesh.vtu",
        registered="<results>/{case}/registration/motion.npz",
        posterior="<results>/{case}/{setting}/calibration/posterior.json",
        kernels="<results>/kernels.json",
    output:
        verification_files("beat.json", "beat.csv", "shape.csv", "motion.npz"),
    params:
        case=case_of,
        setting=setting_of,
        pressures=filling_pressures_of,
        scheme=numerics_of,
        mechanisms=setting_mechanisms,
        stated=configuration_text(case_of, setting_of, numerics_of, filling_pressures_of),
    script:
        "../scripts/simulate_calibrated.py"


rule compare_case:
    input:
        posterior="<results>/{case}/{setting}/calibration/posterior.json",
        observations="<results>/{case}/curves/observations.json",
        measured="<results>/{case}/curves/measured.csv",
        reference=beat_at_prior,
        calibrated="<results>/{case}/{setting}/verification/beat.json",
    output:
        "<results>/{case}/{setting}/verification/errors.json",
    params:
        setting=setting_of,
        mechanisms=setting_mechanisms,
        operator=STUDY.observation,
        stated=configuration_text(setting_of, STUDY.observation),
    script:
        "../scripts/compare_case.py"
