SCORES = ("rates", "mechanisms", "data", "cases")


# answers are sealed apart from what was measured: diagnose_planted is given the one folder, and never the other
rule plant_effects:
    input:
        kernels="<results>/kernels.json",
    output:
        measured=directory("<results>/discovery_benchmark/measured/{batch}"),
        sealed=directory("<results>/discovery_benchmark/sealed/{batch}"),
    log:
        "<logs>/discovery_benchmark/plant_effects_{batch}.log",
    benchmark:
        "<benchmarks>/discovery_benchmark/plant_effects_{batch}.tsv"
    resources:
        **needs("plant_effects"),
    params:
        plans=batch_of,
        library=every_mechanism,
        stated=stated(batch_of),
        code=code("plant_effects.py"),
    script:
        "../scripts/plant_effects.py"


rule diagnose_planted:
    input:
        kernels="<results>/kernels.json",
        measured="<results>/discovery_benchmark/measured/{batch}",
    output:
        "<results>/discovery_benchmark/findings/{batch}.json",
    log:
        "<logs>/discovery_benchmark/diagnose_planted_{batch}.log",
    benchmark:
        "<benchmarks>/discovery_benchmark/diagnose_planted_{batch}.tsv"
    resources:
        **needs("diagnose_planted"),
    params:
        library=every_mechanism,
        code=code("diagnose_planted.py"),
    script:
        "../scripts/diagnose_planted.py"


rule discovery_benchmark:
    input:
        findings=expand("<results>/discovery_benchmark/findings/{batch}.json", batch=BATCHES),
        sealed=expand("<results>/discovery_benchmark/sealed/{batch}", batch=BATCHES),
        ventricles=f"{VENTRICLES.page}/discovery_benchmark_3d.md",
    output:
        tables=expand("<results>/discovery_benchmark/{name}.csv", name=SCORES),
        page=f"{STUDY.discovery_benchmark.page}/discovery_benchmark.md",
        figures=expand(
            f"{STUDY.discovery_benchmark.page}/figures/discovery_{{name}}.png",
            name=("rates", "confusion", "power"),
        ),
    log:
        "<logs>/discovery_benchmark/discovery_benchmark.log",
    benchmark:
        "<benchmarks>/discovery_benchmark/discovery_benchmark.tsv"
    resources:
        **needs("discovery_benchmark"),
    params:
        planned=STUDY.discovery_benchmark.planned(),
        code=code("discovery_benchmark.py"),
    script:
        "../scripts/discovery_benchmark.py"


rule check_discovery:
    input:
        findings=expand("<results>/discovery_benchmark/findings/{batch}.json", batch=BATCHES),
        sealed=expand("<results>/discovery_benchmark/sealed/{batch}", batch=BATCHES),
        claims=STUDY.discovery_benchmark.claims,
        ventricles="<results>/discovery_benchmark/ventricles/checked.csv",
    output:
        "<results>/discovery_benchmark/checked.csv",
    log:
        "<logs>/discovery_benchmark/check_discovery.log",
    benchmark:
        "<benchmarks>/discovery_benchmark/check_discovery.tsv"
    resources:
        **needs("check_discovery"),
    params:
        code=code("check_discovery.py"),
    script:
        "../scripts/check_discovery.py"
