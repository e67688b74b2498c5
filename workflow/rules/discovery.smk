MEASURED_CASE = {
    "measured": "<results>/{case}/curves/measured.csv",
    "noise": noise_model,
    "second": second_reading,
}
IMAGED_CASE = MEASURED_CASE | {
    "mesh": "<results>/{case}/geometry/mesh.vtu",
    "registered": "<results>/{case}/registration/motion.npz",
}
CALIBRATED_CASE = IMAGED_CASE | {
    "beats": calibrated_beats("beat"),
    "motions": calibrated_beats("motion"),
    "fitted": calibrated_beats("fitted"),
}
REFITTED_CASE = MEASURED_CASE | {
    "mesh": refit_mesh,
    "registered": refit_motion,
    "kernels": "<results>/kernels.json",
}
REFIT_PARAMS = {
    "case": case_of,
    "setting": setting_of,
    "mechanisms": setting_mechanisms,
    "pressures": filling_pressures_of,
    "scheme": refit_numerics_of,
    "most_steps": DISCOVERY.most_steps,
    "stated": configuration_text(case_of, setting_of, refit_numerics_of, filling_pressures_of, DISCOVERY),
}


rule plot_residual:
    input:
        **CALIBRATED_CASE,
    output:
        table="<results>/{case}/discovery/{setting}/residual.csv",
        figure=figure_files("residual_{case}_{setting}", "residual"),
    params:
        setting=setting_of,
        mechanisms=setting_mechanisms,
        colour=colour_of,
        stated=configuration_text(setting_of),
    script:
        "../scripts/plot_residual.py"


rule search_cause:
    input:
        **MEASURED_CASE,
        beats=sigma_point_beats,
        kernels="<results>/kernels.json",
    output:
        cause_card("<results>/{case}/discovery/{setting}/search"),
    params:
        case=case_of,
        setting=setting_of,
        stated=configuration_text(case_of, setting_of),
        mechanisms=library_mechanisms,
        reading="mean",
    script:
        "../scripts/search_cause.py"


# the same search with the volume of the fitted surface, or of the blood in the slices, alone
use rule search_cause as search_reading with:
    output:
        cause_card("<results>/{case}/discovery/{setting}/readings/{reading}"),
    resources:
        mem_mb=1000,
        runtime=10,
    params:
        case=case_of,
        setting=setting_of,
        stated=configuration_text(case_of, setting_of),
        mechanisms=library_mechanisms,
        reading=lambda wildcards: wildcards.reading,


rule search_wall:
    input:
        **REFITTED_CASE,
    output:
        "<results>/{case}/discovery/{setting}/wall/wall.json",
        "<results>/{case}/discovery/{setting}/wall/wall.md",
    resources:
        mem_mb=2000,
        runtime=30,
    params:
        case=case_of,
        setting=setting_of,
        pressures=filling_pressures_of,
        stated=configuration_text(case_of, setting_of, filling_pressures_of),
        mechanisms=library_mechanisms,
    script:
        "../scripts/search_wall.py"


rule coarsen_wall:
    input:
        mesh="<results>/{case}/geometry/mesh.vtu",
        motion="<results>/{case}/registration/motion.npz",
    output:
        mesh="<results>/{case}/discovery/mesh.vtu",
        motion="<results>/{case}/discovery/motion.npz",
    wildcard_constraints:
        case=match_any(COARSENED),
    resources:
        mem_mb=1500,
        runtime=5,
    params:
        case=case_of,
        size=DISCOVERY.coarse.mesh if DISCOVERY.coarse else None,
        stated=configuration_text(case_of, DISCOVERY.coarse),
    script:
        "../scripts/coarsen_wall.py"


rule refit_case:
    input:
        **REFITTED_CASE,
    output:
        expand(
            "<results>/{{case}}/discovery/{{setting}}/none/{file}",
            file=("refit.json", "beat.json", "beat.csv", "motion.npz"),
        ),
    params:
        **REFIT_PARAMS,
    script:
        "../scripts/refit_case.py"


rule prove_cause:
    input:
        **REFITTED_CASE,
        search="<results>/{case}/discovery/{setting}/search/cause.json",
        traces="<results>/{case}/discovery/{setting}/search/traces.json",
        refit="<results>/{case}/discovery/{setting}/none/refit.json",
    output:
        cause_card("<results>/{case}/discovery/{setting}"),
        "<results>/{case}/discovery/{setting}/refit.json",
    params:
        **REFIT_PARAMS,
        every=library_mechanisms,
    script:
        "../scripts/prove_cause.py"


rule try_mechanism:
    input:
        **REFITTED_CASE,
        refit="<results>/{case}/discovery/{setting}/none/refit.json",
    output:
        "<results>/{case}/discovery/{setting}/trials/{mechanism}.json",
    params:
        **REFIT_PARAMS,
        tried=tried_mechanism,
    script:
        "../scripts/try_mechanism.py"


rule compare_attempts:
    input:
        expand("<results>/{{case}}/discovery/{{setting}}/trials/{mechanism}.json", mechanism=DISCOVERY.trials),
    output:
        tables=table_files("{case}_{setting}_trials"),
        figure=figure_files("trials_{case}_{setting}", "trials"),
    script:
        "../scripts/compare_attempts.py"


rule tabulate_extension:
    input:
        measured="<results>/{case}/curves/measured.csv",
        second=second_reading,
        cause="<results>/{case}/discovery/{setting}/cause.json",
        traces="<results>/{case}/discovery/{setting}/traces.json",
    output:
        tables=table_files("{case}_{setting}_extension"),
        figure=figure_files("extension_{case}_{setting}", "extension"),
    resources:
        mem_mb=500,
        runtime=2,
    script:
        "../scripts/tabulate_extension.py"


# the measured heart: what its simulation gets wrong, and what the named mechanisms gain; see config/measured_heart.yaml
rule discover:
    input:
        [f"<results>/{case}/discovery/{setting}/cause.md" for case, setting in REFITTED],
        [f"<results>/tables/{case}_{setting}_extension.md" for case, setting in REFITTED],
        ["<results>/tables/discovery.md"] if REFITTED else [],
        "<results>/tables/meshes.csv",
        [
            f"<results>/{case}/discovery/{setting}/readings/{reading}/cause.json"
            for case, setting in REFITTED
            for reading in ("first", "second")
            if case in FITTED_WITH_IMAGES
        ],


rule tabulate_discovery:
    input:
        causes=[f"<results>/{case}/discovery/{setting}/cause.json" for case, setting in REFITTED],
        searched=[f"<results>/{case}/discovery/{setting}/search/cause.json" for case, setting in REFITTED],
        truths=[f"<results>/{case}/cohort/truth.json" for case, _ in REFITTED if case in SEALED],
        sealed=[f"<results>/{case}/cohort/effects.sealed" for case, _ in REFITTED if case in SEALED],
    output:
        reported_tables("discovery"),
    resources:
        mem_mb=500,
        runtime=2,
    params:
        results=results_folder,
        refitted=REFITTED,
        virtual=SEALED,
    script:
        "../scripts/tabulate_discovery.py"


ELEMENT_PARAMS = {
    "question": DISCOVERY.element,
    "scheme": STUDY.numerics,
    "heart": STUDY.cohort.heart,
    "size": STUDY.virtual_mesh,
    "pressures": STUDY.end_diastolic_pressure,
    "steps": DISCOVERY.most_steps,
}


rule compare_elements:
    input:
        generator=template_file("generator"),
        template=template_file("calibrator"),
        kernels="<results>/kernels.json",
    output:
        table=table_files("element"),
        figure=expand("<results>/figures/element.{suffix}", suffix=STUDY.figures),
    params:
        **ELEMENT_PARAMS,
        setting=element_setting,
        mechanisms=library_mechanisms,
        stated=configuration_text(element_setting, ELEMENT_PARAMS),
    script:
        "../scripts/compare_elements.py"
