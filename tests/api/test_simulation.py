"""Simulated beats and their measurement through the public names."""

import numpy as np
import pytest

import heartfit as hf


def test_a_leak_lowers_the_pressure_and_empties_the_ventricle():
    heart = hf.adult()
    healthy, leaking = (hf.simulate(h) for h in (heart, heart + hf.mechanisms.MitralRegurgitation(area=6e-5)))
    assert leaking.pressure["lv"].max() < healthy.pressure["lv"].max()
    assert leaking.volume["lv"].min() < healthy.volume["lv"].min()
    assert healthy.diagnostics["drift"] < 1e-5


def test_both_ventricles_beat_on_request():
    assert hf.simulate(hf.adult(both_ventricles=True)).volume.keys() == {"lv", "rv"}


def test_a_mechanism_of_the_right_heart_needs_one():
    leak = hf.mechanisms.TricuspidRegurgitation()
    with pytest.raises(hf.InputError, match=r"adult\(both_ventricles=True\)"):
        hf.adult() + leak
    assert leak in (hf.adult(both_ventricles=True) + leak).heart.mechanisms


def test_a_heart_takes_one_sphere_or_two():
    sphere = hf.Sphere.from_volumes(cavity=1.2e-4, wall=1.2e-4)
    bare, listed = hf.simulate(hf.Heart(), sphere), hf.simulate(hf.Heart(), [sphere])
    assert np.array_equal(bare.volume["lv"], listed.volume["lv"])


def test_ventricles_are_defined_once():
    with pytest.raises(hf.InputError, match="has no ventricles; expected spheres"):
        hf.simulate(hf.Heart())
    with pytest.raises(hf.InputError, match="leave spheres out"):
        hf.simulate(hf.adult(), hf.Sphere.from_volumes(1.2e-4, 1.2e-4))


def test_a_measurement_scatters_about_the_beat_from_the_trigger_on():
    beat = hf.simulate(hf.adult())
    recording = hf.measure(beat, volume_noise=0.01, pressure_noise=100.0, seed=3)
    true = hf.curves(beat)
    for name, most in (("lv_volume", 6e-6), ("lv_pressure", 700.0)):
        samples = recording.curves[name]
        assert 0.0 <= samples.times.min() <= samples.times.max() < beat.period
        error = samples.values - true[name](samples.times)
        assert 0.0 < np.abs(error).max() < most
    assert hf.measure(beat, seed=3).curves["lv_volume"].values == pytest.approx(
        hf.measure(beat, seed=3).curves["lv_volume"].values
    )


def test_a_curve_that_is_not_there_is_refused():
    beat = hf.simulate(hf.adult())
    with pytest.raises(hf.InputError, match="no curve rv_volume; expected some of lv_volume, lv_pressure"):
        hf.measure(beat, ["rv_volume"])
    failed = hf.simulate(hf.adult().with_parameters({"sigma_0": 1e9}))
    assert not failed.completed
    with pytest.raises(hf.InputError, match="measure: the beat failed"):
        hf.measure(failed)


def test_values_print_on_one_line():
    heart = hf.adult() + hf.mechanisms.MitralRegurgitation(area=6e-5)
    beat = hf.simulate(heart)
    failed = hf.simulate(hf.adult().with_parameters({"sigma_0": 1e9}))
    values = [heart, heart.heart, beat, failed, hf.measure(beat), heart.prior({"sigma_0": 0.3})]
    texts = list(map(repr, values))
    assert [text for text in texts if len(text) > 200 or "\n" in text] == []
    assert "MitralRegurgitation(area=6e-05)" in texts[0]
    assert texts[2].startswith("Beat(0.86 s: lv 3")
    assert texts[3].startswith("Beat(failed: beat 1")
    assert texts[4] == "Recording(0.86 s: lv_volume 25 samples, lv_pressure 86 samples)"
    assert texts[5] == "Gaussian(sigma_0 = 1.9e+05 ± 30 %)"


@pytest.mark.parametrize("area", ["big", None])
def test_a_parameter_that_is_no_number_is_refused(area):
    with pytest.raises(hf.InputError, match=r"MitralRegurgitation.area = .*: expected a number in m\^2"):
        hf.mechanisms.MitralRegurgitation(area=area)
