rule generate_volunteer:
    input:
        template="<results>/templates/generator.vtu",
        kernels="<results>/kernels.json",
    output:
        **{role: f"<results>/{{case}}/cohort/{file}" for role, file in HIDDEN.items()},
    log:
        "<logs>/{case}/generate_volunteer.log",
    benchmark:
        "<benchmarks>/{case}/generate_volunteer.tsv"
    wildcard_constraints:
        case=one_of(VIRTUAL),
    resources:
        **needs("generate_volunteer"),
    params:
        case=case_of,
        cohort=STUDY.cohort,
        pressures=filling_of,
        planted=planted_of,
        stated=stated(case_of, STUDY.cohort, filling_of),
        code=code("generate_volunteer.py"),
    script:
        "../scripts/generate_volunteer.py"


rule image_volunteer:
    input:
        mesh="<results>/{case}/cohort/heart.vtu",
        motion="<results>/{case}/cohort/motion.npz",
    output:
        images="<results>/{case}/images/cine.nrrd",
        times="<results>/{case}/images/cine.json",
    log:
        "<logs>/{case}/image_volunteer.log",
    benchmark:
        "<benchmarks>/{case}/image_volunteer.tsv"
    wildcard_constraints:
        case=one_of(VIRTUAL),
    resources:
        **needs("image_volunteer"),
    params:
        case=case_of,
        scanner=STUDY.scanner(),
        stated=stated(case_of, STUDY.scanner()),
        code=code("image_volunteer.py"),
    script:
        "../scripts/image_volunteer.py"


rule record_pressure:
    input:
        beat="<results>/{case}/cohort/beat.json",
        curves="<results>/{case}/cohort/beat.csv",
    output:
        "<results>/{case}/cohort/pressure.csv",
    log:
        "<logs>/{case}/record_pressure.log",
    benchmark:
        "<benchmarks>/{case}/record_pressure.tsv"
    wildcard_constraints:
        case=one_of(CATHETERISED),
    resources:
        **needs("record_pressure"),
    params:
        case=case_of,
        catheter=STUDY.cohort.catheter.catheter(),
        stated=stated(case_of, STUDY.cohort.catheter),
        code=code("record_pressure.py"),
    script:
        "../scripts/record_pressure.py"
