# on request: the measured short-axis cine, warped by a simulation and registered back; section 4.3 of the paper
WARPED_CONTENTS = ("first", "every", "phantom")
WARPED_CASE = {
    "mesh": "<results>/{case}/geometry/mesh.vtu",
    "motion": "<results>/{case}/warped/simulated.npz",
}
WARPED_IMAGES = "<results>/{case}/warped/{content}.nrrd"


rule simulate_prior:
    input:
        mesh="<results>/{case}/geometry/mesh.vtu",
        registered="<results>/{case}/registration/motion.npz",
        kernels="<results>/kernels.json",
    output:
        "<results>/{case}/warped/simulated.npz",
    wildcard_constraints:
        case=match_any(FITTED_WITH_IMAGES),
    resources:
        mem_mb=1500,
        runtime=5,
    params:
        case=case_of,
        setting=warping_setting,
        pressures=filling_pressures_of,
        scheme=STUDY.numerics,
        stated=configuration_text(case_of, warping_setting, STUDY.numerics, filling_pressures_of),
    script:
        "../scripts/simulate_prior.py"


rule warp_cine:
    input:
        **WARPED_CASE,
        images="<results>/{case}/images/cine.nrrd",
        slices="<results>/{case}/registration/cine.npz",
    output:
        images=WARPED_IMAGES,
        times="<results>/{case}/warped/{content}.json",
    wildcard_constraints:
        case=match_any(FITTED_WITH_IMAGES),
        content="|".join(WARPED_CONTENTS),
    resources:
        mem_mb=1500,
        runtime=5,
    params:
        scanner=STUDY.scanner(),
        thickness=6e-3,  # of the slices of the measured heart, m: cine/timing.json of the data
        stated=configuration_text(STUDY.scanner()),
    script:
        "../scripts/warp_cine.py"


rule register_warped:
    input:
        **WARPED_CASE,
        images=WARPED_IMAGES,
        times="<results>/{case}/warped/{content}.json",
    output:
        motion="<results>/{case}/warped/{content}_motion.npz",
        comparison="<results>/{case}/warped/{content}_comparison.json",
    wildcard_constraints:
        case=match_any(FITTED_WITH_IMAGES),
        content="|".join(WARPED_CONTENTS),
    resources:
        mem_mb=1500,
        runtime=5,
    params:
        registration=STUDY.measured_registration.free_form(),
        operator=STUDY.observation,
        stated=configuration_text(STUDY.measured_registration, STUDY.observation),
    script:
        "../scripts/register_warped.py"


rule tabulate_warped:
    input:
        **WARPED_CASE,
        comparisons=expand("<results>/{{case}}/warped/{content}_comparison.json", content=WARPED_CONTENTS),
        images=expand("<results>/{{case}}/warped/{content}.nrrd", content=WARPED_CONTENTS[:2]),
        registered=expand("<results>/{{case}}/warped/{content}_motion.npz", content=WARPED_CONTENTS[:2]),
    output:
        table=table_files("{case}_warped_cine"),
        figure=figure_files("{case}_warped_cine", "warped_cine"),
    wildcard_constraints:
        case=match_any(FITTED_WITH_IMAGES),
    resources:
        mem_mb=1500,
        runtime=5,
    params:
        contents=WARPED_CONTENTS,
        shown=WARPED_CONTENTS[:2],
        operator=STUDY.observation,
    script:
        "../scripts/tabulate_warped.py"


rule warped_cine:
    input:
        [f"<results>/tables/{case}_warped_cine.md" for case in FITTED_WITH_IMAGES],
