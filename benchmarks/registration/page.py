"""The page of registrations, in Markdown."""

from collections.abc import Mapping, Sequence
from importlib.metadata import version

import numpy as np

from benchmarks.page import machine
from benchmarks.registration.methods import OURS
from benchmarks.registration.row import Errors, Row
from heartfit.core.pages import render_page, table_row

LIBRARIES = ("SimpleITK", "numpy", "scipy")
FRAMES, LIMIT = 25, 60.0
"""Longest time of a case [CPU s]."""


def page(methods: Mapping[str, Mapping[str, Row]], contrasts: Mapping[str, Sequence[Row]], same: bool) -> str:
    """The page; rows by family and name, and by contrast one for each heart; whether the bytes of a motion agree."""
    truth = methods["heartfit"][OURS].errors
    hearts = len(next(iter(contrasts.values())))
    costs = [(FRAMES - 1) * row.cpu for rows in contrasts.values() for row in rows]
    return render_page(
        "registration_methods",
        frames=FRAMES,
        machine=machine(),
        libraries=", ".join(f"{name} {version(name)}" for name in LIBRARIES),
        shortening=100.0 * truth.true_shortening,
        twist=np.degrees(truth.true_twist),
        methods="".join(
            _method(family, name, row) for family, rows in methods.items() for name, row in rows.items()
        ),
        hearts=hearts,
        contrasts="".join(
            _contrast(name, heart, row)
            for name, rows in contrasts.items()
            for heart, row in enumerate(rows, 1)
        ),
        least=min(costs),
        most=max(costs),
        limit=LIMIT,
        same=same,
    )


def _method(family: str, name: str, row: Row) -> str:
    if row.errors is None:
        return table_row(f"{family}: {name}", "refused", *8 * [""])
    errors = row.errors
    shape = [f"{100.0 * errors.shortening:.1f}", f"{np.degrees(errors.twist):.1f}"]
    return table_row(f"{family}: {name}", *_numbers(errors), *shape, f"{row.cpu:.2f}")


def _contrast(name: str, heart: int, row: Row) -> str:
    if row.errors is None:
        return table_row(name, str(heart), "refused", *8 * [""])
    errors = row.errors
    shortening = 100.0 * (errors.shortening - errors.true_shortening)
    twist = np.degrees(errors.twist - errors.true_twist)
    shape = [f"{shortening:+.1f}", f"{twist:+.1f}"]
    return table_row(name, str(heart), *_numbers(errors), *shape, f"{(FRAMES - 1) * row.cpu:.1f}")


def _numbers(errors: Errors) -> list[str]:
    percent = [f"{100.0 * value:+.1f}" for value in (errors.V_min, errors.q_max, errors.q_min)]
    return [*percent, f"{1e3 * errors.mean:.2f}", f"{1e3 * errors.most:.1f}", str(errors.folded)]
