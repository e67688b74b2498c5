"""Cause card of a case on the page."""

from dataclasses import dataclass

from heartfit.discovery.sphere_model.cause import Diagnosis
from heartfit.results.cause_card import (
    alternatives_text,
    gain_subject,
    gains_text,
    next_measurement_text,
    self_test_sentence,
)
from heartfit.results.cause_figure import plot_cause
from heartfit.results.misfit_text import misfit_lines
from heartfit.results.report.picture import WIDTH, Picture, as_picture
from heartfit.results.verdict_text import explanation_name, verdict_lines, verdict_sentence

RANKING_ROWS = 6
"""Number of rows of the ranking."""


@dataclass(frozen=True)
class CauseCard:
    """Content of a cause card in reading order: headline, lines below it, misfit, evidence, next measurement."""

    title: str
    verdict: str
    sentence: str
    lines: list[str]
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
    """Return the card of a diagnosis."""
    refitted = diagnosis.refitted
    return CauseCard(
        title=title,
        verdict=diagnosis.verdict,
        sentence=verdict_sentence(diagnosis),
        lines=verdict_lines(diagnosis),
        misses=list(misfit_lines(diagnosis)),
        ranking=[
            (explanation_name(name), value) for name, value in list(diagnosis.ranking.items())[:RANKING_ROWS]
        ],
        threshold=diagnosis.threshold,
        alternatives=_lines(alternatives_text(diagnosis)),
        next_measurement=next_measurement_text(diagnosis),
        gaining=gain_subject(diagnosis),
        gains=_lines(gains_text(diagnosis.gain)),
        refit=[(name, refitted.none[name], value) for name, value in refitted.extended.items()]
        if refitted
        else [],
        remarks=_remarks(diagnosis),
        figure=_figure(diagnosis),
    )


def _remarks(diagnosis: Diagnosis) -> list[str]:
    refitted = diagnosis.refitted
    convergence = {True: "Both refits converged.", False: "A refit had not converged at its last step."}
    return [
        *([self_test_sentence(diagnosis)] if diagnosis.self_test is not None else []),
        *([convergence[refitted.converged]] if refitted else []),
        f"Simulated beats: {diagnosis.simulations}.",
    ]


def _figure(diagnosis: Diagnosis) -> Picture | None:
    if not diagnosis.traces:
        return None
    figure = plot_cause(diagnosis)
    figure.set_size_inches(WIDTH, figure.get_figheight())
    figure.suptitle("")  # the page shows the verdict as text
    return as_picture(figure, f"Measured and simulated curves and the misfit. {verdict_sentence(diagnosis)}")


def _lines(text: str) -> list[str]:
    return [line.removeprefix("- ") for line in text.splitlines()]
