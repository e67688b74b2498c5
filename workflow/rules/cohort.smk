rule hide_effect:
    output:
        "<results>/{case}/cohort/effects.sealed",
    wildcard_constraints:
        case=match_any(SEALED),
    resources:
        mem_mb=1000,
        runtime=5,
    params:
        case=case_of,
        library=library_mechanisms,
        stated=configuration_text(case_of),
    script:
        "../scripts/hide_effect.py"


rule generate_volunteer:
    input:
        hidden=hidden_effects,
        template=hidden_template,
        kernels="<results>/kernels.json",
    output:
        mesh="<results>/{case}/cohort/heart.vtu",
        motion="<results>/{case}/cohort/motion.npz",
        beat="<results>/{case}/cohort/beat.json",
        curves="<results>/{case}/cohort/beat.csv",
        truth="<results>/{case}/cohort/truth.json",
    wildcard_constraints:
        case=match_any(VIRTUAL),
    params:
        case=case_of,
        cohort=cohort_of,
        pressures=filling_pressures_of,
        planted=planted_mechanisms,
        stated=configuration_text(case_of, cohort_of, filling_pressures_of),
    script:
        "../scripts/generate_volunteer.py"


rule image_volunteer:
    input:
        mesh="<results>/{case}/cohort/heart.vtu",
        motion="<results>/{case}/cohort/motion.npz",
    output:
        images="<results>/{case}/images/cine.nrrd",
        times="<results>/{case}/images/cine.json",
    wildcard_constraints:
        case=match_any(VIRTUAL),
    params:
        case=case_of,
        scanner=STUDY.scanner(),
        stated=configuration_text(case_of, STUDY.scanner()),
    script:
        "../scripts/image_volunteer.py"


rule record_pressure:
    input:
        beat="<results>/{case}/cohort/beat.json",
        curves="<results>/{case}/cohort/beat.csv",
    output:
        "<results>/{case}/cohort/pressure.csv",
    wildcard_constraints:
        case=match_any(CATHETERISED),
    params:
        case=case_of,
        catheter=STUDY.cohort.catheter.catheter(),
        stated=configuration_text(case_of, STUDY.cohort.catheter),
    script:
        "../scripts/record_pressure.py"
