"""What is studied, by name."""

import re

from heartfit.tables.groups import Groups, Origin

STUDY, CASES, SOURCES = PLAN.study, PLAN.cases, PLAN.sources
SETTINGS = list(STUDY.settings)
SEGMENTED = [name for name, source in SOURCES.items() if source.segmented]
FITTED = [name for name, source in SOURCES.items() if not source.segmented]
IMAGED = [name for name, source in SOURCES.items() if source.images]
CINE = [name for name in FITTED if name in IMAGED]
RECORDED = [name for name, source in SOURCES.items() if source.pressure]
VIRTUAL = [name for name, case in CASES.items() if case.kind == "virtual"]
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
FRESH = range(ERROR.sequences, ERROR.sequences + ERROR.fresh)

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
