"""What the ventricles can be coloured by."""

from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib import colormaps
from matplotlib.colors import to_hex, to_rgb

from heartfit.geometry.bullseye import REGIONS
from heartfit.report.record import CaseRecord

RIGHT = "#bbbbbb"
BASAL = ("#E69F00", "#56B4E9", "#009E73", "#F0E442", "#0072B2", "#CC79A7")
"""Okabe and Ito's, a sector each; paler towards the apex."""
PALER = {1: 0.0, 7: 0.35, 13: 0.6, 17: 0.8}
"""White in the colours of a ring, by its first segment."""
STRAIN, DISTANCE, ISOCHRONE = 40.0, 15.0, 10.0
"""Percent, mm and ms."""


def shades(cases: Sequence[CaseRecord]) -> dict[str, dict[str, Any]]:
    """Colours over their range and what they tell, by name; the same of all cases, so that they compare."""
    latest = max(1e3 * float(np.asarray(case.mesh.activation).max()) for case in cases)
    end = ISOCHRONE * np.ceil(latest / ISOCHRONE)
    return {
        "activation": {
            "title": "activation time",
            "label": "activation time (ms), a colour each 10 ms",
            **_ramp("RdYlBu", 0.0, end, "vertex", steps=int(end / ISOCHRONE)),
        },
        "distance": {
            "title": "distance between the two",
            "label": "distance of the same place in both (mm)",
            **_ramp("cividis", 0.0, DISTANCE, "vertex"),
        },
        "strain": {
            "title": "stretch of the surface",
            "label": "stretch of the surface since end diastole (%), violet: shorter",
            **_ramp("PuOr_r", -STRAIN, STRAIN, "vertex"),
        },
        "segment": {
            "title": "region of the wall",
            "label": "segment of the AHA: 0 the right free wall, grey; 1 to 6 basal, paler towards the apex, 17",
            "low": 0, "high": REGIONS - 1, "mode": "cell", "colours": _steps([RIGHT, *_segments()]),
        },
    }  # fmt: skip


def _ramp(name: str, low: float, high: float, mode: str, steps: int = 0) -> dict[str, Any]:
    places = np.linspace(0.0, 1.0, steps or 11)
    colours = [to_hex(each) for each in colormaps[name](places)]
    scale = (
        _steps(colours) if steps else [[round(float(x), 3), c] for x, c in zip(places, colours, strict=True)]
    )
    return {"low": low, "high": high, "mode": mode, "colours": scale}


def _steps(colours: list[str]) -> list[list[Any]]:
    """Each colour over its share of the range, without a passage to the next."""
    edges = np.round(np.linspace(0.0, 1.0, len(colours) + 1), 4).tolist()
    return [[edge, each] for place, each in enumerate(colours) for edge in edges[place : place + 2]]


def _segments() -> list[str]:
    """Colours of segments 1 to 17; an apical sector has that of the one above its middle."""
    sectors = [*range(6), *range(6), 0, 1, 3, 4, 0]
    white = [max(first for first in PALER if first <= segment) for segment in range(1, REGIONS)]
    return [_paler(BASAL[s], PALER[first]) for s, first in zip(sectors, white, strict=True)]


def _paler(colour: str, white: float) -> str:
    return to_hex(tuple(np.array(to_rgb(colour)) * (1.0 - white) + white))
