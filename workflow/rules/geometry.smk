rule fetch_measured_heart:
    input:
        manifest="resources/measured_heart/published.tsv",
        timing="resources/measured_heart/cine/timing.json",
    output:
        timing="resources/bivme_patient1/cine/timing.json",
    resources:
        mem_mb=200,
        runtime=10,
    params:
        address="https://raw.githubusercontent.com/UOA-Heart-Mechanics-Research/biv-me/"
        "d01024f8d824a7600cab3daf24b63d202f127d87/",
    script:
        "../scripts/fetch_measured_heart.py"


# the mesh that every virtual heart deforms to its own wall, of a size of which resources/templates has none
rule build_template:
    output:
        "<results>/templates/{template}.vtu",
    log:
        "<logs>/templates/{template}.log",
    benchmark:
        "<benchmarks>/templates/{template}.tsv"
    wildcard_constraints:
        template=match_any(STUDY.templates()),
    resources:
        mem_mb=2000,
        runtime=10,
    params:
        size=template_size_of,
        stated=configuration_text(template_size_of),
    script:
        "../scripts/build_template.py"


rule build_measured_mesh:
    input:
        files=wall_files,
    output:
        "<results>/{case}/geometry/mesh.vtu",
    wildcard_constraints:
        case=match_any(SOURCES),
    params:
        case=case_of,
        source=source_without_pressure,
        size=STUDY.mesh,
        stated=configuration_text(case_of, source_without_pressure, STUDY.mesh),
    script:
        "../scripts/build_measured_mesh.py"


rule build_volunteer_mesh:
    input:
        outline="<results>/{case}/cohort/heart.vtu",
        generator=hidden_template,
        template=model_template,
    output:
        "<results>/{case}/geometry/mesh.vtu",
    wildcard_constraints:
        case=match_any(VIRTUAL),
    params:
        case=case_of,
        size=mesh_size_of,
        stated=configuration_text(case_of, mesh_size_of),
    script:
        "../scripts/build_volunteer_mesh.py"
