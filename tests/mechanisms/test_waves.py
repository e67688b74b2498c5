"""Effects of prescribed waves, loads and narrowings on a beat: the signs that a cardiologist expects."""

from dataclasses import dataclass, replace

import numpy as np
import pytest

from heartfit.heart.beat import Beat
from heartfit.heart.heart import Heart
from heartfit.heart.sphere.body import Sphere
from heartfit.heart.sphere.simulation import simulate_spheres
from heartfit.mechanisms.aortic_regurgitation import AorticRegurgitation
from heartfit.mechanisms.aortic_stenosis import AorticStenosis
from heartfit.mechanisms.arterial_reflection import ArterialReflection
from heartfit.mechanisms.atrial_surge import AtrialSurge
from heartfit.mechanisms.base_descent import BaseDescent
from heartfit.mechanisms.mitral_stenosis import MitralStenosis
from heartfit.mechanisms.pericardium import Pericardium
from heartfit.mechanisms.septal_load import SeptalLoad
from heartfit.roles import Mechanism


@dataclass(frozen=True)
class Indices:
    """Left ventricular indices of a beat [mL, kPa]; the aortic valve is open in systole."""

    beat: Beat

    @property
    def volume(self) -> np.ndarray:
        return self.beat.volume["lv"] * 1e6

    @property
    def pressure(self) -> np.ndarray:
        return self.beat.pressure["lv"] * 1e-3

    @property
    def systole(self) -> np.ndarray:
        return self.beat.flow["aortic"] > 2e-5

    @property
    def gradient(self) -> np.ndarray:
        """Pressure drop across the open aortic valve."""
        drop: np.ndarray = (self.beat.pressure["lv"] - self.beat.pressure["aorta"])[self.systole]
        return drop * 1e-3

    @property
    def pulse(self) -> float:
        """Pulse pressure of the aorta over its greatest."""
        return float(1.0 - self.beat.pressure["aorta"].min() / self.beat.pressure["aorta"].max())


@pytest.fixture(scope="module")
def human() -> Heart:
    return Heart().with_parameters({"sigma_0": 180e3, "circulation.left_atrium": 1000.0, "R_p": 1.2e8})


def beat(heart: Heart, *mechanisms: Mechanism) -> Indices:
    result = simulate_spheres(
        replace(heart, mechanisms=(*heart.mechanisms, *mechanisms)), [Sphere.from_volumes(125e-6, 170e-6)]
    )
    assert result.completed, result.reason
    return Indices(result)


def test_a_stenotic_valve_has_the_stated_gradient(human: Heart) -> None:
    """Compared with the healthy valve; the peak of the flow is lower and later."""
    healthy, tight = beat(human), beat(human, AorticStenosis(gradient=8e3))
    q = tight.beat.flow["aortic"][tight.systole]
    conductance = human.circulation.aortic.law().conductance
    assert tight.gradient * 1e3 == pytest.approx(
        8e3 * (q / AorticStenosis.reference_flow) ** 2 + q / conductance, rel=1e-6
    )
    assert tight.pressure.max() > 1.2 * healthy.pressure.max()
    assert tight.beat.flow["aortic"].max() < 0.8 * healthy.beat.flow["aortic"].max()
    assert tight.beat.flow["aortic"].argmax() > healthy.beat.flow["aortic"].argmax()
    assert tight.volume.min() > healthy.volume.min()


def test_a_tight_mitral_valve_hinders_filling(human: Heart) -> None:
    healthy, tight = beat(human), beat(human, MitralStenosis(gradient=500.0))
    assert tight.volume.max() < healthy.volume.max()
    assert tight.beat.flow["mitral"].max() < 0.85 * healthy.beat.flow["mitral"].max()


def test_a_leaking_aortic_valve_widens_the_pulse_and_fills_before_the_mitral_valve_opens(
    human: Heart,
) -> None:
    healthy, leaking = beat(human), beat(human, AorticRegurgitation(area=0.16e-4))
    assert leaking.pulse > 1.3 * healthy.pulse
    assert leaking.beat.pressure["aorta"].min() < 0.8 * healthy.beat.pressure["aorta"].min()
    closed = (leaking.beat.flow["mitral"] < 1e-6) & (leaking.beat.flow["aortic"] < 1e-6)
    assert (np.gradient(leaking.beat.volume["lv"], leaking.beat.time)[closed] > 0.0).any()


def test_a_pericardium_keeps_the_heart_small_and_its_diastole_stiff(human: Heart) -> None:
    free, held = beat(human), beat(human, Pericardium(pressure=1200.0))
    assert held.volume.max() < 0.96 * free.volume.max()
    filling = free.beat.time < 0.12
    stiffness = [np.polyfit(case.volume[filling], case.pressure[filling], 1)[0] for case in (free, held)]
    assert stiffness[1] > 1.3 * stiffness[0]


def test_a_septal_load_helps_the_left_ventricle_to_eject(human: Heart) -> None:
    free, pressed = beat(human), beat(human, SeptalLoad(pressure=2000.0))
    assert pressed.volume.min() < free.volume.min()
    assert pressed.pressure.max() > free.pressure.max()


def test_a_reflected_wave_raises_the_late_systole_of_aorta_and_ventricle(human: Heart) -> None:
    calm, wavy = beat(human), beat(human, ArterialReflection(wave=2000.0))
    late, early = (abs(calm.beat.time - time).argmin() for time in (0.42, 0.25))
    for name in ("aorta", "lv"):
        rise = wavy.beat.pressure[name] - calm.beat.pressure[name]
        assert rise[late] > 700.0
        assert abs(rise[early]) < 200.0
    assert wavy.volume.min() > calm.volume.min()


def test_the_v_wave_speeds_early_filling(human: Heart) -> None:
    still, moving = beat(human), beat(human, BaseDescent(swing=1000.0))
    assert moving.beat.flow["mitral"].max() > still.beat.flow["mitral"].max()
    assert np.ptp(moving.beat.pressure["left_atrium"][41:120]) == pytest.approx(2000.0, rel=0.02)


@pytest.mark.parametrize("rise", [1200.0, -1200.0])
def test_an_atrial_surge_fills_more_or_less_before_the_contraction(human: Heart, rise: float) -> None:
    plain, surged = beat(human), beat(human, AtrialSurge(rise=rise))
    assert np.sign(surged.volume.max() - plain.volume.max()) == np.sign(rise)
    assert abs(surged.volume.max() - plain.volume.max()) > 5.0
