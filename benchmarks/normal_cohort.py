"""Draw the second cohort, seven healthy adults from normal values; writes config/normal_cases.tsv, some minutes.

python -m benchmarks.normal_cohort

Seeds are tried in turn from FIRST_SEED on; a heart is kept if its beat is within resources/plausible_beat.csv. The
patients are those of config/cases.tsv.
"""

import sys
from collections.abc import Iterator
from itertools import count, islice

from benchmarks.normal_adults import NormalAdult, abnormal, draw_adult
from benchmarks.ventricles import ROOT
from heartfit.io.configuration import read_study
from heartfit.io.files import write_text
from heartfit.io.noise_models import read_limits
from heartfit.io.templates import TEMPLATES, find_template
from heartfit.synthetic.volunteer import Volunteer, VolunteerError, generate, hide_heart

FIRST_SEED, COUNT = 2001, 7
CONFIGURATION = ROOT / "config" / "config.yaml"
TABLE = ROOT / "config" / "normal_cases.tsv"
LIMITS = ROOT / "resources" / "plausible_beat.csv"


def main() -> int:
    head, *rows = (ROOT / read_study([CONFIGURATION]).cases).read_text(encoding="utf-8").splitlines()
    patients = [row for row in rows if "\tlbbb\t" in row]
    kept = enumerate(islice(normal_hearts(FIRST_SEED), COUNT), start=1)
    drawn = [row_of(f"normal{number}", seed, adult) for number, (seed, adult, _) in kept]
    write_text(TABLE, "\n".join([head, *drawn, *patients]) + "\n")
    return 0


def normal_hearts(first_seed: int) -> Iterator[tuple[int, NormalAdult, Volunteer]]:
    """Yield seed, adult and beat on a coarse mesh of hearts whose beat is normal; print why others are left out."""
    study, limits = read_study([CONFIGURATION]), read_limits(LIMITS)
    template = find_template(study.registration_error.mesh, ROOT / TEMPLATES)
    protocol = study.registration_error.protocol(study.end_diastolic_pressure)
    for seed in count(first_seed):
        adult = draw_adult(seed)
        hidden = hide_heart(study.cohort.heart, adult.ratios, adult.anatomy.period, seed)
        try:
            volunteer = generate(template.deformed_to(adult.anatomy.shape), hidden, protocol)
            reasons = abnormal(volunteer.beat, limits)
        except VolunteerError as failure:
            reasons = [str(failure)]
        sys.stdout.write(f"{seed}: {adult.sex}, {', '.join(reasons) or 'kept'}\n")
        sys.stdout.flush()
        if not reasons:
            yield seed, adult, volunteer


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
