"""The page of verification, in Markdown: no dates, no times, numbers rounded to what every machine agrees on."""

import numpy as np

from heartfit.verification.block_checks import HARD, SIZES, SOFT, USUAL, block_checks, block_error
from heartfit.verification.check import Check
from heartfit.verification.slab import CHASTE_CORNER, SIZE, exact
from heartfit.verification.slab_checks import slab_checks

HEADER = """# Verification

The simulator beside answers that nobody here produced. This page is written by `heartfit verification`; a test asserts
every row.

| check | measured | expected | | | unit | by |
|---|---|---|---|---|---|---|
"""

BLOCK = """
## Manufactured deformation

A cube of 20 mm of active Mooney-Rivlin tissue, fibre tension 20 kPa, is deformed as a formula says; the body force that
this takes is differentiated exactly, its surface is moved as given, and the step of the wall, with its own elements,
assembly and factors, solves for the inside. Wall pressures stay the same as K grows. Relative errors of
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


def all_checks() -> list[Check]:
    """Every check of the page; takes about 15 s."""
    return block_checks() + slab_checks()


def verification_page() -> str:
    """The page."""
    table = "".join(map(_row, all_checks()))
    return HEADER + table + BLOCK + _errors() + SLAB.format(**_arrivals())


def _row(check: Check) -> str:
    verdict = "met" if check.passed else "**missed**"
    cells = (check.name, f"{check.measured:.2f}", f"{check.expected:g}", f"± {check.tolerance:g}", verdict)
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
