"""Files that rules read and write, and the results of the study."""

from heartfit.io.fingerprint import PACKAGE
from heartfit.io.noise_models import stored_noise_model
from heartfit.io.sources import source_files
from heartfit.io.templates import stored_template
from heartfit.results.report.record import TITLES

TABLE_SUFFIXES = ("csv", "md", "tex")
LEARNT_NOISE = "<results>/registration_error/noise_model.json"
# of the virtual images: stored, or learnt in this study
NOISE_MODEL = stored_noise_model(STUDY) or LEARNT_NOISE


def posteriors(calibrations):
    """Files of both posteriors of pairs of case and setting."""
    folders = [f"<results>/{case}/{setting}/calibration" for case, setting in calibrations]
    return {
        "noise_free": [f"{folder}/posterior.json" for folder in folders],
        "noise_aware": [f"{folder}/posterior_noise.json" for folder in folders],
    }


POSTERIORS, COMMON_POSTERIORS = posteriors(CALIBRATIONS), posteriors(COMMON_CALIBRATIONS)
TRUTHS = expand("<results>/{case}/cohort/truth.json", case=GROUPS.virtual)
POSTERIORS_AND_TRUTHS = POSTERIORS | {"truths": TRUTHS}


def table_files(*names):
    return expand("<results>/tables/{name}.{suffix}", name=names, suffix=TABLE_SUFFIXES)


def reported_tables(*names):
    """Files of tables, of which Snakemake's report shows the CSV."""
    shown, *others = (expand(f"<results>/tables/{{name}}.{suffix}", name=names) for suffix in TABLE_SUFFIXES)
    return [*report(shown, caption="../report/table.rst", category="Tables"), *others[0], *others[1]]


def figure_files(name, caption, category="{case}"):
    """Files of a figure, which Snakemake's report shows with a caption of workflow/report."""
    shown, *others = expand("<results>/figures/{name}.{suffix}", name=name, suffix=STUDY.figures)
    return [report(shown, caption=f"../report/{caption}.rst", category=category), *others]


def cause_card(folder):
    """Files of a cause card, of which Snakemake's report shows the figure."""
    shown = report(f"{folder}/cause.png", caption="../report/cause.rst", category="{case}")
    return [f"{folder}/cause.json", f"{folder}/cause.md", shown, f"{folder}/traces.json"]


def verification_files(*names):
    return [f"<results>/{{case}}/{{setting}}/verification/{name}" for name in names]


def sigma_point_beats(wildcards):
    """Beats of all sigma points of a case; their number follows from the setting."""
    return list_sigma_point_beats(wildcards.case, wildcards.setting)


def first_estimate(wildcards):
    """Posterior of the first iteration, about which a second one draws its points; empty in a first iteration."""
    first = STUDY.first_step(wildcards.setting)
    return [] if first == wildcards.setting else [f"<results>/{{case}}/{first}/calibration/posterior.json"]


def beat_at_prior(wildcards):
    """Beat at the prior's mean, the central sigma point of the first iteration."""
    return f"<results>/{{case}}/{STUDY.first_step(wildcards.setting)}/calibration/beats/0.json"


def list_sigma_point_beats(case, setting):
    return expand(
        "<results>/{case}/{setting}/calibration/beats/{point}.json",
        case=case,
        setting=setting,
        point=STUDY.sigma_points(setting, CASES[case]),
    )


def perturbation_beats(wildcards):
    """Beats at one-at-a-time perturbations about the prior's mean, for the sensitivities."""
    return list_perturbation_beats(wildcards.setting)


def list_perturbation_beats(setting):
    return expand(surrounding_files(".json"), setting=setting)


def surrounding_files(suffix):
    """Pattern of the file of each one-at-a-time perturbation of a setting."""
    points = range(2 * len(STUDY.sensitivity.parameters) + 1)
    return [f"<results>/sensitivity/{{setting}}/beats/{point}{suffix}" for point in points]


def sensitivities(wildcards):
    """Sensitivities of the left and of the right observations to the parameters of the setting's model."""
    folder = f"<results>/sensitivity/{PERTURBED_AS[wildcards.setting]}"
    return [f"{folder}/sensitivity.json", f"{folder}/right.json"]


def calibrated_shapes(cases):
    """Shapes of the calibrated motions of some cases in all settings."""
    return expand("<results>/{case}/{setting}/verification/shape.csv", case=cases, setting=COMMON_SETTINGS)


def wall_files(wildcards):
    """Files that hold the wall of a measured case."""
    return source_files(source_of(wildcards))


def source_images(wildcards):
    """Images of a measured case, in the user's folder."""
    return source_of(wildcards).images


def pressure_recording(wildcards):
    """Recording of a measured case's pressure, several beats long."""
    return source_of(wildcards).pressure.file


def pressure_curve(wildcards):
    """Pressure of one beat of a case; empty without a recording."""
    folder = "curves" if wildcards.case in RECORDED else "cohort"
    return [f"<results>/{{case}}/{folder}/pressure.csv"] if case_of(wildcards).catheter else []


def noise_model(wildcards):
    """Noise model of the virtual images; empty for a measured heart, whose images it does not describe."""
    return [NOISE_MODEL] if wildcards.case in VIRTUAL else []


def template_file(use):
    """Template of the meshes of this use: stored, or of a size that this study meshes."""
    return stored_template(STUDY.templates()[use]) or f"<results>/templates/{use}.vtu"


def hidden_template(wildcards):
    """Template of the hidden mesh of a virtual case."""
    return template_file("sealed" if wildcards.case in SEALED else "generator")


def hidden_effects(wildcards):
    """Sealed effects of a virtual case; empty for a volunteer or patient, who has none."""
    return [f"<results>/{wildcards.case}/cohort/effects.sealed"] if wildcards.case in SEALED else []


def model_template(wildcards):
    """Template of the mesh on which a virtual case is calibrated."""
    return template_file("coarse" if wildcards.case in SEALED else "calibrator")


TEMPLATES = [
    *(["generator", "calibrator"] if VIRTUAL else []),
    *(["sealed", "coarse"] if SEALED else []),
    *(["registration_error"] if VIRTUAL and NOISE_MODEL == LEARNT_NOISE else []),
]
# all that a mesher makes, by name
MESHES = {
    **{f"template {use}": template_file(use) for use in TEMPLATES},
    **{case: f"<results>/{case}/geometry/mesh.vtu" for case in WITHOUT_TRUTH},
    **{
        f"{case}, coarse": f"<results>/{case}/discovery/mesh.vtu" for case, _ in REFITTED if case in COARSENED
    },
}


def refit_mesh(wildcards):
    """Mesh of the refits of a case."""
    folder = "discovery" if wildcards.case in COARSENED else "geometry"
    return f"<results>/{wildcards.case}/{folder}/mesh.vtu"


def refit_motion(wildcards):
    """Registered motion of the mesh of the refits."""
    folder = "discovery" if wildcards.case in COARSENED else "registration"
    return f"<results>/{wildcards.case}/{folder}/motion.npz"


def second_reading(wildcards):
    """Volume from the blood of a measured heart's images; empty without images next to a fitted surface."""
    return (
        [f"<results>/{wildcards.case}/curves/blood_volume.csv"]
        if wildcards.case in FITTED_WITH_IMAGES
        else []
    )


def registered_sequences(acquisition, numbers):
    """Comparisons of registered with true motion, of numbered sequences of an acquisition."""
    return expand(f"<results>/registration_error/{acquisition}/{{number}}.json", number=numbers)


def calibrated_beats(kind):
    """Return an input function: a file of the calibrated beat, and of the refitted beat if there is one.

    The motion of a refit on another mesh is left out.
    """
    calibrated, refitted = {
        "beat": ("verification/beat.json", "beat.json"),
        "motion": ("verification/motion.npz", "motion.npz"),
        "fitted": ("calibration/posterior.json", "refit.json"),
    }[kind]

    def list_files(wildcards):
        case, setting = wildcards.case, wildcards.setting
        files = [f"<results>/{case}/{setting}/{calibrated}"]
        if (case, setting) in REFITTED and not (kind == "motion" and case in COARSENED):
            files.append(f"<results>/{case}/discovery/{setting}/none/{refitted}")
        return files

    return list_files


def stored_tables(_):
    """Stored tables that the study is held to, so that a renewed one is compared anew."""
    return sorted(map(str, Path(STUDY.reference).glob("*.*")))


def report_templates(_):
    """Templates of the report, which its code fingerprint does not cover."""
    return sorted(map(str, PACKAGE.glob("results/report/*/*.*")))


# figures about methods need hearts of known truth, which a study of measured hearts lacks
METHOD_FIGURES = (
    ["alternatives", "coverage_sphere", "registration", "noise_model", "sobol"]
    if STUDY.methods and VIRTUAL
    else []
)
CASE_FIGURES = [
    f"{case}_{setting}{topic}.{suffix}"
    for case, setting in CALIBRATIONS
    for topic in ("", "_sensitivity", "_shape", "_card")
    for suffix in STUDY.figures
]
STUDY_FIGURES = [
    *METHOD_FIGURES,
    *(["septal_flash"] if GROUPS.patients else []),
    *(f"{case}_activation" for case in CASES),
    *(f"sensitivity{topic}_{setting}" for topic in ("", "_curves") for setting in PERTURBED_SETTINGS),
    *(f"{case}_contours" for case in VIRTUAL + IMAGED if case not in SEALED),
    *(f"{case}_{COMMON_SETTINGS[-1]}_overlay" for case in SEPTAL_FLASH_CASES),
    *(f"{case}_cine_{topic}" for case in FITTED_WITH_IMAGES for topic in ("outlines", "volume")),
    *(f"residual_{case}_{setting}" for case, setting in CALIBRATIONS),
]
STUDY_TABLES = [
    "table1_as_printed",
    "table1",
    "claims",
    "cards",
    *(["specificity", "selection"] if VIRTUAL else []),
    *(f"sensitivity_{setting}" for setting in PERTURBED_SETTINGS),
]


def study_tables():
    return [
        *expand("<results>/tables/{name}.md", name=STUDY_TABLES),
        *expand("<results>/tables/{name}.csv", name=("posteriors", "curves", "meshes")),
    ]


def inference_data():
    return [f"<results>/{case}/{setting}/inference.nc" for case, setting in CALIBRATIONS]


def study_figures():
    return [
        *expand("<results>/figures/{file}", file=CASE_FIGURES),
        *expand("<results>/figures/{name}.png", name=STUDY_FIGURES),
    ]


def study_beats():
    """Beats of all sigma points and perturbations: Snakemake misses a deleted beat only if it is a target."""
    calibrations = [beat for pair in CALIBRATIONS for beat in list_sigma_point_beats(*pair)]
    return [*calibrations, *list_perturbation_beats(PERTURBED_SETTINGS)]


def study_causes():
    """Cause cards of the searches and of the configured 3-D proofs, with their scores and trials."""
    return [
        *expand(
            "<results>/{case}/discovery/{setting}/search/cause.json", case=CASES, setting=DISCOVERY.settings
        ),
        *(f"<results>/{case}/discovery/{setting}/cause.json" for case, setting in REFITTED),
        *(f"<results>/{case}/discovery/{setting}/wall/wall.json" for case, setting in WALLS),
        *(["<results>/tables/discovery.md"] if REFITTED else []),
        *(f"<results>/figures/trials_{case}_{setting}.png" for case, setting in REFITTED if DISCOVERY.trials),
    ]


def study_results():
    """All results of the study except the costs and the report, which read them."""
    return [*study_tables(), *inference_data(), *study_figures(), *study_beats(), *study_causes()]
