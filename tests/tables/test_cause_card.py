"""What a card says of a diagnosis, verdict by verdict, and its figure."""

from dataclasses import replace

import numpy as np
import pytest

from heartfit.diagnosis.cause import Cause, Diagnosis, Gain, Trace
from heartfit.diagnosis.departure import departures
from heartfit.diagnosis.recording import UNSEARCHED
from heartfit.observation.beat_phases import BeatPhases
from heartfit.tables.cause_card import card, missed, sentence, sized, spoken
from heartfit.tables.cause_figure import plot_cause

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


@pytest.mark.parametrize(
    ("verdict", "mechanisms", "expected"),
    [
        ("none", (), "nothing is missing"),
        ("named", (LEAK,), "lacks mitral regurgitation of 0.3 cm² (95 % interval 0.2 to 0.4)."),
        ("two", (LEAK, DELAY), "and catheter delay of 20 ms"),
        ("group", (LEAK, DELAY), "one of mitral regurgitation, catheter delay"),
        ("unknown", (), "no mechanism of the library"),
        ("insufficient", (), "cannot tell"),
    ],
)
def test_each_verdict_is_a_sentence(verdict, mechanisms, expected):
    assert expected in sentence(diagnosis(verdict, mechanisms))


def test_what_no_search_looked_at_is_not_called_explained():
    departing = diagnosis(
        "none", traces=(replace(TRACE, curve="rv_volume"),), unsearched={"rv_volume": "no right side"}
    )
    assert "but for the right ventricular volume, which was not searched" in sentence(departing)
    assert "explains the recording: " in sentence(replace(departing, unsearched={}))
    assert "RV volume (not searched) too low" in plot_cause(departing).axes[1].get_title()


def test_units_are_clinical():
    assert sized(DELAY) == "catheter delay of 20 ms (95 % interval 10 to 30)"
    assert spoken("MitralRegurgitation") == "mitral regurgitation"


def test_what_is_missed_has_size_sign_and_phase():
    (found,) = departures(diagnosis("unknown"))
    assert missed(found) == (
        "left ventricular volume: simulated 4.7 ± 1 mL too low in early filling, 4.7 standard deviations, "
        "480 ms after the trigger."
    )
    (sound,) = departures(diagnosis("none", traces=(replace(TRACE, lacking=0.4 * BUMP),)))
    assert missed(sound) == "left ventricular volume: nothing beyond its noise."
    (timeless,) = departures(diagnosis("unknown", phases=None))
    assert "too low, 4.7" in missed(timeless)


def test_what_was_not_searched_is_told():
    told = card(diagnosis("none", unsearched=UNSEARCHED), "case 1")
    assert "- right ventricular volume: not searched, the sphere" in told


def test_the_card_tells_withdrawn_names_alternatives_and_gains():
    gain = Gain("lv_volume", "legs raised", 4e-6, 2e-6, 0.5, (0.4, 0.7))
    told = card(diagnosis("group", (LEAK, DELAY), alternatives=(("CatheterDelay",),), gain=(gain,)), "case 1")
    assert "- catheter delay" in told
    assert "error times 0.50 (95 % interval 0.40 to 0.70)" in told
    assert "withdrawn" in card(diagnosis("unknown", withdrawn=("CatheterDelay",)), "case 1")


def test_what_is_unknown_is_beside_the_best_of_the_library():
    assert "mitral regurgitation, the best of it" in card(diagnosis("unknown"), "case 1")


def test_the_figure_has_a_row_for_each_curve_and_the_threshold():
    figure = plot_cause(diagnosis("named", (LEAK,)))
    curves, residuals, ranking = figure.axes
    assert ranking.get_xlabel() == "ln Bayes factor\nover none"
    assert {line.get_label() for line in curves.lines} >= {"measured", "simulated", "with the cause"}
    assert residuals.get_title() == "LV volume too low in early filling: 4.7 sd"
    assert "IVC" in {text.get_text() for text in residuals.texts}
