"""The configured study: its cases and settings by name, and the element of the study that a job's wildcards select."""

import os
import re
from pathlib import Path

from snakemake.exceptions import WorkflowError

from heartfit.core.errors import InputError
from heartfit.io.configuration import read_configuration
from heartfit.io.plan import plan_study
from heartfit.io.run import Run
from heartfit.io.files import keep_sums
from heartfit.io.jitter import MEMBER
from heartfit.results.case import Groups, Origin
from heartfit.results.colours import setting_colours

# one thread per job: Snakemake runs the jobs in parallel
for library in ("OMP", "OPENBLAS", "MKL", "NUMBA"):
    os.environ[f"{library}_NUM_THREADS"] = "1"

try:
    read_configuration(map(Path, workflow.configfiles))  # refuses duplicate keys, which Snakemake accepts
    PLAN = plan_study(config, thorough=workflow.is_main_process)
    RUN = Run(PLAN.study.results) if workflow.is_main_process else None  # jobs leave earlier results alone
except InputError as problem:
    raise WorkflowError(str(problem)) from None
for line in [PLAN.left_out, *(RUN.put_in_order() if RUN else [])]:
    if line:
        logger.warning(line)


onstart:
    keep_sums(PLAN.study.results)
    # with a limit of jobs a second the scheduler looks again, for ever, for each job that has finished: a tenth of a core
    if workflow.local_exec:
        workflow.scheduler.job_rate_limiter = None


def say_what_is_left_out():
    if PLAN.left_out:
        logger.warning(PLAN.left_out)


onsuccess:
    say_what_is_left_out()


onerror:
    say_what_is_left_out()


STUDY, CASES, SOURCES = PLAN.study, PLAN.cases, PLAN.sources
os.environ[MEMBER] = str(STUDY.jitter)
SETTINGS = list(STUDY.settings)
COLOURS = setting_colours(SETTINGS)
COMMON_SETTINGS = list(STUDY.common_settings())
CALIBRATIONS = [(name, setting) for name, case in CASES.items() for setting in STUDY.settings_of(case)]
# those of the cohort, which the tables compare
COMMON_CALIBRATIONS = [
    (case, setting)
    for case, setting in CALIBRATIONS
    if setting in COMMON_SETTINGS and CASES[case].kind != "sealed"
]
# settings whose perturbed beats are simulated; others of the same model and prior use them too
PERTURBED_AS = {setting: STUDY.perturbed_as(setting) for setting in SETTINGS}
PERTURBED_SETTINGS = list(dict.fromkeys(PERTURBED_AS.values()))


def cases_of_kind(kind):
    return [name for name, case in CASES.items() if case.kind == kind]


# names of cases, by what their data allow
SEALED = cases_of_kind("sealed")
WITHOUT_TRUTH = cases_of_kind("measured")
VIRTUAL = [name for name in CASES if name not in WITHOUT_TRUTH]
CATHETERISED = [name for name in VIRTUAL if CASES[name].catheter]
SEGMENTED = [name for name, source in SOURCES.items() if source.segmented]
FITTED = [name for name, source in SOURCES.items() if not source.segmented]
IMAGED = [name for name, source in SOURCES.items() if source.images]
FITTED_WITH_IMAGES = [name for name in FITTED if name in IMAGED]
RECORDED = [name for name, source in SOURCES.items() if source.pressure]
GROUPS = Groups(
    volunteers=tuple(name for name in cases_of_kind("virtual") if CASES[name].healthy),
    measured=tuple(name for name in WITHOUT_TRUTH if CASES[name].healthy),
    patients=tuple(name for name in cases_of_kind("virtual") if not CASES[name].healthy),
    measured_patients=tuple(name for name in WITHOUT_TRUTH if not CASES[name].healthy),
)
SEPTAL_FLASH_CASES = [*GROUPS.volunteers[:1], *GROUPS.patients]

# virtual image sequences of known motion, numbered by acquisition: the noise model learns from the baseline's
REGISTRATION_ERROR = STUDY.registration_error
SEQUENCES = {
    "baseline": range(REGISTRATION_ERROR.sequences),
    **{name: range(REGISTRATION_ERROR.varied_sequences) for name in REGISTRATION_ERROR.acquisitions()},
}
VALIDATION_SEQUENCES = range(
    REGISTRATION_ERROR.sequences, REGISTRATION_ERROR.sequences + REGISTRATION_ERROR.fresh
)

# cases and settings whose heart is refitted and extended in 3-D; measured ones on a coarse mesh of their own
DISCOVERY = STUDY.discovery
REFITTED = STUDY.refitted(CASES)
WALLS = [(case, setting) for case in DISCOVERY.walls if case in CASES for setting in DISCOVERY.settings]
COARSENED = [case for case in WITHOUT_TRUTH if DISCOVERY.coarse is not None]

# cases of the discovery benchmark: batches of spheres, and single ventricles by number
SPHERE_BATCHES = dict(enumerate(STUDY.discovery_benchmark.batches()))
VENTRICLES = STUDY.discovery_benchmark.ventricles
VENTRICLE_CASES = dict(enumerate(VENTRICLES.plans()))


wildcard_constraints:
    case="|".join(CASES),
    setting="|".join(SETTINGS),
    point=r"\d+",
    number=r"\d+",
    acquisition="|".join(map(re.escape, SEQUENCES)),
    batch=r"\d+",
    mechanism=r"\w+",
    reading="first|second",


def match_any(names):
    """Wildcard constraint: one of these names; none of them, where the list is empty."""
    return "|".join(names) or "no-such-case"


def case_of(wildcards):
    return CASES[wildcards.case]


def curves_besides(wildcards):
    """Curves of a case that are observed besides those of the left ventricle."""
    return STUDY.curves_besides(case_of(wildcards))


def numerics_of(wildcards):
    """Numerics of the model that is calibrated to a case."""
    return STUDY.calibrator(case_of(wildcards)).numerics


def mesh_size_of(wildcards):
    """Size of the mesh on which a case is calibrated."""
    return STUDY.calibrator(case_of(wildcards)).mesh


def refit_numerics_of(wildcards):
    """Numerics of the refits of a case."""
    return STUDY.refit_model(case_of(wildcards)).numerics


def cohort_of(wildcards):
    """Generation of a virtual case."""
    return STUDY.cohort_of(case_of(wildcards))


def filling_pressures_of(wildcards):
    """Pressures of a case at end diastole."""
    return STUDY.filling_pressures(case_of(wildcards))


def setting_of(wildcards):
    """Setting for a case; without the case's pressures where a job has no case."""
    return STUDY.setting(wildcards.setting, CASES.get(wildcards.get("case")))


def colour_of(wildcards):
    """Colour of a setting in all figures."""
    return COLOURS[wildcards.setting]


def perturbed_setting_of(wildcards):
    """Setting that frees all parameters which are perturbed one at a time about the prior's mean."""
    return STUDY.perturbation_setting(wildcards.setting)


def element_setting(_):
    """Setting in which two elements are compared; a function, since a study may have none."""
    return STUDY.element_setting()


def warping_setting(_):
    """Setting of the simulation that warps the images."""
    return STUDY.setting(COMMON_SETTINGS[-1])


def template_size_of(wildcards):
    return STUDY.templates()[wildcards.template]


def source_of(wildcards):
    """Data of a measured case."""
    return SOURCES[wildcards.case]


def source_without_pressure(wildcards):
    """Data of a measured case that its mesh and motion depend on."""
    return source_of(wildcards).model_copy(update={"pressure": None})


def scanner_of(wildcards):
    return STUDY.scanner(wildcards.acquisition)


def sphere_batch_of(wildcards):
    return SPHERE_BATCHES[int(wildcards.batch)]


def ventricle_case_of(wildcards):
    return VENTRICLE_CASES[int(wildcards.number)]


def tables_folder(_):
    """Folder of all tables; a function, for the same reason as the next one."""
    return f"{STUDY.results}/tables"


def results_folder(_):
    """Folder of all results; a function, since Snakemake's lint takes the text for a hard-coded prefix of outputs."""
    return STUDY.results
