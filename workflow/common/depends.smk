"""What a job rests on besides its files: code, configuration, memory and time."""

import inspect
from functools import cache
from pathlib import Path

from heartfit.io.fingerprint import PACKAGE, fingerprint
from heartfit.io.measured_costs import NEEDS, read_table
from heartfit.mechanism import registered
from heartfit.planning.need import Need, largest

TAKEN = read_table(Need, Path(workflow.basedir, "resources", NEEDS))


@cache
def rests_on(file):
    """The fingerprint of a file and all library modules it rests on; see heartfit.io.fingerprint."""
    return fingerprint(Path(file))


def code(script):
    """The fingerprint of a script, found when a job asks: one that runs on its own takes that of its own only."""
    return lambda wildcards: rests_on(Path(workflow.basedir, "workflow", "scripts", script))


def stated(*parts):
    """What parts of the configuration say, for a job: Snakemake notices a change of text, but not of an object."""
    return lambda wildcards: [repr(part(wildcards) if callable(part) else part) for part in parts]


def mechanisms_of(wildcards):
    """The fingerprint of each mechanism that the setting adds: scripts load them by name, which code() cannot see."""
    known = registered()
    return {name: rests_on(inspect.getfile(known[name])) for name in setting_of(wildcards).mechanisms}


def planted_of(wildcards):
    """The fingerprint of the mechanism that a virtual case hides, if any."""
    return [rests_on(inspect.getfile(type(each))) for each in case_of(wildcards).planted()]


def every_mechanism(_):
    """The fingerprint of each mechanism: a search tries them all by name."""
    return {name: rests_on(inspect.getfile(kind)) for name, kind in registered().items()}


def mechanism_of(wildcards):
    """The fingerprint of the one mechanism that a job tries."""
    return every_mechanism(wildcards)[wildcards.mechanism]


def report_parts(_):
    """What a page of the report is filled into: no module, so that code() does not see it."""
    return sorted(map(str, PACKAGE.glob("report/*/*.*")))


def needs(job):
    """Memory and time to ask a cluster for, from what such jobs took; on each further attempt as much again."""
    need = largest(TAKEN, job)
    return {
        "mem_mb": lambda wildcards, attempt: attempt * need.megabytes(),
        "runtime": lambda wildcards, attempt: attempt * need.minutes(),
    }
