# hidden effects in three dimensions, one job a case; the sealed answers are for the scorer only, as on spheres
FOUND_IN_3D = {
    "findings": expand(
        "<results>/discovery_benchmark/ventricles/findings/{number}.json", number=HIDDEN_IN_3D
    ),
    "sealed": expand("<results>/discovery_benchmark/ventricles/sealed/{number}", number=HIDDEN_IN_3D),
}
HIDING = {
    "generator": VENTRICLES.generator,
    "diagnoser": VENTRICLES.diagnoser,
    "scanner": STUDY.scanner(),
    "registration": STUDY.registration.free_form(),
    "standard": STUDY.cohort.heart,
    "pressures": STUDY.end_diastolic_pressure,
}


rule plant_ventricles:
    input:
        generator="<results>/templates/planted.vtu",
        template="<results>/templates/diagnoser.vtu",
        kernels="<results>/kernels.json",
    output:
        measured=directory("<results>/discovery_benchmark/ventricles/measured/{number}"),
        sealed=directory("<results>/discovery_benchmark/ventricles/sealed/{number}"),
        mesh="<results>/discovery_benchmark/ventricles/meshes/{number}.vtu",
    log:
        "<logs>/discovery_benchmark/plant_ventricles_{number}.log",
    benchmark:
        "<benchmarks>/discovery_benchmark/plant_ventricles_{number}.tsv"
    resources:
        **needs("plant_ventricles"),
    params:
        **HIDING,
        plan=plan_of,
        library=every_mechanism,
        stated=stated(plan_of, HIDING),
        code=code("plant_ventricles.py"),
    script:
        "../scripts/plant_ventricles.py"


rule diagnose_ventricles:
    input:
        kernels="<results>/kernels.json",
        measured="<results>/discovery_benchmark/ventricles/measured/{number}",
        mesh="<results>/discovery_benchmark/ventricles/meshes/{number}.vtu",
    output:
        "<results>/discovery_benchmark/ventricles/findings/{number}.json",
    log:
        "<logs>/discovery_benchmark/diagnose_ventricles_{number}.log",
    benchmark:
        "<benchmarks>/discovery_benchmark/diagnose_ventricles_{number}.tsv"
    resources:
        **needs("diagnose_ventricles"),
    params:
        model=VENTRICLES.diagnoser,
        setting=STUDY.centre(),
        pressures=STUDY.end_diastolic_pressure,
        library=every_mechanism,
        stated=stated(VENTRICLES.diagnoser, STUDY.centre(), STUDY.end_diastolic_pressure),
        code=code("diagnose_ventricles.py"),
    script:
        "../scripts/diagnose_ventricles.py"


rule discovery_ventricles:
    input:
        **FOUND_IN_3D,
    output:
        tables=expand(
            "<results>/discovery_benchmark/ventricles/{name}.csv", name=("rates", "mechanisms", "cases")
        ),
        page=f"{VENTRICLES.page}/discovery_benchmark_3d.md",
        figure=f"{VENTRICLES.page}/figures/discovery_3d.png",
    log:
        "<logs>/discovery_benchmark/discovery_ventricles.log",
    benchmark:
        "<benchmarks>/discovery_benchmark/discovery_ventricles.tsv"
    resources:
        **needs("discovery_ventricles"),
    params:
        planned=len(HIDDEN_IN_3D),
        code=code("discovery_ventricles.py"),
    script:
        "../scripts/discovery_ventricles.py"


rule check_ventricles:
    input:
        **FOUND_IN_3D,
        claims=VENTRICLES.claims,
    output:
        "<results>/discovery_benchmark/ventricles/checked.csv",
    log:
        "<logs>/discovery_benchmark/check_ventricles.log",
    benchmark:
        "<benchmarks>/discovery_benchmark/check_ventricles.tsv"
    resources:
        **needs("check_ventricles"),
    params:
        code=code("check_ventricles.py"),
    script:
        "../scripts/check_ventricles.py"
