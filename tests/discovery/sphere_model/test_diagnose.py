"""A planted leak is named with its size; none is found without one; a volume alone is not sufficient."""

from dataclasses import replace

import pytest

from heartfit.discovery.sphere_model.diagnose import diagnose, near_best
from heartfit.io.causes import read_cause, write_cause_card
from heartfit.results.cause_card import markdown_card
from heartfit.results.cause_figure import render_cause
from heartfit.results.verdict_text import verdict_sentence
from heartfit.synthetic.case import plant
from tests.discovery.sphere_model.hearts import LEAK, healthy, recorded

pytestmark = pytest.mark.usefixtures("few_mechanisms", "coarse_search")


@pytest.fixture(scope="module")
def diagnosis(few_mechanisms, coarse_search):
    return diagnose(recorded(LEAK), {"legs raised": recorded(LEAK, "legs_raised")})


def test_a_planted_leak_is_named_and_its_interval_covers(diagnosis):
    (cause,), (planted,) = diagnosis.mechanisms, plant(LEAK).answer.effects
    assert diagnosis.verdict == "named"
    assert cause.name == planted.name
    assert cause.ln_bayes_factor > 10.0
    assert cause.interval[0] < planted.amplitude < cause.interval[1]
    assert cause.unit == "m^2"


def test_the_diagnosis_gains_under_a_held_out_loading(diagnosis):
    assert {gain.on for gain in diagnosis.gain} == {"legs raised"}
    assert all(gain.ratio < 1.0 for gain in diagnosis.gain)
    assert all(gain.interval[0] < gain.ratio < gain.interval[1] for gain in diagnosis.gain)


def test_the_card_states_the_verdict_in_words(diagnosis):
    assert verdict_sentence(diagnosis).startswith("Missing mechanism: mitral regurgitation, 0.")
    text = markdown_card(diagnosis, "case 1")
    assert "cm²" in text
    assert "legs raised" in text
    assert str(diagnosis.simulations) in text


def test_the_card_is_written_and_read(diagnosis, tmp_path):
    write_cause_card(tmp_path / "deep", render_cause(diagnosis, "case 1"), "0123")
    content = read_cause(tmp_path / "deep" / "cause.json")
    assert content["verdict"] == "named"
    assert content["mechanisms"][0]["amplitude"] == diagnosis.mechanisms[0].amplitude
    assert content["fingerprint"] == "0123"
    assert (tmp_path / "deep" / "cause.png").stat().st_size > 10_000


def test_every_tried_model_is_listed_with_its_criteria(diagnosis):
    none, *others = diagnosis.tried
    assert none.effects == ()
    singles = {tried_model.effects[0]: tried_model for tried_model in others if len(tried_model.effects) == 1}
    assert singles.keys() == diagnosis.ranking.keys() - {"unknown"}
    for name, tried_model in singles.items():
        assert tried_model.ln_evidence - none.ln_evidence == pytest.approx(diagnosis.ranking[name])
        assert tried_model.unknowns > none.unknowns == 23
    leak = singles["MitralRegurgitation"]
    assert none.negative_ln_likelihood - leak.negative_ln_likelihood > 10.0
    assert diagnosis.samples == sum(trace.times.size for trace in diagnosis.traces)


def test_another_condition_separates_members_of_a_group():
    leak, delay, shrunk = ("Leak",), ("Delay",), ("Shrunk",)
    assert near_best({leak: 9.0, delay: 12.5, shrunk: 10.0}, 3.0) == [delay, shrunk]
    assert near_best({leak: 9.0, delay: 12.5, shrunk: 9.5}, 3.0) == [delay]
    assert near_best({}, 3.0) == []


@pytest.mark.parametrize(
    "seed", [6, pytest.param(1, marks=pytest.mark.long), pytest.param(4, marks=pytest.mark.long)]
)
def test_no_effect_is_found_in_a_healthy_heart(seed):
    diagnosis = diagnose(healthy(seed))
    assert diagnosis.verdict == "none"
    assert diagnosis.mechanisms == diagnosis.gain == ()
    assert diagnosis.next_measurement == ""


def test_a_volume_alone_is_insufficient():
    both = healthy(4)
    diagnosis = diagnose(replace(both, curves={"lv_volume": both.curves["lv_volume"]}))
    assert diagnosis.verdict == "insufficient"
    assert "pressure" in diagnosis.next_measurement
    assert verdict_sentence(diagnosis).startswith("Insufficient data")
