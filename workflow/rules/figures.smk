rule plot_activation:
    input:
        "<results>/{case}/geometry/mesh.vtu",
    output:
        figure_files("{case}_activation", "activation"),
    params:
        case=case_of,
        stated=configuration_text(case_of),
    script:
        "../scripts/plot_activation.py"


rule plot_contours:
    input:
        mesh="<results>/{case}/geometry/mesh.vtu",
        motion="<results>/{case}/registration/motion.npz",
        images="<results>/{case}/images/cine.nrrd",
    output:
        figure=figure_files("{case}_contours", "contours"),
        animation="<results>/figures/{case}_beat.gif",
    wildcard_constraints:
        case=match_any(VIRTUAL + IMAGED),
    script:
        "../scripts/plot_contours.py"


rule plot_overlay:
    input:
        mesh="<results>/{case}/geometry/mesh.vtu",
        registered="<results>/{case}/registration/motion.npz",
        calibrated="<results>/{case}/{setting}/verification/motion.npz",
        images="<results>/{case}/images/cine.nrrd",
    output:
        figure_files("{case}_{setting}_overlay", "overlay"),
    wildcard_constraints:
        case=match_any(VIRTUAL + IMAGED),
    params:
        colour=colour_of,
    script:
        "../scripts/plot_overlay.py"


rule plot_case:
    input:
        measured="<results>/{case}/curves/measured.csv",
        reference=beat_at_prior,
        calibrated="<results>/{case}/{setting}/verification/beat.json",
        errors="<results>/{case}/{setting}/verification/errors.json",
        posterior="<results>/{case}/{setting}/calibration/posterior.json",
        mesh="<results>/{case}/geometry/mesh.vtu",
        motion="<results>/{case}/registration/motion.npz",
        shape="<results>/{case}/{setting}/verification/shape.csv",
    output:
        curves=figure_files("{case}_{setting}", "curves"),
        sensitivity=figure_files("{case}_{setting}_sensitivity", "sensitivity"),
        shape=figure_files("{case}_{setting}_shape", "shape"),
        table=table_files("{case}_{setting}_shape"),
    params:
        setting=setting_of,
        mechanisms=setting_mechanisms,
        operator=STUDY.observation,
        colour=colour_of,
        stated=configuration_text(setting_of, STUDY.observation),
    script:
        "../scripts/plot_case.py"


rule plot_septal_flash:
    input:
        hearts=expand("<results>/{case}/cohort/heart.vtu", case=SEPTAL_FLASH_CASES),
        true=expand("<results>/{case}/cohort/motion.npz", case=SEPTAL_FLASH_CASES),
        meshes=expand("<results>/{case}/geometry/mesh.vtu", case=SEPTAL_FLASH_CASES),
        registered=expand("<results>/{case}/registration/motion.npz", case=SEPTAL_FLASH_CASES),
        calibrated=calibrated_shapes(SEPTAL_FLASH_CASES),
    output:
        table=table_files("septal_flash"),
        figure=figure_files("septal_flash", "septal_flash", "Cohort"),
    params:
        cases=SEPTAL_FLASH_CASES,
        settings=COMMON_SETTINGS,
    script:
        "../scripts/plot_septal_flash.py"
