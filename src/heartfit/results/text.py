"""Tables as Markdown and LaTeX, quantities as symbols, and the notes below the tables."""

import re
from collections.abc import Mapping
from dataclasses import dataclass

import pandas as pd

from heartfit.core.parameter import DISPLAY

GREEK = ("alpha", "sigma", "mu", "tau", "eta")
RATES = {"dPdt_max": r"$dP/dt_{\max}$", "dPdt_min": r"$dP/dt_{\min}$"}
RIGHT = "_rv"
"""End of the names of right ventricular observations."""

CURVE_UNITS = {"volume": "m^3", "pressure": "Pa", "flow": "m^3/s"}
"""SI unit of a curve by the last word of its name."""


@dataclass(frozen=True, eq=False)
class RenderedTable:
    """A table of numbers, and the same table as Markdown and as LaTeX."""

    frame: pd.DataFrame
    markdown: str
    latex: str


def render_table(frame: pd.DataFrame, note: str = "") -> RenderedTable:
    """Render a table with the note below its Markdown."""
    return RenderedTable(frame, to_markdown(frame) + (f"\n{note}\n" if note else ""), to_latex(frame))


def render_tables(frames: Mapping[str, pd.DataFrame]) -> dict[str, RenderedTable]:
    """Render tables by name, each with its entry of ``NOTES`` if it has one."""
    return {name: render_table(frame, NOTES.get(name, "")) for name, frame in frames.items()}


def to_markdown(table: pd.DataFrame) -> str:
    """Return a pipe table with empty cells for NaN."""
    return cell_texts(table).to_markdown(index=False, disable_numparse=True) + "\n"


def to_latex(table: pd.DataFrame) -> str:
    """Return a booktabs tabular with the quantities as symbols."""
    texts = cell_texts(table).map(_escape)
    texts.columns = [_heading(str(column)) for column in table.columns]
    return texts.to_latex(index=False, column_format="ll" + "r" * (len(texts.columns) - 2))


def cell_texts(table: pd.DataFrame) -> pd.DataFrame:
    """Return the table with each cell as printed text, empty for NaN."""
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
    r"""Return a column heading in LaTeX: "$\\sigma_{0}$ sd (\\%)" for "sigma_0 sd (%)"."""
    name, _, rest = column.partition(" ")
    return f"{symbol(name)} {_escape(rest).replace('^3', '$^3$')}".strip()


def symbol(name: str) -> str:
    r"""Return the name of a quantity as mathematics: "$q_{\\max}$" for "q_max"."""
    if name in RATES:
        return RATES[name]
    if name.endswith(RIGHT):
        return f"{symbol(name.removesuffix(RIGHT))} RV"
    if "." in name:
        owner, last = name.split(".")[-2:]
        return f"{symbol(last)} ({owner.replace('_', ' ')})"
    base, _, index = name.partition("_")
    if not index and base not in GREEK and len(base) > 1:
        return _escape(name)
    letter = f"\\{base}" if base in GREEK else base
    lower = f"\\{index}" if index in ("min", "max") else index
    return f"${letter}_{{{lower}}}$" if index else f"${letter}$"


def curve_unit(curve: str) -> str:
    """Return the SI unit of a curve by its name, such as "m^3" for "lv_volume"."""
    return CURVE_UNITS[curve.rsplit("_", 1)[1]]


def printed_curve_unit(curve: str) -> tuple[str, float]:
    """Return the printed unit of a curve by its name, and the SI value of one such unit."""
    return DISPLAY[curve_unit(curve)]


def printed_ratio(ratio: float, interval: tuple[float, float]) -> str:
    """Return a ratio with its interval, such as "0.80 (0.70 to 0.90)"."""
    low, high = interval
    return f"{ratio:.2f} ({low:.2f} to {high:.2f})"


OTHER_DATA = "other hearts, other images and an open model replace the authors' data and scene"
NOTES = {
    "table1": (
        f"Differences from the paper: {OTHER_DATA}; the images of the virtual volunteers carry the error of "
        "our registration (floor), the paper's carry its 25 %. A fit with z < 1 is better than the noise of "
        "the measurement permits: it is luck or overfitting."
    ),
    "table2": (
        "Differences from the paper: absolute MPa depend on the element, the mesh and the values of the fixed "
        "parameters, which the paper does not print; only ratios to the mean (over mean) are comparable. K "
        "acts through the locking of linear tetrahedra alone and has no true value."
    ),
    "table3": (
        f"Differences from the paper: {OTHER_DATA}. Seven parameters can meet six observations: the remaining "
        "error is the curvature of the model over one linear step. A fit with z < 1 is better than the noise "
        "of the measurement permits."
    ),
    "table3_parameters": (
        "Differences from the paper: the patients are virtual, and their true parameters were chosen with the "
        "paper's ratios. Compare the estimates with the true parameters, and with the paper only over the "
        "healthy mean."
    ),
    "cards": (
        "seen: share of the prior variance that the data remove. Below one half, the prior determines the "
        "estimate more than the data do, whatever its error. Places are in prior standard deviations from the "
        "prior mean."
    ),
    "coverage_cohort": (
        "The paper gives no intervals. An exact fit of the observations claims that they are certain. The "
        "model's own error explains coverage below 95 % that remains after noise and fixed parameters are "
        "included. Each heart is one trial."
    ),
    "specificity": (
        "The paper reports differences without a test. The least possible p is that of one labeling of all "
        "hearts (least p). The warning marks differences that the prior dominates; the reading unshrunk "
        "removes the pull of the prior."
    ),
    "claims": (
        "Claims of section 4.2 of the paper, for each reading of our patients and for their true parameters. "
        "A test of the stiffness of one patient against seven volunteers cannot give p below 1/8."
    ),
    "costs": (
        "Snakemake samples CPU time and memory each half second, and after 15 s each half minute; use after "
        "the last sample of a job is missing. The paper reports 9 cases of about 20 minutes, with their 2n+1 "
        "runs in parallel; compare the stage calibration, which has two settings per case and one more case."
    ),
}
