"""The files that a job needs, by its wildcards."""

from heartfit.io.sources import source_files


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


def sigma_point_beats(wildcards):
    return beats_of(wildcards.case, wildcards.setting)


def shapes_of(cases):
    """The calibrated motions of some cases in all settings."""
    return expand("<results>/{case}/{setting}/verification/shape.csv", case=cases, setting=SETTINGS)


def measured_files(wildcards):
    """The files of a measured case's wall."""
    return source_files(source_of(wildcards))


def given_images(wildcards):
    """The images of a measured case, where they lie."""
    return source_of(wildcards).images


def pressure_of(wildcards):
    """The recorded pressure of a case, where there is one."""
    folder = "curves" if wildcards.case in RECORDED else "cohort"
    return [f"<results>/{{case}}/{folder}/pressure.csv"] if case_of(wildcards).catheter else []


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
