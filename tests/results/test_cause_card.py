"""Card of a diagnosis for every verdict, and its figure."""

from dataclasses import replace

import numpy as np
import pytest

from heartfit.discovery.inference.decide import BesideProcess
from heartfit.discovery.inference.margin import Margin
from heartfit.discovery.sphere_model.cause import (
    Cause,
    Change,
    CurveFit,
    Diagnosis,
    Gain,
    Trace,
    UnnamedCandidate,
)
from heartfit.discovery.sphere_model.misfit import departures
from heartfit.discovery.sphere_model.recording import UNSEARCHED
from heartfit.observation.beat import BeatPhases
from heartfit.results.cause_card import alternatives_text, markdown_card
from heartfit.results.cause_figure import plot_cause
from heartfit.results.misfit_text import misfit_sentence
from heartfit.results.text import CURVES, spaced_name
from heartfit.results.verdict_text import (
    candidate_sentence,
    mechanism_with_size,
    objection_lines,
    verdict_sentence,
)
from tests.printed import numbers_in

LEAK = Cause("MitralRegurgitation", 12.0, 3e-5, "m^2", (2e-5, 4e-5))
DELAY = Cause("CatheterDelay", 11.0, 0.02, "s", (0.01, 0.03))
TIMES = np.arange(20) * 0.04
BUMP = 5e-6 * np.exp(-(((TIMES - 0.5) / 0.08) ** 2))
PHASES = BeatPhases(np.array([0.0, 0.06, 0.3, 0.36, 0.55, 0.65]), 0.8)
TRACE = Trace(
    "lv_volume",
    TIMES,
    1e-4 + BUMP,
    np.full(20, 1e-4),
    np.full(20, 1e-4),
    np.full(20, 2e-6),
    BUMP,
    np.full(20, 1e-6),
)


def diagnosis(verdict, mechanisms=(), **other):
    kept = {
        "ranking": {"MitralRegurgitation": 12.0, "unknown": -1.0},
        "traces": (TRACE,),
        "alternatives": (),
        "next_measurement": "",
        "gain": (),
        "phases": PHASES,
    }
    return Diagnosis(verdict, mechanisms, simulations=10, period=0.8, threshold=5.0, **{**kept, **other})


VERDICTS = {
    "none": (),
    "model": (),
    "named": (LEAK,),
    "two": (LEAK, DELAY),
    "group": (LEAK, DELAY),
    "unknown": (),
    "insufficient": (),
}
"""Mechanisms that a diagnosis of each verdict names."""
SENTENCES = {
    verdict: verdict_sentence(diagnosis(verdict, causes)).lower() for verdict, causes in VERDICTS.items()
}


def test_each_verdict_has_its_own_sentence():
    assert len(set(SENTENCES.values())) == len(VERDICTS)


@pytest.mark.parametrize("verdict", VERDICTS)
def test_a_sentence_names_the_mechanisms_of_its_verdict_and_no_other(verdict):
    shown = {cause.name for cause in (LEAK, DELAY) if spaced_name(cause.name) in SENTENCES[verdict]}
    assert shown == {cause.name for cause in VERDICTS[verdict]}


def test_a_sentence_gives_sizes_with_intervals_but_not_of_a_group():
    numbers = {verdict: set(numbers_in(text)) for verdict, text in SENTENCES.items()}
    assert {0.3, 0.2, 0.4} <= numbers["named"] < numbers["two"]
    assert {20.0, 10.0, 30.0} <= numbers["two"]
    assert not any(numbers[verdict] for verdict in ("group", "unknown", "insufficient"))
    assert numbers["none"] == {12.0, 5.0}, "the largest ln Bayes factor and its threshold"


def test_no_factor_is_printed_as_minus_zero():
    card = markdown_card(replace(diagnosis("none"), ranking={"MitralRegurgitation": -0.04}), "")
    assert "| mitral regurgitation | 0.0 |" in card


def test_a_departing_curve_outside_the_search_is_excepted():
    departing = diagnosis(
        "none", traces=(replace(TRACE, curve="rv_volume"),), unsearched={"rv_volume": "no right side"}
    )
    searched = replace(departing, unsearched={})
    assert CURVES["rv_volume"] in verdict_sentence(departing)
    assert CURVES["rv_volume"] not in verdict_sentence(searched)
    titles = [plot_cause(cause).axes[1].get_title() for cause in (departing, searched)]
    assert titles[0] != titles[1]
    assert [numbers_in(title) for title in titles] == [[2.7, 0.89, 3.0], [2.7, 0.89, 3.0]]


def test_a_curve_that_the_refit_explains_is_not_excepted_and_the_card_says_so():
    departing = diagnosis(
        "none", traces=(replace(TRACE, curve="rv_volume"),), unsearched={"rv_volume": "no right side"}
    )
    within, beyond = (
        replace(departing, fits=(CurveFit("rv_volume", chi_squared, 24.0, p),))
        for chi_squared, p in ((20.0, 0.7), (60.0, 6e-5))
    )
    assert CURVES["rv_volume"] not in verdict_sentence(within)
    assert CURVES["rv_volume"] in verdict_sentence(beyond)
    for one, numbers in ((within, [20.0, 24.0, 0.7]), (beyond, [60.0, 24.0, 6e-5])):
        (line,) = [line for line in bullets(markdown_card(one, "case 1")) if "chi-squared" in line]
        assert numbers_in(line)[-3:] == numbers


@pytest.mark.parametrize(
    ("p", "words"), [(0.7, "leaves no misfit"), (6e-5, "by more than its noise, though not in")]
)
def test_a_curve_without_a_clear_phase_is_missed_where_its_chi_squared_is_too_large(p, words):
    fit = CurveFit("lv_volume", 20.0, 24.0, p)
    (small,) = departures(diagnosis("none", traces=(replace(TRACE, measured=1e-4 + 0.4 * BUMP),)))
    assert words in misfit_sentence(small, "the refitted 3-D heart", fit)
    (clear,) = departures(diagnosis("none"))
    assert words not in misfit_sentence(clear, "the refitted 3-D heart", fit)


def test_units_are_clinical():
    assert {20.0, 10.0, 30.0} <= set(numbers_in(mechanism_with_size(DELAY)))
    assert "ms" in mechanism_with_size(DELAY)
    assert "cm²" in mechanism_with_size(LEAK)
    assert spaced_name("MitralRegurgitation") == "mitral regurgitation"


def test_a_departure_is_the_mean_residual_of_the_phase_in_which_it_is_clearest():
    """Five samples in early filling, of 2 mL noise each."""
    (departure,) = departures(diagnosis("unknown"))
    assert (departure.curve, departure.phase, departure.samples) == ("lv_volume", "early filling", 5)
    inside = (TIMES > 0.35) & (TIMES < 0.55)
    assert departure.size == pytest.approx(-BUMP[inside].mean())
    assert departure.sd == pytest.approx(2e-6 / np.sqrt(5.0))
    text = misfit_sentence(departure, "the sphere")
    assert [text.count(part) for part in (CURVES["lv_volume"], "early filling", "mL", " low")] == [1, 1, 1, 1]
    assert {2.7, 0.89, 3.0, 5.0} <= set(numbers_in(text))
    assert text.startswith("The sphere")


def test_the_discrepancy_of_the_search_is_no_misfit():
    """It is fitted in place of a mechanism with the parameters free, and may be far from the residuals."""
    far = replace(TRACE, lacking=np.full(20, 1.0), band=np.full(20, 1e-9))
    assert departures(diagnosis("named", (LEAK,), traces=(far,))) == departures(diagnosis("named", (LEAK,)))


def test_departures_upwards_within_noise_and_without_phases_are_distinguished():
    (higher,) = departures(diagnosis("unknown", traces=(replace(TRACE, measured=1e-4 - BUMP),)))
    assert " high" in misfit_sentence(higher, "the sphere")
    (sound,) = departures(diagnosis("none", traces=(replace(TRACE, measured=1e-4 + 0.4 * BUMP),)))
    assert not sound.clear
    text = misfit_sentence(sound, "the sphere")
    assert "no misfit" in text
    assert CURVES["lv_volume"] in text
    assert {1.1, 1.2} <= set(numbers_in(text)), "the largest one is told"
    (timeless,) = departures(diagnosis("unknown", phases=None))
    assert timeless.phase == "the beat from 400 to 500 ms"
    assert timeless.size == pytest.approx(-BUMP[(TIMES >= 0.4) & (TIMES < 0.5)].mean())


def bullets(text):
    """Items of the lists of a card."""
    return [line for line in text.splitlines() if line.startswith("- ")]


def test_a_curve_outside_the_search_is_listed_with_the_reason():
    listed = bullets(markdown_card(diagnosis("none", unsearched=UNSEARCHED), "case 1"))
    for curve, reason in UNSEARCHED.items():
        assert [line for line in listed if CURVES[curve] in line and reason in line]


BELOW, LEFT = BesideProcess(22.7, -1.4, 1.0, 2.0, 4.0), BesideProcess(22.7, 12.0, 8.5, 2.0, 7.9)


@pytest.mark.parametrize(
    ("beside", "numbers"), [(BELOW, {22.7, 24.1, 2.0, 1.4}), (LEFT, {8.5, 7.9})], ids=["below", "left"]
)
@pytest.mark.parametrize("verdict", ["unknown", "insufficient"])
def test_a_candidate_is_shown_with_the_rule_that_it_breaks_and_not_as_a_name(verdict, beside, numbers):
    case = diagnosis(verdict, candidate=UnnamedCandidate((LEAK, DELAY), beside))
    sentence = candidate_sentence(case)
    sizes = " ".join(map(mechanism_with_size, (LEAK, DELAY)))
    assert set(numbers_in(sentence)) - set(numbers_in(sizes)) == numbers
    assert ("below" in sentence) == (beside is BELOW)
    named = markdown_card(case, "case 1").split("Candidate, not named")
    assert len(named) == 2, "stated once"
    assert spaced_name(DELAY.name) not in named[0]
    figure = plot_cause(case)
    assert "Candidate, not named: mitral regurgitation and catheter delay" in figure.get_suptitle()
    assert labelled(figure.axes[0]) == labelled(plot_cause(diagnosis(verdict)).axes[0]) + 1


def test_the_card_lists_alternatives_gains_and_withdrawn_names():
    gain = Gain("lv_volume", "legs raised", 4e-6, 2e-6, 0.5, (0.4, 0.7))
    group = diagnosis("group", (LEAK, DELAY), alternatives=(("CatheterDelay",),), gain=(gain,))
    listed = bullets(markdown_card(group, "case 1"))
    assert f"- {spaced_name('CatheterDelay')}" in listed
    (gained,) = [line for line in listed if "legs raised" in line]
    assert {0.5, 0.4, 0.7} <= set(numbers_in(gained))
    withdrawn = markdown_card(diagnosis("unknown", withdrawn=("CatheterDelay",)), "case 1")
    assert spaced_name("CatheterDelay") in withdrawn
    assert spaced_name("CatheterDelay") not in markdown_card(diagnosis("unknown"), "case 1")


def test_an_unknown_cause_is_listed_with_the_best_of_the_library():
    assert spaced_name("MitralRegurgitation") in alternatives_text(diagnosis("unknown"))
    assert spaced_name("MitralRegurgitation") not in alternatives_text(diagnosis("none"))


def test_the_figure_has_a_row_for_each_curve_and_the_threshold():
    curves, residuals, ranking = plot_cause(diagnosis("named", (LEAK,))).axes
    assert set(ranking.lines[0].get_xdata()) == {5.0}
    assert [len(bar.get_yticklabels()) for bar in (ranking,)] == [2]
    assert labelled(curves) == labelled(plot_cause(diagnosis("unknown")).axes[0]) + 1 == 3
    labels = {text.get_text() for text in curves.get_legend().get_texts()}
    assert labels == {"measured", "sphere, no mechanism", "with mitral regurgitation"}
    assert numbers_in(residuals.get_title()) == [2.7, 0.89, 3.0]
    assert "early filling" in residuals.get_title()
    assert "IVC" in {text.get_text() for text in residuals.texts}


def labelled(axes):
    """Number of curves in the legend."""
    return sum(not str(line.get_label()).startswith("_") for line in axes.lines)


def test_the_card_states_what_structure_lets_the_simulation_err():
    """1.5 mL at the scale 0.5."""
    allowed = replace(TRACE, structure=np.full(20, 1.5e-6))
    text = markdown_card(diagnosis("model", traces=(allowed,), structural_scale=0.5), "heart")
    assert "Difference of structure" in text
    assert "left ventricular volume 1.5 mL" in text
    assert "0.5 times as large as usual" in text
    assert "Difference of structure" not in markdown_card(diagnosis("none"), "heart")


def test_a_card_whose_mechanism_needs_no_structure_says_so():
    """The scale is that of the fit without a mechanism: the sizes beside it were once those with it, 0 mL."""
    none = replace(TRACE, structure=np.zeros(20))
    text = markdown_card(diagnosis("named", (LEAK,), traces=(none,), structural_scale=1.0), "heart")
    assert "1 times as large as usual; with the mechanism it needs none" in text
    assert " 0 mL" not in text.partition("Difference of structure")[2].partition("##")[0]


def test_the_figure_shows_the_band_of_structure():
    allowed = replace(TRACE, structure=np.full(20, 1.5e-6))
    figure = plot_cause(diagnosis("model", traces=(allowed,), structural_scale=0.5))
    legends = [axes.get_legend() for axes in figure.get_axes() if axes.get_legend()]
    labels = [text.get_text() for legend in legends for text in legend.get_texts()]
    assert "structure, 95 % band" in labels


@pytest.mark.parametrize(
    ("change", "line"),
    [
        (Change("tissue.active.sigma_0", 1.31, (1.1, 1.55), "ratio"), "1.31 times (95 % CI 1.10 to 1.55)"),
        (Change("tissue.control.duration", -0.02, (-0.03, -0.01), "s"), "-20 ms (95 % CI -30 to -10)"),
        (Change("tissue.active.starling.slope", 0.1, (0.05, 0.15), "1"), "+0.10 (95 % CI +0.05 to +0.15)"),
    ],
)
def test_a_change_is_a_ratio_or_a_difference(change, line):
    text = markdown_card(diagnosis("none", changes=(change,)), "heart")
    assert f"- `{change.name}`: {line}" in text


def test_a_held_out_curve_that_fits_worse_beyond_chance_speaks_against_the_name():
    """Only a whole interval above 1 does, and only against a name or a candidate."""
    gains = (
        Gain("lv_volume", "frames that were not fitted", 4e-6, 2e-6, 0.5, (0.3, 0.8)),
        Gain("circumferential strain", "never fitted", 0.05, 0.06, 1.2, (1.1, 1.3)),
        Gain("longitudinal strain", "never fitted", 0.05, 0.06, 1.2, (0.9, 1.6)),
    )
    (objection,) = objection_lines(diagnosis("named", (LEAK,), gain=gains))
    assert objection in markdown_card(diagnosis("named", (LEAK,), gain=gains), "case")
    assert "circumferential strain (never fitted)" in objection
    assert "1.20 (1.10 to 1.30)" in objection
    assert objection_lines(diagnosis("unknown", gain=gains)) == []
    refitted = UnnamedCandidate((LEAK, DELAY), BELOW)
    assert objection_lines(diagnosis("unknown", gain=gains, candidate=refitted)) == [objection]


def test_the_noise_of_a_curve_that_was_read_twice_is_said_with_what_it_misses():
    card = markdown_card(diagnosis("none", read_twice={"lv_volume": 1.3e-6}), "case")
    assert (
        "left ventricular volume was read twice. The difference of both readings gives a noise of 1.3 mL"
        in card
    )
    assert "the length of the cavity, does not show" in card


def test_a_close_decision_says_what_would_change_it() -> None:
    """And a clear one says nothing of it."""
    close = Margin(("MitralRegurgitation",), False, -0.21, "none")
    card = markdown_card(diagnosis("named", (LEAK,), margin=close), "Case")
    assert (
        'Close decision: the search would give "none" if the ln evidence of mitral regurgitation were 0.21 lower'
        in card
    )
    on_top = Margin(("MitralRegurgitation",), True, 0.4, "unknown")
    card = markdown_card(diagnosis("named", (LEAK,), margin=on_top), "Case")
    assert "a smooth error on top of mitral regurgitation were 0.40 higher" in card
    assert "Close decision" not in markdown_card(diagnosis("named", (LEAK,)), "Case")
