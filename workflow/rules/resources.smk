# compiled once before any beat: many jobs would otherwise compile the same kernels at the same time
rule compile_kernels:
    output:
        "<results>/kernels.json",
    log:
        "<logs>/compile_kernels.log",
    benchmark:
        "<benchmarks>/compile_kernels.tsv"
    resources:
        **needs("compile_kernels"),
    params:
        code=code("compile_kernels.py"),
    script:
        "../scripts/compile_kernels.py"


rule fetch_measured_heart:
    input:
        manifest="resources/bivme_patient1.tsv",
        timing="resources/bivme_patient1_timing.json",
    output:
        timing="resources/bivme_patient1/cine/timing.json",
    log:
        "<logs>/fetch_measured_heart.log",
    benchmark:
        "<benchmarks>/fetch_measured_heart.tsv"
    resources:
        mem_mb=200,
        runtime=10,
    params:
        address="https://raw.githubusercontent.com/UOA-Heart-Mechanics-Research/biv-me/"
        "d01024f8d824a7600cab3daf24b63d202f127d87/",
    script:
        "../scripts/fetch_measured_heart.py"
