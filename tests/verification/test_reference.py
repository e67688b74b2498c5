"""Table of references: each variant is the heart and the reference of its name."""

import numpy as np
import pytest

from heartfit.heart.beat import failed_beat
from heartfit.heart.finite_elements.unloading import unload
from heartfit.heart.heart import Heart
from verification import reference
from verification.reference import FROZEN, OWN, Finding, Variant, find, first_beats, reference_table
from verification.specimen import COARSE, END_DIASTOLIC_PRESSURE, specimen


def test_c_1_moves_by_its_deviations():
    up, down = (Variant("", FROZEN, z).heart().tissue.passive.c_1 for z in (2.0, -2.0))
    assert np.log(up / down) == pytest.approx(4 * 0.25)
    assert up * down == pytest.approx(Heart().tissue.passive.c_1 ** 2)


def test_a_frozen_reference_is_that_of_the_standard_heart(monkeypatch):
    hearts = []

    def unloading(mesh, tissue, pressures):
        hearts.append(tissue.passive.c_1)
        return unload(mesh, tissue, 0.0 * pressures)

    monkeypatch.setattr(reference, "unload", unloading)
    monkeypatch.setattr(reference, "simulate", lambda *_: failed_beat("not run", 0.8, 0.0, {}))
    for variant in (Variant("", FROZEN, 2.0), Variant("", OWN, 2.0)):
        with pytest.raises(ValueError, match="did the beat fail"):
            find(specimen(COARSE), END_DIASTOLIC_PRESSURE, None, (variant,))
    assert hearts == pytest.approx([6e3, 6e3 * np.exp(0.5)])


def test_the_table_has_a_row_per_finding():
    row = {"own": Finding({"lv": 1.02, "rv": 0.98}, {"V_min": 40e-6, "q_max": 400e-6, "q_min": -500e-6})}
    assert reference_table(row).to_numpy().tolist() == [["own", "+2.0 % / -2.0 %", "40", "400", "-500"]]


def test_every_own_reference_configuration_fills_to_the_measured_volumes():
    """Both cavities are filled to the measured volumes for every c_1; the paper's reference overfills both."""
    beats = first_beats()
    for name in ("own", "own, c_1 up", "own, c_1 down"):
        assert list(beats[name].filled.values()) == pytest.approx([1.0, 1.0], abs=0.05)
    assert min(beats["end-diastolic mesh"].filled.values()) > 1.1
