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
        case=one_of(MEASURED),
    resources:
        mem_mb=1500,
        runtime=20,
    params:
        folder=str(HEART),
        size=STUDY.mesh,
        stated=stated(STUDY.mesh),
        code=code("build_measured_mesh.py"),
    script:
        "../scripts/build_measured_mesh.py"


rule build_volunteer_mesh:
    input:
        outline="<results>/{case}/cohort/heart.vtu",
    output:
        "<results>/{case}/geometry/mesh.vtu",
    log:
        "<logs>/{case}/build_mesh.log",
    benchmark:
        "<benchmarks>/{case}/build_mesh.tsv"
    wildcard_constraints:
        case=one_of(VIRTUAL),
    resources:
        mem_mb=1500,
        runtime=20,
    params:
        case=case_of,
        size=STUDY.mesh,
        stated=stated(case_of, STUDY.mesh),
        code=code("build_volunteer_mesh.py"),
    script:
        "../scripts/build_volunteer_mesh.py"
