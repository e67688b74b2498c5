# before all beats, so that parallel jobs do not compile the same kernels
rule compile_kernels:
    output:
        "<results>/kernels.json",
    script:
        "../scripts/compile_kernels.py"


rule draw_sigma_points:
    input:
        first_estimate,
    output:
        "<results>/{case}/{setting}/calibration/points.json",
    params:
        setting=setting_of,
        transform=STUDY.unscented,
        stated=configuration_text(setting_of, STUDY.unscented),
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
    params:
        case=case_of,
        setting=setting_of,
        pressures=filling_pressures_of,
        scheme=numerics_of,
        mechanisms=setting_mechanisms,
        stated=configuration_text(case_of, setting_of, numerics_of, filling_pressures_of),
    script:
        "../scripts/simulate_point.py"


rule update_parameters:
    input:
        points="<results>/{case}/{setting}/calibration/points.json",
        measured="<results>/{case}/curves/measured.csv",
        observations="<results>/{case}/curves/observations.json",
        beats=sigma_point_beats,
        sensitivities=sensitivities,
    output:
        multiext(
            "<results>/{case}/{setting}/calibration/posterior", noise_free=".json", noise_aware="_noise.json"
        ),
    params:
        setting=setting_of,
        mechanisms=setting_mechanisms,
        operator=STUDY.observation,
        transform=STUDY.unscented,
        stated=configuration_text(setting_of, STUDY.unscented, STUDY.observation),
    script:
        "../scripts/update_parameters.py"


rule compare_alternatives:
    input:
        kernels="<results>/kernels.json",
    output:
        table=table_files("alternatives"),
        figure=figure_files("alternatives", "alternatives", "Methods"),
    params:
        study=STUDY.sphere_study,
        samplers=STUDY.known_hearts(),
        stated=configuration_text(STUDY.known_hearts(), STUDY.sphere_study),
    script:
        "../scripts/compare_alternatives.py"


rule cover_spheres:
    input:
        kernels="<results>/kernels.json",
    output:
        table=table_files("coverage_sphere"),
        figure=figure_files("coverage_sphere", "coverage", "Methods"),
    params:
        study=STUDY.sphere_study,
        samplers=STUDY.known_hearts(),
        stated=configuration_text(STUDY.known_hearts(), STUDY.sphere_study),
    script:
        "../scripts/cover_spheres.py"
