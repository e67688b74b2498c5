"""Detection limits of planted effects."""

from heartfit.diagnosis.limits import Limit
from heartfit.mechanisms.catheter_delay import CatheterDelay
from heartfit.planting import least as module
from heartfit.planting.case import Answer
from heartfit.planting.effects import Effect
from heartfit.planting.least import Least
from heartfit.planting.scoring import Scored
from heartfit.planting.trial import Finding


def hiding(name, scales, sign=1.0):
    effect = Effect(name, sign * 0.02 * scales, 0.0, "s", scales)
    return Scored(Answer(1, "single", (effect,), {}, {}, 0.02), Finding("none"))


def test_a_size_is_held_against_the_limit_of_its_own_sign(monkeypatch):
    def known(hearts, names, threshold):
        assert (hearts, names, threshold) == (1, ["CatheterDelay"], 7.0)
        switch = CatheterDelay.switch()
        return [Limit("CatheterDelay", switch, 1.0, (), 1.5), Limit("CatheterDelay", switch, -1.0, (), None)]

    monkeypatch.setattr(module, "limits", known)
    least = Least.of([hiding("CatheterDelay", 2.0), hiding("CatheterDelay", 2.5)], 7.0)
    assert least.told("CatheterDelay") == "1.5 or not to 4"
    assert least.reached(hiding("CatheterDelay", 1.5))
    assert not least.reached(hiding("CatheterDelay", 1.4))
    assert not least.reached(hiding("CatheterDelay", 4.0, -1.0))


def test_what_is_not_single_is_not_counted():
    least = Least.of([], 7.0)
    assert not least.reached(Scored(Answer(1, "none", (), {}, {}, 0.02), Finding("none")))
    assert least.told("SecondTwitch") == ""
