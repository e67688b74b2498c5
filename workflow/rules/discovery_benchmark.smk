# a sealed folder contains the true effects: only the scoring rules read it, the diagnosis reads measurements
SPHERE_DIAGNOSES = {
    "findings": expand("<results>/discovery_benchmark/findings/{batch}.json", batch=SPHERE_BATCHES),
    "sealed": expand("<results>/discovery_benchmark/sealed/{batch}", batch=SPHERE_BATCHES),
}
VENTRICLE_DIAGNOSES = {
    "findings": expand(
        "<results>/discovery_benchmark/ventricles/findings/{number}.json", number=VENTRICLE_CASES
    ),
    "sealed": expand("<results>/discovery_benchmark/ventricles/sealed/{number}", number=VENTRICLE_CASES),
}
VENTRICLE_MODEL = {
    "generator": VENTRICLES.generator,
    "diagnoser": VENTRICLES.diagnoser,
    "scanner": STUDY.scanner(),
    "registration": STUDY.registration.free_form(),
    "standard": STUDY.cohort.heart,
    "pressures": STUDY.end_diastolic_pressure,
}


rule plant_effects:
    input:
        kernels="<results>/kernels.json",
    output:
        measured=directory("<results>/discovery_benchmark/measured/{batch}"),
        sealed=directory("<results>/discovery_benchmark/sealed/{batch}"),
    params:
        plans=sphere_batch_of,
        library=library_mechanisms,
        stated=configuration_text(sphere_batch_of),
    script:
        "../scripts/plant_effects.py"


rule diagnose_planted:
    input:
        kernels="<results>/kernels.json",
        measured="<results>/discovery_benchmark/measured/{batch}",
    output:
        "<results>/discovery_benchmark/findings/{batch}.json",
    params:
        library=library_mechanisms,
    script:
        "../scripts/diagnose_planted.py"


rule plant_ventricles:
    input:
        generator=template_file("planted"),
        template=template_file("diagnoser"),
        kernels="<results>/kernels.json",
    output:
        measured=directory("<results>/discovery_benchmark/ventricles/measured/{number}"),
        sealed=directory("<results>/discovery_benchmark/ventricles/sealed/{number}"),
        mesh="<results>/discovery_benchmark/ventricles/meshes/{number}.vtu",
    params:
        **VENTRICLE_MODEL,
        plan=ventricle_case_of,
        library=library_mechanisms,
        stated=configuration_text(ventricle_case_of, VENTRICLE_MODEL),
    script:
        "../scripts/plant_ventricles.py"


rule diagnose_ventricles:
    input:
        kernels="<results>/kernels.json",
        measured="<results>/discovery_benchmark/ventricles/measured/{number}",
        mesh="<results>/discovery_benchmark/ventricles/meshes/{number}.vtu",
    output:
        "<results>/discovery_benchmark/ventricles/findings/{number}.json",
    params:
        model=VENTRICLES.diagnoser,
        setting=STUDY.nominal_setting(),
        pressures=STUDY.end_diastolic_pressure,
        library=library_mechanisms,
        stated=configuration_text(VENTRICLES.diagnoser, STUDY.nominal_setting(), STUDY.end_diastolic_pressure),
    script:
        "../scripts/diagnose_ventricles.py"


rule discovery_ventricles:
    input:
        **VENTRICLE_DIAGNOSES,
    output:
        tables=expand(
            "<results>/discovery_benchmark/ventricles/{name}.csv",
            name=("rates", "mechanisms", "cases", "extent"),
        ),
        stored=expand(
            f"{VENTRICLES.page}/measured/planted_3d_{{name}}.tsv",
            name=("rates", "mechanisms", "cases", "extent"),
        ),
        figure=f"{VENTRICLES.page}/figures/discovery_3d.png",
    params:
        planned=len(VENTRICLE_CASES),
    script:
        "../scripts/discovery_ventricles.py"


rule check_ventricles:
    input:
        **VENTRICLE_DIAGNOSES,
        claims=VENTRICLES.claims,
    output:
        "<results>/discovery_benchmark/ventricles/checked.csv",
    script:
        "../scripts/check_ventricles.py"


rule discovery_benchmark:
    input:
        **SPHERE_DIAGNOSES,
        ventricles="<results>/discovery_benchmark/ventricles/rates.csv",
    output:
        tables=expand(
            "<results>/discovery_benchmark/{name}.csv",
            name=("rates", "populations", "mechanisms", "data", "cases", "extent"),
        ),
        stored=expand(
            f"{STUDY.discovery_benchmark.page}/measured/planted_{{name}}.tsv",
            name=("rates", "populations", "mechanisms", "data", "extent"),
        ),
        figures=expand(
            f"{STUDY.discovery_benchmark.page}/figures/discovery_{{name}}.png",
            name=("rates", "confusion", "power"),
        ),
    params:
        planned=STUDY.discovery_benchmark.planned(),
    script:
        "../scripts/discovery_benchmark.py"


rule check_discovery:
    input:
        **SPHERE_DIAGNOSES,
        claims=STUDY.discovery_benchmark.claims,
        ventricles="<results>/discovery_benchmark/ventricles/checked.csv",
    output:
        "<results>/discovery_benchmark/checked.csv",
    script:
        "../scripts/check_discovery.py"
