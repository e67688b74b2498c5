"""Detection limits of planted effects."""

from heartfit.discovery.sphere_model.limits import DetectionLimit
from heartfit.mechanisms.catheter_delay import CatheterDelay
from heartfit.synthetic import scoring as module
from heartfit.synthetic.campaign import Effect
from heartfit.synthetic.case import Answer
from heartfit.synthetic.scoring import DetectableSizes, Scored
from heartfit.synthetic.trial import ScoredDiagnosis
from tests.printed import numbers_in


def hiding(name, scales, sign=1.0):
    effect = Effect(name, sign * 0.02 * scales, 0.0, "s", scales)
    return Scored(Answer(1, "single", (effect,), {}, {}, 0.02), ScoredDiagnosis("none"))


def test_a_size_is_compared_with_the_limit_of_its_sign(monkeypatch):
    def known(hearts, names, threshold):
        assert (hearts, names, threshold) == (1, ["CatheterDelay"], 7.0)
        switch = CatheterDelay.switch()
        return [
            DetectionLimit("CatheterDelay", switch, 1.0, (), 1.5),
            DetectionLimit("CatheterDelay", switch, -1.0, (), None),
        ]

    monkeypatch.setattr(module, "detection_limits", known)
    least = DetectableSizes.of([hiding("CatheterDelay", 2.0), hiding("CatheterDelay", 2.5)], 7.0)
    assert numbers_in(least.describe("CatheterDelay")) == [1.5, 4.0]
    assert least.is_detectable(hiding("CatheterDelay", 1.5))
    assert not least.is_detectable(hiding("CatheterDelay", 1.4))
    assert not least.is_detectable(hiding("CatheterDelay", 4.0, -1.0))


def test_cases_without_a_single_effect_are_not_counted():
    least = DetectableSizes.of([], 7.0)
    assert not least.is_detectable(Scored(Answer(1, "none", (), {}, {}, 0.02), ScoredDiagnosis("none")))
    assert least.describe("SecondTwitch") == ""
