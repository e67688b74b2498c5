"""Numbers, names and tables as HTML; whatever text they carry is escaped."""

import html
import math
import re
from collections.abc import Hashable, Mapping

import pandas as pd
from markupsafe import Markup

from heartfit.tables.errors_table import PAPER
from heartfit.tables.text import GREEK, RATES, strings

LETTERS = {"alpha": "α", "sigma": "σ", "mu": "μ", "tau": "τ", "eta": "η"}
DECIMAL = re.compile(r"-?\d+\.\d+")


def quantity(name: str) -> Markup:
    """A heading with its quantity as mathematics: "sigma_0 sd (%)" with sigma as a letter and 0 below the line."""
    head, space, rest = name.partition(" ")
    return Markup("{}{}{}").format(_symbol(head), space, _raised(rest))


def _symbol(name: str) -> Markup:
    if name in RATES:
        return Markup("d<i>P</i>/d<i>t</i><sub>{}</sub>").format(name.partition("_")[2])
    base, _, index = name.partition("_")
    if not index and base not in GREEK and len(base) > 1:
        return Markup.escape(name)
    letter = Markup("<i>{}</i>").format(LETTERS.get(base, base))
    return letter + (Markup("<sub>{}</sub>").format(index) if index else Markup(""))


def _raised(text: str) -> Markup:
    """Powers as such: m^3."""
    return Markup(re.sub(r"\^(-?\d)", r"<sup>\1</sup>", html.escape(text)))


def number(value: float | None, digits: int = 3) -> str:
    """A few significant digits, a dash where there is none."""
    if value is None or not math.isfinite(value):
        return "–"
    text = f"{value:.{digits}g}"
    return (f"{value:.0f}" if "e" in text and 1e3 <= abs(value) < 1e7 else text).replace("-", "−")


def rows(table: pd.DataFrame) -> list[Mapping[str, object]]:
    """Cells as text by row, with the class of the row: the paper's, a mean or one of ours."""
    texts = strings(table.map(_value)).to_dict("records")
    return [
        {"kind": _kind(row), "cells": [text.replace("nan", "") for text in row.values()]} for row in texts
    ]


def _value(cell: object) -> object:
    """A number as such where its column, as it was read, holds words too."""
    return float(cell) if isinstance(cell, str) and DECIMAL.fullmatch(cell) else cell


def _kind(row: Mapping[Hashable, str]) -> str:
    if row.get("setting") == PAPER:
        return "paper"
    return "mean" if str(row.get("case", "")).startswith(("mean", "prior")) else "ours"
