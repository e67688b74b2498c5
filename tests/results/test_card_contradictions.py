"""No sentence of a card contradicts another one, over all verdicts, misfits, refits and withdrawn names."""

import re
from dataclasses import replace
from itertools import product

import numpy as np
import pytest

from heartfit.discovery.inference.decide import BesideProcess
from heartfit.discovery.sphere_model.cause import (
    ActingPlace,
    Cause,
    Diagnosis,
    Gain,
    Refitted,
    Trace,
    UnnamedCandidate,
)
from heartfit.discovery.sphere_model.misfit import (
    CLEAR_MISFIT,
    departures,
    deviation_of_means,
    largest_departure,
    phase_names,
)
from heartfit.discovery.sphere_model.strokes import Strokes
from heartfit.observation.beat import BeatPhases
from heartfit.results.cause_card import markdown_card
from heartfit.results.cause_figure import plot_cause
from heartfit.results.misfit_text import MODELS, misfit_sentences
from heartfit.results.report.cause import cause_card
from heartfit.results.text import CURVES, spaced_name
from heartfit.results.verdict_text import candidate_causes, verdict_lines, verdict_sentence
from tests.printed import numbers_in

PERIOD = 0.8
PHASES = BeatPhases(np.array([0.0, 0.06, 0.3, 0.36, 0.55, 0.65]), PERIOD)
UNSEARCHED = {"rv_volume": "the sphere of the search has no right ventricle"}
LEAK = Cause("MitralRegurgitation", 12.0, 3e-5, "m^2", (2e-5, 4e-5))
FRICTION = Cause("RelaxedFriction", 12.0, 1.4, "1", (0.3, 2.5))
NAMED = {"named": (LEAK,), "two": (LEAK, FRICTION), "group": (LEAK, FRICTION)}
VERDICTS = ("none", "model", "named", "two", "group", "unknown", "insufficient")
PLACE = ActingPlace("catheter", "PressureError", "the measured pressure, at a time", 9.0)
UNITS = {"lv_volume": 1e-6, "lv_pressure": 1e3, "rv_volume": 1e-6}


def trace(curve: str, rng: np.random.Generator, misfit: float, left: float) -> Trace:
    """Residuals of noise alone, and ``misfit`` (``left`` with the mechanism) of its deviations more in ejection."""
    times = np.sort(rng.uniform(0.0, 2.0 * PERIOD, 40))
    noise = UNITS[curve] * np.full(40, 2.0)
    measured = UNITS[curve] * (100.0 + 10.0 * rng.standard_normal(40))
    pulse = noise * (phase_names(times, PERIOD, PHASES) == "ejection")
    none, extended = (
        measured + size * pulse + 0.2 * noise * rng.standard_normal(40) for size in (misfit, left)
    )
    return Trace(curve, times, measured, none, extended, noise, 9.0 * noise, noise)


def grown(cause: Cause, factor: float) -> Cause:
    low, high = cause.interval
    return replace(cause, amplitude=factor * cause.amplitude, interval=(factor * low, factor * high))


def diagnosis(verdict: str, misfit: float, refit: bool, withdrawn: bool, seed: int) -> Diagnosis:
    rng = np.random.default_rng(seed)
    named = NAMED.get(verdict, ())
    curves = tuple(UNITS) if refit else ("lv_volume", "lv_pressure")
    tried = named[: 1 if verdict == "group" else 2] or (LEAK,)
    refitted = Refitted(
        tuple(grown(cause, 1.1) for cause in tried), 8.0, {"mu": 7e3}, {"mu": 8e3}, 40, True,
        tuple(grown(cause, 1.2) for cause in tried),
    )  # fmt: skip
    proved = refit and verdict not in ("none", "insufficient")
    return Diagnosis(
        verdict, named, (("FRICTION",),) if verdict == "group" else (), "",
        (Gain("lv_volume", "other frames", 2e-6, 1e-6, 0.5, (0.4, 0.6)),), 900, PERIOD, 25.0 if misfit < 0.0 else 5.0,
        ranking={"MitralRegurgitation": 11.6, "unknown": 4.0, "RelaxedFriction": 2.5},
        withdrawn=("CatheterDelay",) if withdrawn else (),
        traces=tuple(trace(curve, rng, misfit, 0.1 * misfit) for curve in curves),
        refitted=refitted if proved else None, unsearched=UNSEARCHED, phases=PHASES,
        from_all_samples=tuple(grown(cause, 1.3) for cause in named),
        acting=(PLACE,) if verdict == "unknown" and seed % 2 else (),
        strokes=Strokes(9e-5, 4e-5, 9e-6), model="3-D heart" if refit else "sphere", free_parameters=23,
    )  # fmt: skip


CASES = [
    diagnosis(*case, seed)
    for seed, case in enumerate(product(VERDICTS, (-3.0, 0.0, 3.0), (False, True), (False, True)))
]
CASES += [
    replace(case, candidate=UnnamedCandidate((LEAK, FRICTION), BesideProcess(22.7, -1.4, 1.0, 2.0, 4.0)))
    for case in CASES
    if case.verdict in ("unknown", "insufficient") and not case.withdrawn
]
IDS = [f"{case.verdict}-{number}" for number, case in enumerate(CASES)]
DRAWN = CASES[5::11]
"""A part of the cases, in which every verdict, misfit, refit and withdrawal comes up."""
FACTOR = re.compile(r"ln Bayes factor", re.IGNORECASE)


def misfit_parts(card: str) -> list[str]:
    return [line for line in card.splitlines() if "beyond the noise" in line or " sd of " in line]


def assert_the_headline_is_the_verdict(case: Diagnosis, card: str) -> None:
    bold = re.findall(r"^\*\*(.+)\*\*$", card, re.MULTILINE)
    assert bold == [verdict_sentence(case)]
    if case.verdict == "none":
        assert "(none)" in bold[0], "the verdict keeps its name"


def assert_each_mechanism_has_one_size(case: Diagnosis, card: str) -> None:
    causes = case.mechanisms or candidate_causes(case)
    for cause in causes:
        size = re.findall(
            rf"{spaced_name(cause.name)}, [\d.]+ (cm²|\(no unit,)[ (]*95 % CI [\d.]+ to [\d.]+\)", card
        )
        number = 0 if case.verdict == "group" and not (case.refitted and cause is LEAK) else 1
        assert len(size) == number
    assert card.count("95 % CI") - card.count("error ratio") <= max(len(causes), 1)


def assert_the_size_is_that_of_the_refit_or_of_all_samples(case: Diagnosis) -> None:
    if case.verdict in ("named", "two"):
        expected = 0.36 if case.refitted else 0.39
        assert numbers_in(verdict_sentence(case))[0] == pytest.approx(expected)
        half = replace(case, from_all_samples=(), refitted=None)
        assert numbers_in(verdict_sentence(half))[0] == pytest.approx(0.3)
        sources = [
            [line for line in verdict_lines(one) if line.startswith("Sizes are")] for one in (case, half)
        ]
        assert ["all samples" in lines[0] for lines in sources] == [True, False]


def assert_factors_stand_beside_their_threshold(case: Diagnosis, card: str) -> None:
    for line in card.splitlines():
        if FACTOR.search(line) and not line.startswith(("## ", "None in the library")):
            assert "threshold" in line or "must exceed" in line, line
    assert f"{case.threshold:g}" in card
    if case.verdict in ("none", "model"):
        assert {11.6, case.threshold} <= set(numbers_in(verdict_sentence(case)))


def assert_misfits_name_their_model_and_none_is_denied(case: Diagnosis, card: str) -> None:
    lines = misfit_parts(card)
    assert len(lines) == len(misfit_sentences(case))
    denials: dict[tuple[str, str], list[bool]] = {}
    for line in lines:
        (model,) = [words for words in MODELS.values() if words in line[0:2] + line[2].lower() + line[3:]]
        (state,) = re.findall(r"\((23 free parameters, [^)]+)\)", line)
        (curve,) = [words for words in CURVES.values() if words in line]
        denials.setdefault((model + state, curve), []).append("no misfit" in line)
    assert all(len(states) == 1 for states in denials.values()), "one sentence for each model and curve"
    silent = "beyond the noise" in card.split("## Misfit")[0]
    assert not silent, "the headline leaves misfits to the section that names their models"


@pytest.mark.parametrize("case", DRAWN, ids=IDS[5::11])
def test_the_number_of_a_sentence_is_the_mean_of_the_residuals_that_are_drawn(case: Diagnosis) -> None:
    figure, sentences = plot_cause(case), misfit_sentences(case)
    assert figure.get_suptitle().splitlines()[0] == verdict_sentence(case)
    assert f"threshold {case.threshold:g}" in figure.axes[-1].get_xlabel()
    for panel, sentence, departure in zip(figure.axes[1::2], sentences, departures(case), strict=False):
        dots = panel.lines[1]
        inside = phase_names(dots.get_xdata(), PERIOD, PHASES) == departure.phase
        mean = float(np.mean(dots.get_ydata()[inside]))
        printed = numbers_in(sentence.split(")", 1)[1])
        assert printed[0] == pytest.approx(abs(mean), rel=0.06, abs=0.006)
        assert printed[1] == pytest.approx(2.0 / np.sqrt(inside.sum()), rel=0.06), "the noise of the mean"
        assert ("too high" in sentence) == (mean > 0.0)
        assert ("no misfit" in sentence) == (abs(departure.deviations) < CLEAR_MISFIT)
        assert f"{printed[0]:g} ± {printed[1]:g}" in panel.get_title()
        bars = [segment for lines in panel.collections for segment in getattr(lines, "get_segments", list)()]
        assert any(bar[0, 1] == pytest.approx(mean) for bar in bars), "the mean is drawn, too"


def assert_a_clear_misfit_stays_unexplained(case: Diagnosis, card: str) -> None:
    searched = [one for one in departures(case) if one.curve not in case.unsearched]
    silent = case.verdict in ("none", "model", "insufficient")
    assert ("stays unexplained" in card) == (silent and any(one.clear for one in searched))
    assert "explains the recording" not in card
    assert ("can take the place of a mechanism" in card) == (
        bool(case.mechanisms) and not any(one.clear for one in searched)
    )


def assert_the_report_says_what_the_card_says(case: Diagnosis) -> None:
    shown, card = (
        cause_card(replace(case, traces=()), "heart"),
        markdown_card(replace(case, traces=()), "heart"),
    )
    for sentence in (shown.sentence, *shown.lines, *shown.misses):
        assert sentence in card


@pytest.mark.parametrize("case", CASES, ids=IDS)
def test_no_sentence_of_a_card_contradicts_another(case: Diagnosis) -> None:
    card = markdown_card(case, "heart")
    assert_the_headline_is_the_verdict(case, card)
    assert_each_mechanism_has_one_size(case, card)
    assert_the_size_is_that_of_the_refit_or_of_all_samples(case)
    assert_factors_stand_beside_their_threshold(case, card)
    assert_misfits_name_their_model_and_none_is_denied(case, card)
    assert_a_clear_misfit_stays_unexplained(case, card)
    assert_the_report_says_what_the_card_says(case)


def test_noise_alone_has_a_clear_misfit_in_one_curve_of_twenty() -> None:
    """Correlated noise of 40 samples; the deviation of the means knows its covariance."""
    rng = np.random.default_rng(5)
    times = np.arange(40) * PERIOD / 40
    names = phase_names(times, PERIOD, PHASES)
    lags = np.abs(times[:, None] - times)
    covariance = np.exp(-lags / 0.03) + 0.2 * np.eye(40)
    root, sd = np.linalg.cholesky(covariance), deviation_of_means(covariance, names)
    clear = [
        largest_departure("lv_volume", root @ rng.standard_normal(40), sd, names).clear for _ in range(2000)
    ]
    assert 0.03 < np.mean(clear) < 0.07


def test_the_deviation_of_a_mean_is_that_of_white_and_of_common_noise() -> None:
    names = np.array(["a", "a", "a", "a", "b"])
    assert deviation_of_means(np.eye(5), names) == pytest.approx([0.5, 0.5, 0.5, 0.5, 1.0])
    assert deviation_of_means(np.ones((5, 5)), names) == pytest.approx(np.ones(5))
