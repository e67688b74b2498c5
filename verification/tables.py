"""Checks and results of verification as tables, without dates and times; numbers are rounded to reproducible digits."""

import pandas as pd

from verification.arostica import arostica_checks
from verification.audit_checks import audit_checks, audit_table, blood_checks, blood_table
from verification.block_checks import HARD, SIZES, SOFT, USUAL, block_checks, block_error
from verification.check import Check
from verification.closed_loop import closed_loop_checks
from verification.land import coarse_land_checks, fine_land_checks, land_table
from verification.physioblocks import physioblocks_checks
from verification.reference import first_beats, reference_checks, reference_table
from verification.slab import slab_checks
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


def every_check() -> list[Check]:
    """Run all checks, those of the finest meshes included, a minute of computing."""
    return all_checks() + fine_land_checks()


def checks_table() -> pd.DataFrame:
    """Return one row for each check."""
    return pd.DataFrame([_row(check) for check in every_check()])


def results_tables() -> dict[str, pd.DataFrame]:
    """Return the results behind the checks by name: errors, orders, meshes, references and energies."""
    return {
        "block": _errors(),
        "time_order": time_order_table(),
        "land": land_table(),
        "reference": reference_table(first_beats()),
        "energy": audit_table(),
        "blood": blood_table(),
    }


def _row(check: Check) -> dict[str, str]:
    return {
        "check": check.name,
        "measured": f"{check.measured:.2f}",
        "expected": check.limit,
        "verdict": "met" if check.passed else MISSED,
        "unit": check.unit,
        "by": check.source,
    }


def _errors() -> pd.DataFrame:
    rows = [(element, K) for element in ("p1", "mixed") for K in (SOFT, USUAL, HARD)]
    cells = [(f"`{element}`", f"{K:.0e}".replace("e+0", "e"), *_cells(element, K)) for element, K in rows]
    return pd.DataFrame(cells, columns=["element", "K, Pa", *map(str, SIZES)])


def _cells(element: str, K: float) -> list[str]:
    block_errors = [block_error(element, K, n) for n in SIZES]
    return [f"{100 * error.L2:.1f} / {100 * error.H1:.1f} %" for error in block_errors]
