"""Log, benchmark, memory and time of every job, and fingerprints of its code and its configuration."""

import inspect
from functools import cache
from pathlib import Path

from snakemake.exceptions import WorkflowError
from snakemake.resources import Resources

from heartfit.io.fingerprint import fingerprint
from heartfit.io.campaign import NEEDS, read_table
from heartfit.roles import registered
from heartfit.study.need import SHARED, Need, largest
from heartfit.synthetic.campaign import DRAWN

MEASURED_COSTS = read_table(Need, Path(workflow.basedir, "resources", NEEDS))
# rules that do the same work on other data share a name in logs, benchmarks and resources/costs.tsv
JOB_NAMES = {
    "build_measured_mesh": "build_mesh",
    "build_volunteer_mesh": "build_mesh",
    "register_measured": "register",
    "register_segmented": "register",
    "register_volunteer": "register",
    "try_acquisition": "try",
}
FOLDER_WILDCARDS = ("case", "setting", "acquisition")
DOWNLOADS = ("fetch_measured_heart",)  # a change of the code does not repeat a download


def complete_rules(rules):
    """Add the code fingerprint to each rule with a script, and log, benchmark and resources unless it states them.

    Resources of the command line (--set-resources) take precedence. Call it once, after all rules are defined.
    """
    for definition in rules:
        if definition.script is None:
            continue
        script = Path(definition.script)
        if not definition.log:
            definition.log_modifier = definition.output_modifier
            definition.set_log(f"<logs>/{job_path(definition)}.log")
        if not definition.benchmark:
            definition.benchmark_modifier = definition.output_modifier
            definition.benchmark = f"<benchmarks>/{job_path(definition)}.tsv"
        if definition.ruleinfo.resources is None:
            command_line = workflow.resource_settings.overwrite_resources.get(definition.name, {})
            definition.resources.update(Resources.from_mapping(measured_resources(script.stem)))
            definition.resources.update(Resources.from_mapping(command_line))
        if definition.name not in DOWNLOADS:
            definition.set_params(code=code_fingerprint(script.name))


def job_path(definition):
    """Path of a job's log below logs/ and of its benchmark below benchmarks/, without suffix: <folders>/<name>_<number>.

    Each stage that runs once for all cases has a folder; heartfit.study.need parses these paths.
    """
    stage = Path(definition.snakefile).stem
    folders = [stage] if stage in SHARED else []
    folders += [f"{{{name}}}" for name in FOLDER_WILDCARDS if name in definition.wildcard_names]
    numbers = [f"{{{name}}}" for name in sorted(definition.wildcard_names - {*FOLDER_WILDCARDS})]
    name = "_".join([JOB_NAMES.get(definition.name, definition.name), *numbers])
    return Path(*folders, name).as_posix()


def measured_resources(script):
    """Memory (MB) and time (min) to request, from measured costs of such jobs, multiplied by the attempt."""
    job = JOB_NAMES.get(script, script)
    try:
        need = largest(MEASURED_COSTS, job)
    except KeyError:
        raise WorkflowError(
            f"resources/{NEEDS}: no job {job}; expected its measured costs: state mem_mb and runtime in the rule"
        ) from None
    return {
        "mem_mb": lambda wildcards, attempt: attempt * need.megabytes(),
        "runtime": lambda wildcards, attempt: attempt * need.minutes(),
    }


@cache
def file_fingerprint(file):
    """Fingerprint of a file and of all modules of the library that it imports; see heartfit.io.fingerprint."""
    return fingerprint(Path(file))


def code_fingerprint(script):
    """Fingerprint of a script, evaluated per job: a job on another machine reads only its script."""
    return lambda wildcards: file_fingerprint(Path(workflow.basedir, "workflow", "scripts", script))


def setting_mechanisms(wildcards):
    """Fingerprint of each mechanism that the setting adds; scripts load mechanisms by name, without an import."""
    classes = registered()
    return {
        name: file_fingerprint(inspect.getfile(classes[name])) for name in setting_of(wildcards).mechanisms
    }


def planted_mechanisms(wildcards):
    """Fingerprint of each mechanism that a virtual case may add to its true heart: of all if it is drawn."""
    plant, library = case_of(wildcards).plant, library_mechanisms(wildcards)
    return library if plant == DRAWN else {name: code for name, code in library.items() if name == plant}


def library_mechanisms(_):
    """Fingerprint of each mechanism of the library, for a search that tries all of them."""
    return {name: file_fingerprint(inspect.getfile(kind)) for name, kind in registered().items()}


def tried_mechanism(wildcards):
    """Fingerprint of the one mechanism that a job tries."""
    return library_mechanisms(wildcards)[wildcards.mechanism]


def configuration_text(*parts):
    """Text of parts of the configuration: Snakemake detects changes of text, but not of objects."""
    return lambda wildcards: [repr(part(wildcards) if callable(part) else part) for part in parts]
