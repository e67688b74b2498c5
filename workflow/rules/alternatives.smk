rule compare_alternatives:
    input:
        kernels="<results>/kernels.json",
    output:
        table=expand("<results>/tables/alternatives.{suffix}", suffix=("csv", "md", "tex")),
        figure=pictured("alternatives", "alternatives", "Methods"),
    log:
        "<logs>/compare_alternatives.log",
    benchmark:
        "<benchmarks>/compare_alternatives.tsv"
    resources:
        **needs("compare_alternatives"),
    params:
        study=STUDY.sphere_study,
        twins=STUDY.twins(),
        stated=stated(STUDY.twins(), STUDY.sphere_study),
        code=code("compare_alternatives.py"),
    script:
        "../scripts/compare_alternatives.py"


rule cover_spheres:
    input:
        kernels="<results>/kernels.json",
    output:
        table=expand("<results>/tables/coverage_sphere.{suffix}", suffix=("csv", "md", "tex")),
        figure=pictured("coverage_sphere", "coverage", "Methods"),
    log:
        "<logs>/cover_spheres.log",
    benchmark:
        "<benchmarks>/cover_spheres.tsv"
    resources:
        **needs("cover_spheres"),
    params:
        study=STUDY.sphere_study,
        twins=STUDY.twins(),
        stated=stated(STUDY.twins(), STUDY.sphere_study),
        code=code("cover_spheres.py"),
    script:
        "../scripts/cover_spheres.py"
