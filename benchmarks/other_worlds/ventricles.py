"""Healthy hearts of our own model in three dimensions, from whose beats structure is learnt, too."""

from itertools import islice

from benchmarks.normal_cohort import normal_hearts
from heartfit.observation.beat import beat_curves
from heartfit.synthetic.other_worlds import OtherHeart
from heartfit.synthetic.volunteer import Volunteer

VENTRICLES = "ventricles"
"""Name of the model among the simulators."""
FIRST_SEED = 6001


def healthy_ventricles(count: int) -> list[OtherHeart]:
    """Return the first adults drawn from normal values whose beat on a coarse mesh is normal."""
    return [
        _as_other_heart(volunteer, seed) for seed, _, volunteer in islice(normal_hearts(FIRST_SEED), count)
    ]


def _as_other_heart(volunteer: Volunteer, seed: int) -> OtherHeart:
    curves = beat_curves(volunteer.beat)
    return OtherHeart(VENTRICLES, seed, "", "", curves["lv_volume"], curves["lv_pressure"])
