"""Recordings of hearts of another model than the diagnoser's."""

from dataclasses import replace
from functools import cache

from heartfit.discovery.sphere_model.recording import Recording
from heartfit.synthetic.campaign import PlantedPlan
from heartfit.synthetic.case import plant

LEAK = PlantedPlan(1, "single", ("MitralRegurgitation",), 2.5)


@cache
def recorded(plan: PlantedPlan, condition: str = "rest") -> Recording:
    """Recording of a planted case."""
    curves = plant(replace(plan, reloaded=condition != "rest")).curves[condition]
    return Recording.from_curves(curves)


def healthy(seed: int) -> Recording:
    """A heart without an effect."""
    return recorded(PlantedPlan(seed, "none"))
