"""Tables as Markdown and LaTeX."""

import re

import pandas as pd

GREEK = ("alpha", "sigma", "mu", "tau", "eta")
RATES = {"dPdt_max": r"$dP/dt_{\max}$", "dPdt_min": r"$dP/dt_{\min}$"}


def to_markdown(table: pd.DataFrame) -> str:
    """A pipe table; empty where there is no number."""
    return strings(table).to_markdown(index=False, disable_numparse=True) + "\n"


def to_latex(table: pd.DataFrame) -> str:
    """A booktabs tabular with the quantities as symbols."""
    texts = strings(table).map(_escape)
    texts.columns = [_heading(str(column)) for column in table.columns]
    return texts.to_latex(index=False, column_format="ll" + "r" * (len(texts.columns) - 2))


def strings(table: pd.DataFrame) -> pd.DataFrame:
    """Every cell as it is printed, empty where there is no number."""
    return table.map(_number).astype(str)


def _number(value: object) -> str:
    if not isinstance(value, float):
        return str(value)
    if value != value:
        return ""
    decimals = 2 if abs(value) < 10 else 1 if abs(value) < 1000 else 0
    return f"{value:.{decimals}f}"


def _escape(text: str) -> str:
    return re.sub(r"([%_&#])", r"\\\1", text)


def _heading(column: str) -> str:
    """ "sigma_0 sd (%)" becomes "$\\sigma_{0}$ sd (\\%)"."""
    name, _, rest = column.partition(" ")
    return f"{symbol(name)} {_escape(rest).replace('^3', '$^3$')}".strip()


def symbol(name: str) -> str:
    """A quantity's name as mathematics, "q_max" as "$q_{\\max}$"."""
    if name in RATES:
        return RATES[name]
    base, _, index = name.partition("_")
    if not index and base not in GREEK and len(base) > 1:
        return _escape(name)
    letter = f"\\{base}" if base in GREEK else base
    lower = f"\\{index}" if index in ("min", "max") else index
    return f"${letter}_{{{lower}}}$" if index else f"${letter}$"
