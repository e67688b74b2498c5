"""What the study says of the wildcards of a job."""


def one_of(cases):
    """A wildcard constraint: one of these cases, or nothing that exists."""
    return "|".join(cases) or "no-such-case"


def batch_of(wildcards):
    """The cases of a batch of hidden effects."""
    return BATCHES[int(wildcards.batch)]


def plan_of(wildcards):
    """The case that is hidden in three dimensions."""
    return HIDDEN_IN_3D[int(wildcards.number)]


def template_size(wildcards):
    return STUDY.templates()[wildcards.template]


def case_of(wildcards):
    return CASES[wildcards.case]


def filling_of(wildcards):
    """The pressures of a case at end diastole."""
    return STUDY.filling(case_of(wildcards))


def setting_of(wildcards):
    """The setting of a case, or as it is without pressures where a job concerns none."""
    return STUDY.setting(wildcards.setting, CASES.get(wildcards.get("case")))


def questioned(_):
    """The setting whose element is asked about; not before it is asked: a study may do without it."""
    return STUDY.questioned()


def surroundings_of(wildcards):
    """The setting that frees all parameters that are tried about the prior's mean."""
    return STUDY.surroundings(wildcards.setting)


def results_folder(_):
    """The folder of all that is computed; a function, or Snakemake's lint takes it for a path written out."""
    return STUDY.results


def source_of(wildcards):
    """The data of a measured case."""
    return SOURCES[wildcards.case]


def wall_of(wildcards):
    """The same but for the pressure, which neither mesh nor motion rests on."""
    return source_of(wildcards).model_copy(update={"pressure": None})


def recording_of(wildcards):
    """The file of a measured case's recorded pressure."""
    return source_of(wildcards).pressure.file


def scanner_of(wildcards):
    return STUDY.scanner(wildcards.acquisition)
