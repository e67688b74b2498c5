"""Draw the second cohort, seven healthy adults from normal values; writes config/normal_cases.tsv, some minutes.

python -m benchmarks.normal_cohort

Seeds are tried in turn from FIRST_SEED on; a heart is kept if its beat is within resources/plausible_beat.csv. The
patients are those of config/cases.tsv.
"""

import sys
from collections.abc import Iterator

from benchmarks.normal_adults import NormalAdult, abnormal, draw_adult
from benchmarks.ventricles import ROOT
from heartfit.calibration.plausible import Limit
from heartfit.io.configuration import read_study
from heartfit.io.files import write_text
from heartfit.io.noise_models import read_limits
from heartfit.io.templates import TEMPLATES, find_template
from heartfit.study.study import Study
from heartfit.synthetic.volunteer import Template, VolunteerError, generate, hide_heart

FIRST_SEED, COUNT = 2001, 7
TABLE = ROOT / "config" / "normal_cases.tsv"
LIMITS = ROOT / "resources" / "plausible_beat.csv"


def main() -> int:
    study = read_study([ROOT / "config" / "config.yaml"])
    template = find_template(study.registration_error.mesh, ROOT / TEMPLATES)
    head, *rows = (ROOT / study.cases).read_text(encoding="utf-8").splitlines()
    patients = [row for row in rows if "\tlbbb\t" in row]
    kept = normal_adults(study, template, read_limits(LIMITS))
    drawn = [row_of(f"normal{number}", seed, adult) for number, (seed, adult) in enumerate(kept, start=1)]
    write_text(TABLE, "\n".join([head, *drawn, *patients]) + "\n")
    return 0


def normal_adults(study: Study, template: Template, limits: list[Limit]) -> Iterator[tuple[int, NormalAdult]]:
    """Yield seed and adult of the first COUNT hearts with a normal beat, and print why others are left out."""
    seed, kept = FIRST_SEED, 0
    while kept < COUNT:
        adult = draw_adult(seed)
        reasons = judged(study, template, adult, seed, limits)
        sys.stdout.write(f"{seed}: {adult.sex}, {', '.join(reasons) or 'kept'}\n")
        sys.stdout.flush()
        if not reasons:
            kept += 1
            yield seed, adult
        seed += 1


def judged(study: Study, template: Template, adult: NormalAdult, seed: int, limits: list[Limit]) -> list[str]:
    """Limits that the beat of an adult violates on a coarse mesh."""
    hidden = hide_heart(study.cohort.heart, adult.ratios, adult.anatomy.period, seed)
    protocol = study.registration_error.protocol(study.end_diastolic_pressure)
    try:
        volunteer = generate(template.deformed_to(adult.anatomy.shape), hidden, protocol)
    except VolunteerError as failure:
        return [str(failure)]
    return abnormal(volunteer.beat, limits)


def row_of(name: str, seed: int, adult: NormalAdult) -> str:
    """Row of a table of cases."""
    shape, ratios = adult.anatomy.shape, adult.ratios
    volumes = (f"{1e6 * shape.edv:.0f}", f"{1e6 * shape.rv_edv:.0f}")
    walls = (f"{1e3 * shape.wall_thickness:.1f}", f"{1e3 * shape.rv_wall_thickness:.1f}")
    known = [name, "virtual", f"{adult.anatomy.period:.2f}", str(seed), "healthy", "", ""]
    form = [volumes[0], walls[0], f"{shape.sphericity:.2f}", volumes[1], walls[1]]
    return "\t".join([*known, *form, *(f"{ratios[name]:.3f}" for name in ("sigma_0", "mu", "c_1", "R_p"))])


if __name__ == "__main__":
    sys.exit(main())
