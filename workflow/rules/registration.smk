MEASURED_WALL = {"source": source_without_pressure, "stated": configuration_text(source_without_pressure)}


rule take_images:
    input:
        files=wall_files,
        images=source_images,
    output:
        images="<results>/{case}/images/cine.nrrd",
        times="<results>/{case}/images/cine.json",
    wildcard_constraints:
        case=match_any(IMAGED),
    resources:
        mem_mb=1500,
        runtime=5,
    params:
        **MEASURED_WALL,
        case=case_of,
    script:
        "../scripts/take_images.py"


rule register_measured:
    input:
        files=wall_files,
        mesh="<results>/{case}/geometry/mesh.vtu",
    output:
        "<results>/{case}/registration/motion.npz",
    wildcard_constraints:
        case=match_any(FITTED),
    params:
        **MEASURED_WALL,
    script:
        "../scripts/register_measured.py"


rule register_volunteer:
    input:
        mesh="<results>/{case}/geometry/mesh.vtu",
        images="<results>/{case}/images/cine.nrrd",
        times="<results>/{case}/images/cine.json",
    output:
        motion="<results>/{case}/registration/motion.npz",
        quality="<results>/{case}/registration/quality.json",
    wildcard_constraints:
        case=match_any(VIRTUAL),
    params:
        end_diastole=STUDY.registration.end_diastole,
        registration=STUDY.registration.free_form(),
        stated=configuration_text(STUDY.registration),
    script:
        "../scripts/register_volunteer.py"


rule register_segmented:
    input:
        files=wall_files,
        mesh="<results>/{case}/geometry/mesh.vtu",
        images="<results>/{case}/images/cine.nrrd",
        times="<results>/{case}/images/cine.json",
    output:
        motion="<results>/{case}/registration/motion.npz",
        quality="<results>/{case}/registration/quality.json",
    wildcard_constraints:
        case=match_any(SEGMENTED),
    params:
        source=source_without_pressure,
        registration=STUDY.measured_registration.free_form(),
        stated=configuration_text(source_without_pressure, STUDY.measured_registration),
    script:
        "../scripts/register_segmented.py"


rule register_cine:
    input:
        files=wall_files,
        images="<results>/{case}/images/cine.nrrd",
    output:
        "<results>/{case}/registration/cine.npz",
    wildcard_constraints:
        case=match_any(FITTED_WITH_IMAGES),
    params:
        **MEASURED_WALL,
    script:
        "../scripts/register_cine.py"


rule compare_cine:
    input:
        files=wall_files,
        images="<results>/{case}/images/cine.nrrd",
        motion="<results>/{case}/registration/cine.npz",
    output:
        outlines=table_files("{case}_cine_outlines"),
        wall=table_files("{case}_cine_wall"),
        volume=table_files("{case}_cine_volume"),
        outlines_figure=figure_files("{case}_cine_outlines", "cine"),
        volume_figure=figure_files("{case}_cine_volume", "cine"),
    wildcard_constraints:
        case=match_any(FITTED_WITH_IMAGES),
    params:
        **MEASURED_WALL,
    script:
        "../scripts/compare_cine.py"
