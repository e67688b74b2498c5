"""Report page: the templates filled with numbers, names, tables and figures; all text is escaped."""

import base64
import hashlib
import html
import json
import math
import re
from collections.abc import Hashable, Mapping
from dataclasses import dataclass
from typing import Any

import pandas as pd
from jinja2 import Environment, PackageLoader, StrictUndefined
from markupsafe import Markup

from heartfit.results.discovery import NOTE, printed_findings
from heartfit.results.errors import PAPER, mean_error
from heartfit.results.report.cases import facts, observations, plot_cohort, status
from heartfit.results.report.cause import CauseCard, cause_card
from heartfit.results.report.contents import contents, tables_of
from heartfit.results.report.curves import plot_curves
from heartfit.results.report.misfit import calibrated_misfits, distance
from heartfit.results.report.parameters import estimates, plot_estimates, plot_parameters
from heartfit.results.report.picture import Picture, still_address
from heartfit.results.report.record import CaseRecord, FittedCase, ReportTable, StudyRecord
from heartfit.results.report.surface import colour_scales, viewer_data
from heartfit.results.report.wall import WallCard, wall_section
from heartfit.results.text import GREEK, LONG_STEP_LEGEND, LONG_STEP_MARK, RATES, cell_texts
from heartfit.results.verdict_text import verdict_sentence

LETTERS = {"alpha": "α", "sigma": "σ", "mu": "μ", "tau": "τ", "eta": "η"}


def quantity(name: str) -> Markup:
    """Return a heading with its quantity as mathematics: "sigma_0 sd (%)" with a Greek letter and a subscript."""
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
    """Return text with powers as superscripts."""
    return Markup(re.sub(r"\^(-?\d)", r"<sup>\1</sup>", html.escape(text)))


def number(value: float | None, digits: int = 3) -> str:
    """Return a value with a few significant digits, a dash for none."""
    if value is None or not math.isfinite(value):
        return "–"
    text = f"{value:.{digits}g}"
    return (f"{value:.0f}" if "e" in text and 1e3 <= abs(value) < 1e7 else text).replace("-", "−")


def rows(table: pd.DataFrame) -> list[Mapping[str, object]]:
    """Return cells as text by row, with the kind of each row: paper, mean or ours."""
    texts = cell_texts(table).to_dict("records")
    return [
        {"kind": _kind(row), "cells": [text.replace("nan", "") for text in row.values()]} for row in texts
    ]


def _kind(row: Mapping[Hashable, str]) -> str:
    if row.get("setting") == PAPER:
        return "paper"
    return "mean" if str(row.get("case", "")).startswith(("mean", "prior")) else "ours"


POLICY = (
    "default-src 'none'; script-src {scripts}; style-src 'unsafe-inline'; img-src data: blob:; "
    "base-uri 'none'; form-action 'none'"
)


@dataclass(frozen=True)
class Assets:
    """Texts that the page contains unchanged: viewer library, script and style."""

    library: str
    script: str
    style: str

    def policy(self) -> str:
        """Return the Content-Security-Policy, which allows these two scripts and no external address."""
        return POLICY.format(scripts=" ".join(map(_allowed, (self.library, self.script))))


def _allowed(script: str) -> str:
    digest = hashlib.sha256(script.encode("utf-8")).digest()
    return f"'sha256-{base64.b64encode(digest).decode('ascii')}'"


@dataclass(frozen=True)
class Section:
    """Content of the page for one case besides its numbers; headlines: of its causes the last card of each setting."""

    case: CaseRecord
    curves: Picture
    parameters: Picture
    misfits: list[str]
    causes: list[CauseCard]
    headlines: list[CauseCard]
    walls: list[WallCard]
    viewed: dict[str, Any]
    still: str


def render(study: StudyRecord, assets: Assets) -> str:
    """Return the whole page; equal studies give equal text."""
    cases = list(study.cases.values())
    settings = [name for name in study.settings if any(name in case.fits for case in cases)]
    colours, several = study.colours, len(cases) > 1
    page = _environment().get_template("page.html")
    return page.render(
        assets=assets,
        study=study,
        settings=settings,
        parts=contents(study),
        paper=tables_of(study, paper=True),
        checks=tables_of(study, paper=False),
        colours=colours,
        cohort=plot_cohort(cases, colours) if several else None,
        parameters={name: plot_parameters(cases, name, colours[name]) for name in settings if several},
        sections=[_section(case, cases, colours) for case in cases],
        shades=colour_scales(cases),
        discovery=_discovery(study),
    )


def _discovery(study: StudyRecord) -> ReportTable | None:
    """Return the findings of the refitted cases, None without such a case."""
    if not study.discoveries:
        return None
    return ReportTable("Missing mechanisms", printed_findings(study.discoveries), NOTE)


def _section(case: CaseRecord, cases: list[CaseRecord], colours: Mapping[str, str]) -> Section:
    curves = plot_curves(case, colours)
    cards = [_causes(setting, fit) for setting, fit in case.fits.items()]
    causes, headlines = [card for group in cards for card in group], [group[-1] for group in cards if group]
    walls = [wall_section(setting, summary) for setting, summary in case.walls.items()]
    moving = viewer_data(case) | {"follow": curves.follow}
    still_image = "" if case.still is None else still_address(case.still)
    estimates, misfits = plot_estimates(case, cases, colours), calibrated_misfits(case)
    return Section(case, curves, estimates, misfits, causes, headlines, walls, moving, still_image)


def _causes(setting: str, fit: FittedCase) -> list[CauseCard]:
    """Return the cards of the search and of the refit of a fit, if present."""
    titles = {"search on the sphere": fit.searched, "refit in three dimensions": fit.proved}
    return [
        cause_card(diagnosis, f"{setting}: {title}")
        for title, diagnosis in titles.items()
        if diagnosis is not None
    ]


def _environment() -> Environment:
    """Return the template environment, which escapes text and raises for undefined names."""
    environment = Environment(
        loader=PackageLoader("heartfit.results.report", "templates"),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    environment.filters |= {"quantity": quantity, "number": number, "rows": rows, "data": data}
    environment.globals |= {
        "facts": facts,
        "observations": observations,
        "distance": distance,
        "estimates": estimates,
        "status": status,
        "sentence": verdict_sentence,
        "mean_error": mean_error,
        "long_step_mark": LONG_STEP_MARK,
        "long_step_legend": LONG_STEP_LEGEND,
    }
    return environment


def data(content: Any) -> Markup:
    """Return JSON for a script element that no text in it can close."""
    text = json.dumps(content, separators=(",", ":"), allow_nan=False)
    return Markup(text.replace("<", "\\u003c").replace("\u2028", "\\u2028").replace("\u2029", "\\u2029"))
