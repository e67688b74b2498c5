"""Tables as Markdown and LaTeX, quantities as symbols, and the notes below the tables."""

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import pandas as pd

from heartfit.calibration.update import LONG_STEP
from heartfit.core.parameter import DISPLAY

ROW_HEADINGS = "Volunteers"
"""Column of the tables in the paper's layout that holds the quantities."""
GREEK = ("alpha", "sigma", "mu", "tau", "eta")
RATES = {"dPdt_max": r"$dP/dt_{\max}$", "dPdt_min": r"$dP/dt_{\min}$"}
RIGHT = "_rv"
"""End of the names of right ventricular observations."""

CURVES = {
    "lv_volume": "left ventricular volume",
    "lv_pressure": "left ventricular pressure",
    "aorta_pressure": "aortic pressure",
    "rv_volume": "right ventricular volume",
    "rv_pressure": "right ventricular pressure",
}
"""Words for the curves of a recording."""
CURVE_UNITS = {"volume": "m^3", "pressure": "Pa", "flow": "m^3/s"}
"""SI unit of a curve by the last word of its name."""


@dataclass(frozen=True, eq=False)
class RenderedTable:
    """A table of numbers, and the same table as Markdown and as LaTeX."""

    frame: pd.DataFrame
    markdown: str
    latex: str


def render_table(frame: pd.DataFrame, note: str = "", stated_once: Sequence[str] = ()) -> RenderedTable:
    """Render a table with the note below its Markdown; cells of ``stated_once`` are blank where they repeat."""
    shown = without_repeats(frame, stated_once)
    return RenderedTable(frame, to_markdown(shown) + (f"\n{note}\n" if note else ""), to_latex(shown))


def render_tables(frames: Mapping[str, pd.DataFrame]) -> dict[str, RenderedTable]:
    """Render tables by name, each with its entries of ``NOTES`` and ``STATED_ONCE`` if it has any."""
    return {
        name: render_table(frame, NOTES.get(name, ""), STATED_ONCE.get(name, ()))
        for name, frame in frames.items()
    }


def without_repeats(frame: pd.DataFrame, columns: Sequence[str]) -> pd.DataFrame:
    """Return the table with blank cells in these columns where they all equal those of the row above."""
    if frame.empty or not columns:
        return frame
    named = frame[list(columns)]
    return frame.assign(
        **{name: named[name].mask(named.eq(named.shift()).all(axis=1), "") for name in columns}
    )


def to_markdown(table: pd.DataFrame) -> str:
    """Return a pipe table with empty cells for NaN."""
    return cell_texts(table).to_markdown(index=False, disable_numparse=True) + "\n"


def to_latex(table: pd.DataFrame) -> str:
    """Return a booktabs tabular with the quantities as symbols."""
    texts = cell_texts(table).map(_escape)
    if ROW_HEADINGS in texts:
        texts[ROW_HEADINGS] = table[ROW_HEADINGS].map(_heading)
    texts.columns = [_heading(str(column)) for column in table.columns]
    return texts.to_latex(index=False, column_format="ll" + "r" * (len(texts.columns) - 2))


def printed_tables(tables: Mapping[str, pd.DataFrame]) -> dict[str, pd.DataFrame]:
    """Return the tables by name with each cell as printed text."""
    return {name: cell_texts(table) for name, table in tables.items()}


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
    return re.sub(r"([%_&#])", r"\\\1", text).replace(LONG_STEP_MARK, r"\dag{}")


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


AMPLITUDE_UNITS = {
    "Pa": ("kPa", 1e-3), "m^3": ("mL", 1e6), "m^3/s": ("mL/s", 1e6), "m^2": ("cm²", 1e4), "s": ("ms", 1e3),
    "m^3/(s Pa)": ("mL/(s kPa)", 1e9), "1/m^4": ("1/cm⁴", 1e-8), "1": ("", 1.0),
}  # fmt: skip
"""Printed unit of an amplitude and the factor from SI, by SI unit."""


def spaced_name(name: str) -> str:
    """Return the name of a class as words: "mitral regurgitation" for MitralRegurgitation."""
    return re.sub(r"(?<!^)(?=[A-Z])", " ", name).lower()


def two_digits(value: float) -> str:
    """Return a value with two digits: "120", not "1.2e+02"."""
    return f"{float(f'{value:.2g}'):g}"


def printed_ratio(ratio: float, interval: tuple[float, float]) -> str:
    """Return a ratio with its interval, such as "0.80 (0.70 to 0.90)"."""
    low, high = interval
    return f"{ratio:.2f} ({low:.2f} to {high:.2f})"


LONG_STEPS, LONG_STEP_MARK = "long steps", "†"
"""Heading of the column of long steps, and mark of a number that one leads to."""
LONG_STEP_LEGEND = f"step beyond {LONG_STEP:g} prior sd"


def printed_steps(steps: Mapping[str, float]) -> str:
    """Return steps in prior standard deviations, such as "K -7.9, sigma_0 +2.7"."""
    return ", ".join(f"{name} {size:+.1f}" for name, size in steps.items())


STATED_ONCE = {"claims": ("place", "quote", "quantity", "paper", "unit")}
"""Columns by table that are blank in a row where they repeat those of the row above."""

LONG_STEP_NOTE = (
    f"{LONG_STEP_MARK} or {LONG_STEPS}: an estimate more than {LONG_STEP:g} prior standard deviations from the prior's "
    "mean, where one straight step extrapolates; a second iteration (`iterations: 2`) starts from "
    "there, as the setting locking_twice of config/full.yaml does."
)
OTHER_DATA = "other hearts, other images and an open model replace the authors' data and scene"
NOTES = {
    "table1_as_printed": (
        "Columns 1, 2, ... of our rows are the virtual volunteers of the study in its order; they stand for the "
        "paper's seven, and Mean is theirs. A measured heart has a column of its own. "
        f"Differences from the paper: {OTHER_DATA}. The tables table1 and table3 add the noise of each measurement."
    ),
    "table2_as_printed": (
        "Columns as in table1_as_printed. Values below 1 have three digits instead of the paper's two decimals. MPa do "
        "not compare with the paper, since they depend on element, mesh and fixed parameters that it does not print. "
        "Ratios to the mean do where the hearts are measured; those of the virtual volunteers were planted (c_1 in "
        "the place of K), so estimates that vary as the paper's recover what was planted and confirm nothing of the "
        "paper."
    ),
    "table1": (
        f"Differences from the paper: {OTHER_DATA}; the images of the virtual volunteers carry the error of "
        "our registration (floor), the paper's carry its 25 %. A fit with z < 1 is better than the noise of "
        "the measurement permits: it is luck or overfitting."
    ),
    "table2": (
        "Differences from the paper: absolute MPa depend on the element, the mesh and the values of the fixed "
        "parameters, which the paper does not print; only ratios to the mean (over mean) are comparable, and those of "
        "virtual volunteers only with what was planted in them (planted over mean). K "
        "acts through the locking of linear tetrahedra alone and has no true value."
    ),
    "table3": (
        f"Differences from the paper: {OTHER_DATA}. Seven parameters can meet six observations: the remaining "
        "error is the curvature of the model over one linear step. A fit with z < 1 is better than the noise "
        "of the measurement permits."
    ),
    "table3_parameters": (
        "Differences from the paper: the patients are virtual, and their true parameters were planted near the "
        "paper's ratios. Compare the estimates with the true parameters; that they are like the paper's over the "
        "healthy mean confirms nothing of the paper."
    ),
    "cards": (
        "Variance reduction: share of the prior variance that the data remove. Below one half, the prior determines "
        "the estimate more than the data do, whatever its error. Places are in prior standard deviations from the "
        "prior mean."
    ),
    "coverage_cohort": (
        "The paper gives no intervals. An exact fit of the observations claims that they are certain. The "
        "error of the model explains coverage below 95 % that remains in the noise-aware estimate, which includes "
        "the noise and the fixed parameters. Each heart is one trial."
    ),
    "specificity": (
        "The paper reports differences without a test. The least possible p is that of one labeling of all "
        "hearts (least p). The warning marks differences that the prior dominates; the reading unshrunk "
        "removes the pull of the prior."
    ),
    "specificity_claims": (
        "The two claims of section 4.2 of the paper, for each reading of our patients and for their true parameters, "
        "which were planted near the paper's: a claim that holds says that the calibration recovers them. "
        "A test of the stiffness of one patient against seven volunteers cannot give p below 1/8."
    ),
    "claims": (
        "Numbers that the paper states in its abstract and in section 4, and in 3.2 and 5 on the parameters. An error "
        "is met by at most the paper's, another claim by its relation in resources/marchesseau2012/claims.tsv. "
        f"Differences from the paper: {OTHER_DATA}. Virtual and measured hearts are never averaged. 11 % is the mean "
        "over the 33 observations of Table 1 and section 4.2 together (11.3 %), and so is ours. Time was measured on "
        "another computer, 14 years later, and the paper does not state its meshes."
    ),
    "costs": (
        "Snakemake samples CPU time and memory each half second, and after 15 s each half minute; use after "
        "the last sample of a job is missing. The paper reports 9 cases of about 20 minutes, with their 2n+1 "
        "runs in parallel; compare the stage calibration, which has two settings per case and one more case."
    ),
}
NOTES |= {
    name: f"{NOTES[name]} {LONG_STEP_NOTE}"
    for name in (
        *("table1_as_printed", "table2_as_printed", "table1", "table2", "table3", "table3_parameters"),
        *("cards", "specificity", "specificity_claims", "claims"),
    )
}
