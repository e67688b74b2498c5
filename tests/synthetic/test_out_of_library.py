"""Laws of the effects outside the library, in closed form."""

import numpy as np
import pytest

from heartfit.synthetic.out_of_library import (
    CatheterWhip,
    CurvedVolume,
    Obliteration,
    SeptalDefect,
    ThoracicPulse,
)

TIMES = np.arange(800) * 1e-3


def test_a_septal_defect_shunts_in_both_directions():
    branch = SeptalDefect(area=0.2e-4).law(TIMES)
    assert (branch.area, branch.back_area) == (0.2e-4, 0.2e-4)


def test_a_curved_volume_is_exact_at_its_ends_and_bows_between_them():
    values = np.linspace(60e-6, 140e-6, 801)
    change = CurvedVolume(bow=0.05).distort(TIMES, values, 0.8) - values
    assert change[[0, -1]] == pytest.approx([0.0, 0.0], abs=1e-12)
    assert change[400] == pytest.approx(0.05 * 80e-6)
    assert change.max() == pytest.approx(change[400])


def test_a_catheter_rings_from_the_steepest_rise_on():
    values = 8e3 + 7e3 * np.tanh((TIMES - 0.2) / 0.01)
    change = CatheterWhip(ring=600.0).distort(TIMES, values, 0.8) - values
    quarter = 1.0 / 36.0
    assert np.interp(0.2 + quarter, TIMES, change) == pytest.approx(600.0 * np.exp(-quarter / 0.1), rel=0.01)
    assert np.abs(change[:190]).max() < 2.0, "it has decayed when the next beat begins"


def test_a_strained_breath_presses_on_the_heart_in_diastole_only():
    pulse = ThoracicPulse(pressure=1000.0).load("lv", TIMES, 0.8).pulse
    assert pulse[640] == pytest.approx(1000.0)
    assert not pulse[(TIMES > 0.0) & (TIMES < 0.51)].any()


def test_an_obliterated_cavity_presses_the_more_the_emptier_it_is():
    effect = Obliteration(pressure=2000.0)
    load = effect.load("lv", TIMES, 0.8)
    pressures = [
        load.rise * np.exp((volume - load.volume) / load.scale)
        for volume in (effect.volume, effect.volume - effect.scale, effect.volume + effect.scale)
    ]
    assert pressures == pytest.approx([2000.0, 2000.0 * np.e, 2000.0 / np.e])
