# one mesh of each size, which every virtual heart moves to its own wall
rule build_template:
    output:
        "<results>/templates/{template}.vtu",
    log:
        "<logs>/templates/{template}.log",
    benchmark:
        "<benchmarks>/templates/{template}.tsv"
    wildcard_constraints:
        template=one_of(STUDY.templates()),
    resources:
        **needs("build_template"),
    params:
        size=template_size,
        stated=stated(template_size),
        code=code("build_template.py"),
    script:
        "../scripts/build_template.py"


rule build_measured_mesh:
    input:
        files=measured_files,
    output:
        "<results>/{case}/geometry/mesh.vtu",
    log:
        "<logs>/{case}/build_mesh.log",
    benchmark:
        "<benchmarks>/{case}/build_mesh.tsv"
    wildcard_constraints:
        case=one_of(SOURCES),
    resources:
        **needs("build_mesh"),
    params:
        case=case_of,
        source=wall_of,
        size=STUDY.mesh,
        stated=stated(case_of, wall_of, STUDY.mesh),
        code=code("build_measured_mesh.py"),
    script:
        "../scripts/build_measured_mesh.py"


rule build_volunteer_mesh:
    input:
        outline="<results>/{case}/cohort/heart.vtu",
        generator="<results>/templates/generator.vtu",
        template="<results>/templates/calibrator.vtu",
    output:
        "<results>/{case}/geometry/mesh.vtu",
    log:
        "<logs>/{case}/build_mesh.log",
    benchmark:
        "<benchmarks>/{case}/build_mesh.tsv"
    wildcard_constraints:
        case=one_of(VIRTUAL),
    resources:
        **needs("build_mesh"),
    params:
        case=case_of,
        size=STUDY.virtual_mesh,
        stated=stated(case_of, STUDY.virtual_mesh),
        code=code("build_volunteer_mesh.py"),
    script:
        "../scripts/build_volunteer_mesh.py"
