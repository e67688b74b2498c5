"""Errors of registrations as tables, by method and by contrast of the images."""

from collections.abc import Iterable, Mapping, Sequence

import numpy as np
import pandas as pd

from benchmarks.registration.row import Errors, Row

FRAMES = 25


def methods_table(methods: Mapping[str, Mapping[str, Row]]) -> pd.DataFrame:
    """Return one row for each method, by family and name."""
    return _table(
        _method(family, name, row) for family, rows in methods.items() for name, row in rows.items()
    )


def contrasts_table(contrasts: Mapping[str, Sequence[Row]]) -> pd.DataFrame:
    """Return one row for each contrast and heart; shortening and twist less the true ones."""
    return _table(
        _contrast(name, heart, row) for name, rows in contrasts.items() for heart, row in enumerate(rows, 1)
    )


def _table(rows: Iterable[dict[str, str]]) -> pd.DataFrame:
    return pd.DataFrame(list(rows)).fillna("")


def _method(family: str, name: str, row: Row) -> dict[str, str]:
    method = {"method": f"{family}: {name}"}
    if row.errors is None:
        return method | {"V_min %": "refused"}
    errors = row.errors
    shape = {"shortening %": f"{100.0 * errors.shortening:.1f}", "twist °": f"{np.degrees(errors.twist):.1f}"}
    return method | _numbers(errors) | shape | {"CPU s a frame": f"{row.cpu:.2f}"}


def _contrast(name: str, heart: int, row: Row) -> dict[str, str]:
    images = {"images": name, "heart": str(heart)}
    if row.errors is None:
        return images | {"V_min %": "refused"}
    errors = row.errors
    shortening = 100.0 * (errors.shortening - errors.true_shortening)
    twist = np.degrees(errors.twist - errors.true_twist)
    shape = {"shortening": f"{shortening:+.1f}", "twist": f"{twist:+.1f}"}
    return images | _numbers(errors) | shape | {"CPU s a case": f"{(FRAMES - 1) * row.cpu:.1f}"}


def _numbers(errors: Errors) -> dict[str, str]:
    return {
        "V_min %": f"{100.0 * errors.V_min:+.1f}",
        "q_max %": f"{100.0 * errors.q_max:+.1f}",
        "q_min %": f"{100.0 * errors.q_min:+.1f}",
        "points mm": f"{1e3 * errors.mean:.2f}",
        "95 % mm": f"{1e3 * errors.most:.1f}",
        "folded": str(errors.folded),
    }
