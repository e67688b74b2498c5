SENSITIVITY = STUDY.sensitivity
REFERENCE = CASES[SENSITIVITY.case]
REFERENCE_MESH = f"<results>/{SENSITIVITY.case}/geometry/mesh.vtu"
SPHERE = STUDY.sphere_setting()


use rule draw_sigma_points as draw_surroundings with:
    output:
        "<results>/sensitivity/{setting}/points.json",
    params:
        setting=perturbed_setting_of,
        transform=SENSITIVITY,
        stated=configuration_text(perturbed_setting_of, SENSITIVITY),


# one job for all beats of a setting, which take less time than the start of a job each
rule simulate_surroundings:
    input:
        mesh=REFERENCE_MESH,
        points="<results>/sensitivity/{setting}/points.json",
        kernels="<results>/kernels.json",
    output:
        beats=surrounding_files(".json"),
        curves=surrounding_files(".csv"),
    params:
        case=REFERENCE,
        setting=perturbed_setting_of,
        pressures=STUDY.filling_pressures(REFERENCE),
        scheme=STUDY.calibrator(REFERENCE).numerics,
        stated=configuration_text(
            REFERENCE, perturbed_setting_of, STUDY.numerics, STUDY.filling_pressures(REFERENCE)
        ),
    script:
        "../scripts/simulate_surroundings.py"


rule analyse_sensitivity:
    input:
        points="<results>/sensitivity/{setting}/points.json",
        beats=perturbation_beats,
        limits="resources/plausible_beat.csv",
    output:
        sensitivity="<results>/sensitivity/{setting}/sensitivity.json",
        right="<results>/sensitivity/{setting}/right.json",
        ranges="<results>/sensitivity/{setting}/ranges.json",
    params:
        setting=perturbed_setting_of,
        study=SENSITIVITY,
        operator=STUDY.observation,
        stated=configuration_text(perturbed_setting_of, SENSITIVITY, STUDY.observation),
    script:
        "../scripts/analyse_sensitivity.py"


rule study_sphere:
    input:
        mesh=REFERENCE_MESH,
        kernels="<results>/kernels.json",
    output:
        "<results>/sensitivity/sobol.json",
    params:
        case=REFERENCE,
        setting=SPHERE,
        sphere=SENSITIVITY.sphere,
        pressures=STUDY.end_diastolic_pressure,
        operator=STUDY.observation,
        scheme=STUDY.numerics,
        stated=configuration_text(REFERENCE, SPHERE, SENSITIVITY.sphere, STUDY.numerics, STUDY.observation),
    script:
        "../scripts/study_sphere.py"


rule plot_surroundings:
    input:
        points="<results>/sensitivity/{setting}/points.json",
        beats=perturbation_beats,
        sensitivity="<results>/sensitivity/{setting}/sensitivity.json",
    output:
        curves=figure_files("sensitivity_curves_{setting}", "surroundings", "Parameters"),
        figure=figure_files("sensitivity_{setting}", "surroundings", "Parameters"),
        table=table_files("sensitivity_{setting}"),
    params:
        setting=perturbed_setting_of,
        study=SENSITIVITY,
    script:
        "../scripts/plot_surroundings.py"


rule tabulate_selection:
    input:
        sensitivities=expand("<results>/sensitivity/{setting}/sensitivity.json", setting=PERTURBED_SETTINGS),
        ranges=expand("<results>/sensitivity/{setting}/ranges.json", setting=PERTURBED_SETTINGS),
    output:
        selection=table_files("selection"),
        prior=table_files("prior"),
        bulk_modulus=table_files("bulk_modulus"),
    params:
        settings=PERTURBED_SETTINGS,
        estimated=STUDY.estimated(),
        units=SPHERE.units(),
    script:
        "../scripts/tabulate_selection.py"


rule plot_sobol:
    input:
        sensitivities=expand("<results>/sensitivity/{setting}/sensitivity.json", setting=PERTURBED_SETTINGS),
        sobol="<results>/sensitivity/sobol.json",
    output:
        table=table_files("sobol"),
        figure=figure_files("sobol", "sobol", "Parameters"),
    resources:
        mem_mb=1000,
        runtime=2,
    params:
        settings=PERTURBED_SETTINGS,
        colours=COLOURS,
    script:
        "../scripts/plot_sobol.py"
