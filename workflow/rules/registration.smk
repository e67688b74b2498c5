SOURCE = {"source": wall_of, "stated": stated(wall_of)}


rule take_images:
    input:
        files=measured_files,
        images=given_images,
    output:
        images="<results>/{case}/images/cine.nrrd",
        times="<results>/{case}/images/cine.json",
    log:
        "<logs>/{case}/take_images.log",
    benchmark:
        "<benchmarks>/{case}/take_images.tsv"
    wildcard_constraints:
        case=one_of(IMAGED),
    resources:
        mem_mb=1500,
        runtime=5,
    params:
        **SOURCE,
        case=case_of,
        code=code("take_images.py"),
    script:
        "../scripts/take_images.py"


rule register_measured:
    input:
        files=measured_files,
        mesh="<results>/{case}/geometry/mesh.vtu",
    output:
        "<results>/{case}/registration/motion.npz",
    log:
        "<logs>/{case}/register.log",
    benchmark:
        "<benchmarks>/{case}/register.tsv"
    wildcard_constraints:
        case=one_of(FITTED),
    resources:
        **needs("register"),
    params:
        **SOURCE,
        code=code("register_measured.py"),
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
    log:
        "<logs>/{case}/register.log",
    benchmark:
        "<benchmarks>/{case}/register.tsv"
    wildcard_constraints:
        case=one_of(VIRTUAL),
    resources:
        **needs("register"),
    params:
        end_diastole=STUDY.registration.end_diastole,
        registration=STUDY.registration.free_form(),
        stated=stated(STUDY.registration),
        code=code("register_volunteer.py"),
    script:
        "../scripts/register_volunteer.py"


rule register_segmented:
    input:
        files=measured_files,
        mesh="<results>/{case}/geometry/mesh.vtu",
        images="<results>/{case}/images/cine.nrrd",
        times="<results>/{case}/images/cine.json",
    output:
        motion="<results>/{case}/registration/motion.npz",
        quality="<results>/{case}/registration/quality.json",
    log:
        "<logs>/{case}/register.log",
    benchmark:
        "<benchmarks>/{case}/register.tsv"
    wildcard_constraints:
        case=one_of(SEGMENTED),
    resources:
        **needs("register"),
    params:
        source=wall_of,
        registration=STUDY.measured_registration.free_form(),
        stated=stated(wall_of, STUDY.measured_registration),
        code=code("register_segmented.py"),
    script:
        "../scripts/register_segmented.py"


rule register_cine:
    input:
        files=measured_files,
        images="<results>/{case}/images/cine.nrrd",
    output:
        "<results>/{case}/registration/cine.npz",
    log:
        "<logs>/{case}/register_cine.log",
    benchmark:
        "<benchmarks>/{case}/register_cine.tsv"
    wildcard_constraints:
        case=one_of(CINE),
    resources:
        **needs("register_cine"),
    params:
        **SOURCE,
        code=code("register_cine.py"),
    script:
        "../scripts/register_cine.py"


rule compare_cine:
    input:
        files=measured_files,
        images="<results>/{case}/images/cine.nrrd",
        motion="<results>/{case}/registration/cine.npz",
    output:
        outlines=printed("{case}_cine_outlines"),
        wall=printed("{case}_cine_wall"),
        volume=printed("{case}_cine_volume"),
        outlines_figure=pictured("{case}_cine_outlines", "cine"),
        volume_figure=pictured("{case}_cine_volume", "cine"),
    log:
        "<logs>/{case}/compare_cine.log",
    benchmark:
        "<benchmarks>/{case}/compare_cine.tsv"
    wildcard_constraints:
        case=one_of(CINE),
    resources:
        **needs("compare_cine"),
    params:
        **SOURCE,
        code=code("compare_cine.py"),
    script:
        "../scripts/compare_cine.py"
