"""Contents of the page: its parts in reading order.

What was found comes first: of a single heart its own section, of several hearts an overview and then each of them. The
tables that compare with the paper follow in the paper's study only, and provenance is last.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field

from heartfit.results.report.record import PAPER_TABLES, ReportTable, StudyRecord


@dataclass(frozen=True)
class PagePart:
    """A part of the page: identity, title, template, and titles of what it contains by identity."""

    name: str
    title: str
    template: str
    within: Mapping[str, str] = field(default_factory=dict)


def contents(study: StudyRecord) -> list[PagePart]:
    """Return the parts of the page of a study."""
    parts = _several_hearts(study) if len(study.cases) > 1 else _single_heart(study)
    if tables_of(study, paper=True):
        parts.append(PagePart("tables", "Comparison with the paper", "tables.html"))
    if tables_of(study, paper=False):
        parts.append(PagePart("checks", "Plausibility and costs", "checks.html"))
    return [*parts, PagePart("provenance", "Provenance", "provenance.html")]


def tables_of(study: StudyRecord, paper: bool) -> dict[str, ReportTable]:
    """Return the tables that compare with the paper, none in a study without its volunteers; or the other tables."""
    return {
        name: table
        for name, table in study.tables.items()
        if (name in PAPER_TABLES) == paper and (study.of_paper or not paper)
    }


def _several_hearts(study: StudyRecord) -> list[PagePart]:
    return [
        PagePart("cohort", "Cohort", "cohort.html"),
        *_found(study, "Missing mechanisms"),
        PagePart("parameters", "Parameters of all cases", "parameters.html"),
        PagePart("cases", "Cases", "cases.html", {name: name for name in study.cases}),
    ]


WITHIN_CASE = {
    "heart": "Beating ventricles",
    "curves": "Curves",
    "misfit": "Misfit",
    "mechanisms": "Missing mechanisms",
    "parameters": "Parameters",
}
"""Titles of the parts of a case by the end of their identity."""


def _single_heart(study: StudyRecord) -> list[PagePart]:
    (name,) = study.cases
    within = {f"{name}-{part}": title for part, title in WITHIN_CASE.items()}
    return [PagePart(name, name, "cases.html", within), *_found(study, "Missing mechanisms as a table")]


def _found(study: StudyRecord, title: str) -> list[PagePart]:
    """Return the part with the findings of the refitted cases, none without such a case."""
    return [PagePart("discovery", title, "discovery.html")] if study.discoveries else []
