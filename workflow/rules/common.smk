import inspect
import os
import re
from functools import cache
from pathlib import Path

from snakemake.exceptions import WorkflowError

from heartfit.errors import InputError
from heartfit.io.configuration import read_configuration
from heartfit.io.fingerprint import PACKAGE, fingerprint
from heartfit.io.measured_costs import NEEDS, read_table
from heartfit.io.plan import plan_study
from heartfit.io.run import Run
from heartfit.io.sources import source_files
from heartfit.io.sums import keep_sums
from heartfit.mechanism import registered
from heartfit.planning.need import Need, largest
from heartfit.tables.groups import Groups, Origin

# one thread a job: the jobs are what runs in parallel
for library in ("OMP", "OPENBLAS", "MKL", "NUMBA"):
    os.environ[f"{library}_NUM_THREADS"] = "1"

try:
    read_configuration(map(Path, workflow.configfiles))  # Snakemake lets pass a key that stands twice
    PLAN = plan_study(config, thorough=workflow.is_main_process)
    RUN = Run(PLAN.study.results) if workflow.is_main_process else None  # and not a job on another machine
except InputError as problem:
    raise WorkflowError(str(problem)) from None
for line in [PLAN.left_out, *(RUN.put_in_order() if RUN else [])]:
    if line:
        logger.warning(line)

STUDY, CASES, SOURCES = PLAN.study, PLAN.cases, PLAN.sources
SETTINGS = list(STUDY.settings)
SEGMENTED = [name for name, source in SOURCES.items() if source.segmented]
FITTED = [name for name, source in SOURCES.items() if not source.segmented]
IMAGED = [name for name, source in SOURCES.items() if source.images]
CINE = [name for name in FITTED if name in IMAGED]
RECORDED = [name for name, source in SOURCES.items() if source.pressure]
VIRTUAL = [name for name, case in CASES.items() if case.kind == "virtual"]
HEALTHY = [name for name, case in CASES.items() if case.healthy]
PATIENTS = [name for name, case in CASES.items() if not case.healthy]
GROUPS = Groups(
    volunteers=tuple(name for name in VIRTUAL if CASES[name].healthy),
    measured=tuple(name for name in SOURCES if CASES[name].healthy),
    patients=tuple(name for name in VIRTUAL if not CASES[name].healthy),
    measured_patients=tuple(name for name in SOURCES if not CASES[name].healthy),
)
DYSSYNCHRONY = [*GROUPS.volunteers[:1], *GROUPS.patients]
HIDDEN = {
    "mesh": "heart.vtu",
    "motion": "motion.npz",
    "beat": "beat.json",
    "curves": "beat.csv",
    "truth": "truth.json",
}
CATHETERISED = [name for name in VIRTUAL if CASES[name].catheter]

ERROR = STUDY.registration_error
DISCOVERY = STUDY.discovery
PROVED = [(case, setting) for case in DISCOVERY.cases if case in CASES for setting in DISCOVERY.settings]
EVALUATED = [(case, setting) for case, setting in PROVED if CASES[case].kind == "virtual"]
NOISE_MODEL = "<results>/registration_error/noise_model.json"
TRIED = {
    "baseline": range(ERROR.sequences),
    **{acquisition: range(ERROR.varied_sequences) for acquisition in ERROR.acquisitions()},
}
TRIALS = [(acquisition, number) for acquisition, numbers in TRIED.items() for number in numbers]
# what is learnt of methods from hearts whose truth is known; a study of measured hearts alone does without
OF_METHODS = ["alternatives", "coverage_sphere", "registration", "noise_model", "sobol"] if VIRTUAL else []
PICTURES = [
    *OF_METHODS,
    *(["septal_flash"] if GROUPS.patients else []),
    *(f"{case}_activation" for case in CASES),
    *(f"sensitivity{about}_{setting}" for about in ("", "_curves") for setting in SETTINGS),
    *(f"{case}_contours" for case in VIRTUAL + IMAGED),
    *(f"{case}_{SETTINGS[-1]}_overlay" for case in DYSSYNCHRONY),
    *(f"{case}_cine_{about}" for case in CINE for about in ("outlines", "volume")),
    *(f"residual_{case}_{setting}" for case in CASES for setting in SETTINGS),
]
CASE_PICTURES = [
    f"{case}_{setting}{about}.{kind}"
    for case in CASES
    for setting in SETTINGS
    for about in ("", "_sensitivity", "_shape", "_card")
    for kind in ("png", "pdf")
]
TABLES = [
    "table1",
    "cards",
    *(["specificity", "selection"] if VIRTUAL else []),
    *(f"sensitivity_{setting}" for setting in SETTINGS),
]
FRESH = range(ERROR.sequences, ERROR.sequences + ERROR.fresh)

TAKEN = read_table(Need, Path(workflow.basedir, "resources", NEEDS))
BATCHES = dict(enumerate(STUDY.discovery_benchmark.batches()))
VENTRICLES = STUDY.discovery_benchmark.ventricles
HIDDEN_IN_3D = dict(enumerate(VENTRICLES.plans()))


wildcard_constraints:
    case="|".join(CASES),
    setting="|".join(SETTINGS),
    point=r"\d+",
    number=r"\d+",
    acquisition="|".join(map(re.escape, TRIED)),
    batch=r"\d+",
    mechanism=r"\w+",


onstart:
    keep_sums(STUDY.results)


def batch_of(wildcards):
    """The cases of a batch of hidden effects."""
    return BATCHES[int(wildcards.batch)]


def plan_of(wildcards):
    """The case that is hidden in three dimensions."""
    return HIDDEN_IN_3D[int(wildcards.number)]


@cache
def rests_on(file):
    """The fingerprint of a file and all library modules it rests on; see heartfit.io.fingerprint."""
    return fingerprint(Path(file))


def code(script):
    """The fingerprint of a script, found when a job asks: one that runs on its own takes that of its own only."""
    return lambda wildcards: rests_on(Path(workflow.basedir, "workflow", "scripts", script))


def needs(job):
    """Memory and time to ask a cluster for, from what such jobs took; on each further attempt as much again."""
    need = largest(TAKEN, job)
    return {
        "mem_mb": lambda wildcards, attempt: attempt * need.megabytes(),
        "runtime": lambda wildcards, attempt: attempt * need.minutes(),
    }


def printed(*names):
    """The files of tables by name."""
    return expand("<results>/tables/{name}.{suffix}", name=names, suffix=("csv", "md", "tex"))


def tabulated(*names):
    """The same, their CSV shown in Snakemake's report."""
    read, *others = (
        expand("<results>/tables/{name}.{suffix}", name=names, suffix=s) for s in ("csv", "md", "tex")
    )
    return [*report(read, caption="../report/table.rst", category="Tables"), *others[0], *others[1]]


def pictured(name, caption, category="{case}"):
    """The files of a figure by name, shown in Snakemake's report with a caption of workflow/report."""
    shown = report(f"<results>/figures/{name}.png", caption=f"../report/{caption}.rst", category=category)
    return [shown, f"<results>/figures/{name}.pdf"]


def cause_card(folder):
    """The files of a cause card, its figure shown in Snakemake's report."""
    shown = report(f"{folder}/cause.png", caption="../report/cause.rst", category="{case}")
    return [f"{folder}/cause.json", f"{folder}/cause.md", shown, f"{folder}/traces.json"]


def verified(*names):
    """The files of a case's calibrated beat by name."""
    return [f"<results>/{{case}}/{{setting}}/verification/{name}" for name in names]


def one_of(cases):
    """A wildcard constraint: one of these cases, or nothing that exists."""
    return "|".join(cases) or "no-such-case"


def stated(*parts):
    """What parts of the configuration say, for a job: Snakemake notices a change of text, but not of an object."""
    return lambda wildcards: [repr(part(wildcards) if callable(part) else part) for part in parts]


def template_size(wildcards):
    return STUDY.templates()[wildcards.template]


def case_of(wildcards):
    return CASES[wildcards.case]


def setting_of(wildcards):
    """The setting of a case, or as it is without pressures where a job concerns none."""
    return STUDY.setting(wildcards.setting, CASES.get(wildcards.get("case")))


def questioned(_):
    """The setting whose element is asked about; not before it is asked: a study may do without it."""
    return STUDY.questioned()


def mechanisms_of(wildcards):
    """The fingerprint of each mechanism that the setting adds: scripts load them by name, which code() cannot see."""
    known = registered()
    return {name: rests_on(inspect.getfile(known[name])) for name in setting_of(wildcards).mechanisms}


def beats_of(case, setting):
    """The beats of all sigma points of a case, whose number follows from the setting."""
    return expand(
        "<results>/{case}/{setting}/calibration/beats/{point}.json",
        case=case,
        setting=setting,
        point=STUDY.sigma_points(setting, CASES[case]),
    )


def surroundings(setting):
    """The beats about the prior's mean on which the sensitivities rest."""
    points = range(2 * len(STUDY.sensitivity.parameters) + 1)
    return expand("<results>/sensitivity/{setting}/beats/{point}.json", setting=setting, point=points)


def surrounding_beats(wildcards):
    return surroundings(wildcards.setting)


def surroundings_of(wildcards):
    """The setting that frees all parameters that are tried about the prior's mean."""
    return STUDY.surroundings(wildcards.setting)


def results_folder(_):
    """The folder of all that is computed; a function, or Snakemake's lint takes it for a path written out."""
    return STUDY.results


def shapes_of(cases):
    """The calibrated motions of some cases in all settings."""
    return expand("<results>/{case}/{setting}/verification/shape.csv", case=cases, setting=SETTINGS)


def sigma_point_beats(wildcards):
    return beats_of(wildcards.case, wildcards.setting)


def source_of(wildcards):
    """The data of a measured case."""
    return SOURCES[wildcards.case]


def wall_of(wildcards):
    """The same but for the pressure, which neither mesh nor motion rests on."""
    return source_of(wildcards).model_copy(update={"pressure": None})


def measured_files(wildcards):
    """The files of a measured case's wall."""
    return source_files(source_of(wildcards))


def given_images(wildcards):
    """The images of a measured case, where they lie."""
    return source_of(wildcards).images


def noise_of(wildcards):
    """The noise model of the volunteers' images; none was made for those of a measured heart."""
    return [NOISE_MODEL] if wildcards.case in VIRTUAL else []


def sequences_of_known_truth(wildcards):
    """What was learnt of the strain that registration finds in such images; nothing of a measured heart's."""
    numbers = TRIED["baseline"] if wildcards.case in VIRTUAL else ()
    return expand("<results>/registration_error/baseline/{number}.json", number=numbers)


def calibrated_beats(kind):
    """The files of one kind of a case's calibrated beat, then of the refitted one where there is one."""
    calibrated = {
        "beat": "verification/beat.json",
        "motion": "verification/motion.npz",
        "fitted": "calibration/posterior.json",
    }
    refitted = {"beat": "beat.json", "motion": "motion.npz", "fitted": "refit.json"}

    def files(wildcards):
        case, setting = wildcards.case, wildcards.setting
        found = [f"<results>/{case}/{setting}/{calibrated[kind]}"]
        if (case, setting) in PROVED:
            found.append(f"<results>/{case}/discovery/{setting}/none/{refitted[kind]}")
        return found

    return files


def planted_of(wildcards):
    """The fingerprint of the mechanism that a virtual case hides, if any."""
    return [rests_on(inspect.getfile(type(each))) for each in case_of(wildcards).planted()]


def every_mechanism(_):
    """The fingerprint of each mechanism: a search tries them all by name."""
    return {name: rests_on(inspect.getfile(kind)) for name, kind in registered().items()}


def mechanism_of(wildcards):
    """The fingerprint of the one mechanism that a job tries."""
    return every_mechanism(wildcards)[wildcards.mechanism]


def pressure_of(wildcards):
    """The recorded pressure of a case, where there is one."""
    folder = "curves" if wildcards.case in RECORDED else "cohort"
    return [f"<results>/{{case}}/{folder}/pressure.csv"] if case_of(wildcards).catheter else []


def recording_of(wildcards):
    """The file of a measured case's recorded pressure."""
    return source_of(wildcards).pressure.file


def scanner_of(wildcards):
    return STUDY.scanner(wildcards.acquisition)


def report_parts(_):
    """What a page of the report is filled into: no module, so that code() does not see it."""
    return sorted(map(str, PACKAGE.glob("report/*/*.*")))


def whole_study():
    """All that the study makes, but for what it took."""
    return [
        *expand("<results>/tables/{name}.md", name=TABLES),
        *expand("<results>/tables/{name}.csv", name=("posteriors", "curves")),
        *expand("<results>/{case}/{setting}/inference.nc", case=CASES, setting=SETTINGS),
        *expand("<results>/figures/{picture}", picture=CASE_PICTURES),
        *expand("<results>/figures/{about}.png", about=PICTURES),
        # asked for by name, or Snakemake would not miss a beat that was deleted
        *(beat for case in CASES for setting in SETTINGS for beat in beats_of(case, setting)),
        *surroundings(SETTINGS),
        *expand(
            "<results>/{case}/discovery/{setting}/search/cause.json", case=CASES, setting=DISCOVERY.settings
        ),
        *(f"<results>/{case}/discovery/{setting}/cause.json" for case, setting in PROVED),
        *(["<results>/tables/discovery.md"] if EVALUATED else []),
        *(f"<results>/figures/trials_{case}_{setting}.png" for case, setting in PROVED if DISCOVERY.trials),
    ]
