"""Where the ventricles start to depolarise and how fast the wave runs: in health, and in left bundle branch block.

References
----------
Durrer D et al. 1970, doi 10.1161/01.CIR.41.6.899: three early sites on the left endocardium, anterior
paraseptal, mid septal and posterior paraseptal; the right ventricle follows near the insertion of its
anterior papillary muscle.
Auricchio A et al. 2004, doi 10.1161/01.CIR.0000118502.91105.F6, and Strik M et al. 2012, doi
10.1007/s12265-012-9351-1: in left bundle branch block the right ventricle comes first, the wave runs slowly through the
septum, and it ends at the lateral or posterolateral base.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import Literal

import numpy as np


@dataclass(frozen=True)
class Site:
    """A place on an endocardium, where the wave starts.

    wall: of the left ventricle, or the right one's septal or free wall; longitudinal 0 apex .. 1 base; angle in rad
    around the left ventricle from the middle of the septum to anterior; time s.
    """

    wall: Literal["left", "septal", "free"]
    longitudinal: float
    angle: float
    time: float


@dataclass(frozen=True)
class Conduction:
    """Sites of onset and speeds, m/s: along the fibres, across them as a ratio to it, and in the endocardial layers."""

    sites: tuple[Site, ...]
    speed: float = 0.6
    ratio: float = 0.45
    left_layer: float = 3.0
    right_layer: float = 3.0


_RIGHT_PAPILLARY = (0.45, np.deg2rad(15.0))
HEALTHY = Conduction(
    (
        Site("left", 0.70, np.deg2rad(75.0), 0.0),
        Site("left", 0.55, 0.0, 0.0),
        Site("left", 0.35, np.deg2rad(-75.0), 0.0),
        Site("free", *_RIGHT_PAPILLARY, 0.007),
    )
)
"""Both bundles conduct, into Purkinje networks on both sides."""

LBBB = Conduction(
    (Site("septal", 0.35, np.deg2rad(15.0), 0.0), Site("free", *_RIGHT_PAPILLARY, 0.0)),
    ratio=0.35,
    left_layer=0.8,
)
"""Left bundle branch block: only the right bundle conducts; the left endocardium is hardly faster than the wall."""

CONDUCTIONS: Mapping[str, Conduction] = MappingProxyType({"healthy": HEALTHY, "lbbb": LBBB})
