"""Add a mechanism of one's own to a heart: a left atrial pressure that a tachycardia lowers."""

from dataclasses import dataclass

import heartfit as hf


@hf.mechanism
@dataclass(frozen=True)
class RateLoss(hf.Pressure):
    """Loss of left atrial pressure in proportion to the heart rate above 40 beats a minute."""

    compartments = ("left_atrium",)
    loss: float = hf.parameter(
        300.0, unit="Pa", symbol="a", meaning="loss at 70 beats a minute", off=0.0, scale=750.0
    )

    def pressure(self, compartment, time, period):
        return -self.loss * (1.0 / period - 40.0 / 60.0) / 0.5 + 0.0 * time


heart = hf.adult()
for h in (heart, heart + RateLoss(), heart + RateLoss(loss=600.0)):
    beat = hf.simulate(h)
    print(f"filled to {1e6 * beat.volume['lv'].max():.0f} mL, {1e-3 * beat.pressure['lv'].max():.1f} kPa")
