"""Page of verification, in Markdown, without dates and times; numbers are rounded to reproducible digits."""

import numpy as np

from heartfit.core.pages import render_page, table_row
from verification.arostica import arostica_checks
from verification.audit_checks import audit_checks, audit_table, blood_checks, blood_table, limit_cycle
from verification.block_checks import HARD, SIZES, SOFT, USUAL, block_checks, block_error
from verification.check import Check
from verification.closed_loop import closed_loop_checks
from verification.land import coarse_land_checks, fine_land_checks, land_table
from verification.physioblocks import physioblocks_checks
from verification.reference import first_beats, reference_checks, reference_table
from verification.slab import CHASTE_CORNER, SIZE, exact, slab_checks
from verification.time_order import time_order_checks, time_order_table

MISSED = "**missed**"


def all_checks() -> list[Check]:
    """Run the checks on meshes of the usual size, some 40 s of computing."""
    return (
        block_checks()
        + time_order_checks()
        + physioblocks_checks()
        + closed_loop_checks()
        + slab_checks()
        + arostica_checks()
        + coarse_land_checks()
        + reference_checks()
        + audit_checks()
        + blood_checks()
    )


def page_checks() -> list[Check]:
    """Run all checks of the page, a minute of computing."""
    return all_checks() + fine_land_checks()


def verification_page() -> str:
    """Render the page."""
    return render_page(
        "verification",
        checks="".join(map(_row, page_checks())),
        blocks=_errors(),
        time_order=time_order_table(),
        arrivals=_arrivals(),
        land=land_table(),
        reference=reference_table(first_beats()),
        beats=limit_cycle().diagnostics["beats"],
        audit=audit_table(),
        blood=blood_table(),
    )


def _row(check: Check) -> str:
    verdict = "met" if check.passed else MISSED
    measured = f"{check.measured:.2f}"
    return table_row(check.name, measured, check.limit, verdict, check.unit, check.source)


def _errors() -> str:
    rows = [(element, K) for element in ("p1", "mixed") for K in (SOFT, USUAL, HARD)]
    return "".join(
        f"| `{element}` | {K:.0e} | {_cells(element, K)} |\n".replace("e+0", "e") for element, K in rows
    )


def _cells(element: str, K: float) -> str:
    block_errors = [block_error(element, K, n) for n in SIZES]
    return " | ".join(f"{100 * error.L2:.1f} / {100 * error.H1:.1f} %" for error in block_errors)


def _arrivals() -> dict[str, float]:
    corner = SIZE[None]
    speeds = {"middle": (0.65, 0.28), "fast": (0.7, 0.3), "slow": (0.6, 0.25)}
    times = {name: 1e3 * float(exact(corner, v, w / v)[0]) for name, (v, w) in speeds.items()}
    return times | {"chaste": float(np.round(1e3 * CHASTE_CORNER, 2))}
