"""The cause card of a case as the page shows it."""

from dataclasses import dataclass

from heartfit.diagnosis.cause import Diagnosis
from heartfit.diagnosis.departure import departures
from heartfit.report.grid import WIDTH
from heartfit.report.picture import Picture, picture
from heartfit.tables.cause_card import (
    CURVES,
    alternatives,
    gaining,
    gains,
    missed,
    sentence,
    spoken,
    tested,
)
from heartfit.tables.cause_figure import plot_cause

SHOWN = 6
"""Causes of the ranking."""


@dataclass(frozen=True)
class CauseCard:
    """What a reader wants to know, in the order of the question: what is missed, what lacks, how sure, what next."""

    title: str
    verdict: str
    sentence: str
    misses: list[str]
    ranking: list[tuple[str, float]]
    threshold: float
    alternatives: list[str]
    next_measurement: str
    gaining: str
    gains: list[str]
    refit: list[tuple[str, float, float]]
    remarks: list[str]
    figure: Picture | None


def cause_card(diagnosis: Diagnosis, title: str) -> CauseCard:
    """The card of a diagnosis."""
    unsearched = [f"{CURVES[name]}: not searched, {why}." for name, why in diagnosis.unsearched.items()]
    refitted = diagnosis.refitted
    return CauseCard(
        title=title,
        verdict=diagnosis.verdict,
        sentence=sentence(diagnosis),
        misses=[*map(missed, departures(diagnosis)), *unsearched],
        ranking=[(spoken(name), value) for name, value in list(diagnosis.ranking.items())[:SHOWN]],
        threshold=diagnosis.threshold,
        alternatives=_lines(alternatives(diagnosis)),
        next_measurement=diagnosis.next_measurement or "Nothing: the data decide.",
        gaining=gaining(diagnosis),
        gains=_lines(gains(diagnosis.gain)),
        refit=[(name, refitted.none[name], value) for name, value in refitted.extended.items()]
        if refitted
        else [],
        remarks=_remarks(diagnosis),
        figure=_figure(diagnosis),
    )


def _remarks(diagnosis: Diagnosis) -> list[str]:
    refitted = diagnosis.refitted
    settled = {True: "Both refits converged.", False: "A refit was still moving at its last step."}
    return [
        *([tested(diagnosis)] if diagnosis.self_test is not None else []),
        *([settled[refitted.converged]] if refitted else []),
        f"{diagnosis.simulations} simulated beats in all.",
    ]


def _figure(diagnosis: Diagnosis) -> Picture | None:
    if not diagnosis.traces:
        return None
    figure = plot_cause(diagnosis)
    figure.set_size_inches(WIDTH, figure.get_figheight())
    figure.suptitle("")  # the page says it
    return picture(figure, f"Measured and simulated curves and what departs. {sentence(diagnosis)}")


def _lines(text: str) -> list[str]:
    return [line.removeprefix("- ") for line in text.splitlines()]
