rule average_pressure:
    input:
        recording=recording_of,
        motion="<results>/{case}/registration/motion.npz",
    output:
        "<results>/{case}/curves/pressure.csv",
    log:
        "<logs>/{case}/average_pressure.log",
    benchmark:
        "<benchmarks>/{case}/average_pressure.tsv"
    wildcard_constraints:
        case=one_of(RECORDED),
    resources:
        mem_mb=500,
        runtime=5,
    params:
        source=source_of,
        stated=stated(source_of),
        code=code("average_pressure.py"),
    script:
        "../scripts/average_pressure.py"


rule extract_curves:
    input:
        mesh="<results>/{case}/geometry/mesh.vtu",
        motion="<results>/{case}/registration/motion.npz",
        noise=noise_of,
        pressure=pressure_of,
    output:
        curves="<results>/{case}/curves/measured.csv",
        observations="<results>/{case}/curves/observations.json",
    log:
        "<logs>/{case}/extract_curves.log",
    benchmark:
        "<benchmarks>/{case}/extract_curves.tsv"
    resources:
        **needs("extract_curves"),
    params:
        operator=STUDY.observation,
        protocol=STUDY.protocol(),
        stated=stated(STUDY.observation),
        code=code("extract_curves.py"),
    script:
        "../scripts/extract_curves.py"
