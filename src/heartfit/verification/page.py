"""The page of verification, in Markdown: no dates, no times, numbers rounded to what every machine agrees on."""

import numpy as np

from heartfit.verification.arostica_checks import arostica_checks
from heartfit.verification.audit_checks import audit_checks
from heartfit.verification.audit_page import audit_section
from heartfit.verification.block_checks import HARD, SIZES, SOFT, USUAL, block_checks, block_error
from heartfit.verification.check import Check
from heartfit.verification.land_checks import coarse_land_checks, fine_land_checks, land_table
from heartfit.verification.physioblocks_checks import SECTION as PHYSIOBLOCKS
from heartfit.verification.physioblocks_checks import physioblocks_checks
from heartfit.verification.reference_checks import reference_checks, reference_section
from heartfit.verification.slab import CHASTE_CORNER, SIZE, exact
from heartfit.verification.slab_checks import slab_checks
from heartfit.verification.time_order_checks import time_order_checks, time_order_section

MISSED = "**missed**"

HEADER = """# Verification

The simulator beside answers that nobody here produced. This page is written by `heartfit verification`, which fails
if a row is missed. The tests assert every row; the last five, on the finest meshes of the ventricles and the beam, take
half a minute of computing and are asserted by `python3 study.py test -m long` alone.

| check | measured | expected | | | unit | by |
|---|---|---|---|---|---|---|
"""

BLOCK = """
## Manufactured deformation

A cube of 20 mm of active Mooney-Rivlin tissue, fibre tension 20 kPa, is deformed as a formula says; the body force that
this takes is differentiated exactly, its surface is moved as given, and the step of the wall, with its own elements,
assembly and factors, solves for the inside. In the rows "traction" two of its sides are free and bear the exact
traction instead: there a stress that is wrong by a constant shows too. Wall pressures stay the same as K grows, and
with them the deformation. Relative errors, surface moved, of
the displacement, in L2 / of its gradient (H1), for 3, 6 and 12 elements along an edge:

| element | K, Pa | 3 | 6 | 12 |
|---|---|---|---|---|
"""

SLAB = """
## Slab of the electrophysiology benchmark

Niederer et al. 2011: 20 x 7 x 3 mm, fibres along x, stimulated in a corner. Speeds of 0.65 m/s along and 0.28 m/s
across the fibres give P8, the far corner, {middle:.1f} ms after the wave leaves the stimulated cube by the closed form;
0.7 and 0.3 m/s give {fast:.1f} ms, 0.6 and 0.25 m/s {slow:.1f} ms. A reaction-diffusion code of the benchmark
(Chaste, its 0.5 mm mesh) reaches P8 at {chaste:.1f} ms, 1.2 ms of which pass before the stimulated corner fires. That
lies within the range but verifies nothing: its mesh is too coarse, along its edges the wave runs at 0.50 m/s along and
0.20 m/s across the fibres. The eikonal solver is held to the closed form.
"""

LAND = """
## Benchmark of cardiac mechanics

Land et al. 2015, with the exponential law of Guccione and the element `mixed`. A beam of 10 x 1 x 1 mm is bent by 4 Pa
from below, which follow its surface; a truncated ellipsoid, clamped at its base, is inflated; the same with fibres that
turn from +90 to -90 degrees across the wall is inflated and contracts. Expected is what a participant, Simula-FEniCS,
found with elements of order 2 to 5 and published with the benchmark; its digits no longer change with the mesh.
The asked points are the tip (10, 0.5, 1) mm, whose z of 4.17 mm is a position and its deflection 1 mm less, and the
nodes on the axis at endocardium and epicardium. On the axis the fibres of the third problem have no direction, and
coarse meshes err there: with quadratic elements of 1.5 mm the participant finds the endocardial apex at -11.9 mm, and
the -12.0 mm that a public code prints is as far off. That our coarsest mesh is nearer than the next is luck. Linear
elements bend stiffly; the cavity, which nobody asked for, converges later than the apices.

| problem | | coarse | middle | fine | expected |
|---|---|---|---|---|---|
"""

ACTIVE = """
## Active stress of the benchmark of elastodynamics

Arostica et al. 2025 prescribe a control with smooth edges and the stress that follows from it by an equation of its
own. The contractile law of the wall, its series element stiff and its strain held at zero, gives the same stress: at
most 118.106 kPa, at 479.5 ms.
"""


def all_checks() -> list[Check]:
    """Every check on meshes of the usual size; takes some 40 s of computing."""
    return (
        block_checks()
        + time_order_checks()
        + physioblocks_checks()
        + slab_checks()
        + arostica_checks()
        + coarse_land_checks()
        + reference_checks()
        + audit_checks()
    )


def page_checks() -> list[Check]:
    """Every check of the page; takes a minute of computing."""
    return all_checks() + fine_land_checks()


def verification_page() -> str:
    """The page."""
    table = "".join(map(_row, page_checks()))
    return (
        HEADER
        + table
        + BLOCK
        + _errors()
        + time_order_section()
        + PHYSIOBLOCKS
        + SLAB.format(**_arrivals())
        + LAND
        + land_table()
        + ACTIVE
        + reference_section()
        + audit_section()
    )


def _row(check: Check) -> str:
    verdict = "met" if check.passed else MISSED
    cells = (check.name, f"{check.measured:.2f}", check.limit, verdict)
    return f"| {' | '.join([*cells, check.unit, check.source])} |\n"


def _errors() -> str:
    rows = [(element, K) for element in ("p1", "mixed") for K in (SOFT, USUAL, HARD)]
    return "".join(
        f"| `{element}` | {K:.0e} | {_cells(element, K)} |\n".replace("e+0", "e") for element, K in rows
    )


def _cells(element: str, K: float) -> str:
    found = [block_error(element, K, n) for n in SIZES]
    return " | ".join(f"{100 * each.L2:.1f} / {100 * each.H1:.1f} %" for each in found)


def _arrivals() -> dict[str, float]:
    corner = SIZE[None]
    speeds = {"middle": (0.65, 0.28), "fast": (0.7, 0.3), "slow": (0.6, 0.25)}
    times = {name: 1e3 * float(exact(corner, v, w / v)[0]) for name, (v, w) in speeds.items()}
    return times | {"chaste": float(np.round(1e3 * CHASTE_CORNER, 2))}
