"""Healthy hearts of our own model in three dimensions, from whose beats structure is learnt, too."""

from collections.abc import Iterator

from benchmarks.normal_adults import abnormal, draw_adult
from benchmarks.ventricles import ROOT
from heartfit.io.configuration import read_study
from heartfit.io.noise_models import read_limits
from heartfit.io.templates import TEMPLATES, find_template
from heartfit.observation.beat import beat_curves
from heartfit.synthetic.other_worlds import OtherHeart
from heartfit.synthetic.volunteer import Volunteer, VolunteerError, generate, hide_heart

VENTRICLES = "ventricles"
"""Name of the model among the simulators."""
FIRST_SEED = 6001


def healthy_ventricles(count: int) -> list[OtherHeart]:
    """Return the first adults drawn from normal values whose beat on a coarse mesh is normal."""
    hearts = _healthy_volunteers()
    return [next(hearts) for _ in range(count)]


def _healthy_volunteers() -> Iterator[OtherHeart]:
    study = read_study([ROOT / "config" / "config.yaml"])
    template = find_template(study.registration_error.mesh, ROOT / TEMPLATES)
    protocol = study.registration_error.protocol(study.end_diastolic_pressure)
    limits = read_limits(ROOT / "resources" / "plausible_beat.csv")
    seed = FIRST_SEED
    while True:
        adult = draw_adult(seed)
        hidden = hide_heart(study.cohort.heart, adult.ratios, adult.anatomy.period, seed)
        try:
            volunteer = generate(template.deformed_to(adult.anatomy.shape), hidden, protocol)
        except VolunteerError:
            volunteer = None
        if volunteer is not None and not abnormal(volunteer.beat, limits):
            yield _as_other_heart(volunteer, seed)
        seed += 1


def _as_other_heart(volunteer: Volunteer, seed: int) -> OtherHeart:
    curves = beat_curves(volunteer.beat)
    return OtherHeart(VENTRICLES, seed, "", "", curves["lv_volume"], curves["lv_pressure"])
