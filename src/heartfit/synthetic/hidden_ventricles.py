r"""Hidden hearts of two spheres in a closed circulation, and the measurement of their beats.

The left side is that of :mod:`heartfit.synthetic.hidden`. The right one scatters about a human heart, as the left one
does, and its size is the one at which both sides pump the same volume,

.. math:: \int (q_{mitral} - q_{leak}) \, dt = \int q_{pulmonary} \, dt ,

as blood that the left side pumps returns to the right one. An effect changes this size, as in a chronic disease: with a
leaking pulmonary or tricuspid valve the right ventricle is wider. Images show its volume with a gain of its own.
"""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace

import numpy as np

from heartfit.heart.beat import Beat
from heartfit.heart.sphere.body import Sphere
from heartfit.heart.sphere.simulation import simulate_spheres
from heartfit.observation.beat import beat_curves
from heartfit.observation.curve import Curve
from heartfit.roles import Mechanism
from heartfit.roles.sides import right_excess
from heartfit.synthetic.balance import balancing_value
from heartfit.synthetic.campaign import Inadmissible
from heartfit.synthetic.hidden import (
    NUMERICS,
    WALL,
    HiddenHeart,
    Normal,
    RecordingProtocol,
    draw_hidden,
    measure_beat,
    record_pressure,
    record_volume,
)

RIGHT_CAVITY, RIGHT_WALL = 1.3e-4, 4e-5
"""Volumes of the stress-free cavity and of the free wall of the right ventricle in a heart of the middle size [m^3]."""
RIGHT = {
    "tissue.right.contractility": 0.7,
    "circulation.pulmonary_tree.R_p": 8e6,
    "circulation.right_atrium": 500.0,
}
RIGHT_SPREADS = {
    "tissue.right.contractility": 0.20,
    "tissue.right.stiffness": 0.25,
    "circulation.pulmonary_tree.R_p": 0.25,
    "circulation.pulmonary_tree.tau": 0.20,
    "circulation.pulmonary_tree.Z_c": 0.25,
    "circulation.right_atrium": 0.25,
    "circulation.tricuspid.area": 0.08,
    "circulation.pulmonary.area": 0.08,
}
"""Standard deviations of the logarithms of parameters of the right side."""
WALL_SPREAD, GAIN, NOISE = 0.10, 0.07, 1.3
"""Standard deviations of the logarithms of the wall and of the gain of the right volume; its noise over the left's."""
RIGHT_ROUGHNESS = 0.3
"""Model discrepancy of the right pressure over that of the left one."""
DELAY = (0.020, 0.005)
"""Mean and standard deviation of the delay of the right wall [s]."""
SIZE_RATIO, SIZE_TOLERANCE = 1.3, 1e-4
"""Ratio of sizes between which the balance is sought, and the tolerance of the size, 0.01 mL."""


@dataclass(frozen=True, eq=False)
class HiddenVentricles:
    """A hidden heart with its right ventricle before its size is known.

    cavity, wall: of the right ventricle at size 1 [m^3]; gain: of its images.
    """

    left: HiddenHeart
    cavity: float
    wall: float
    gain: float

    def with_effects(self, effects: Iterable[Mechanism]) -> "HiddenVentricles":
        """Return the same heart with these mechanisms."""
        return replace(self, left=self.left.with_effects(effects))

    def beat(self) -> Beat:
        """Simulate the beat at which both sides pump the same volume; raises Inadmissible where there is none."""
        return self._beat(balancing_value(self._excess, 1.0, SIZE_RATIO, SIZE_TOLERANCE))

    def _excess(self, size: float) -> float:
        """Volume that the right side pumps beyond the left one [m^3], its ventricle ``size`` times as large."""
        beat = self._beat(size)
        if not beat.completed:
            raise Inadmissible("the ventricles do not beat")
        return right_excess(beat.flow, self.left.heart.mechanisms) * beat.period

    def _beat(self, size: float) -> Beat:
        right = Sphere.from_volumes(size * self.cavity, size * self.wall)
        left = self.left
        return simulate_spheres(left.heart, [left.sphere, right], NUMERICS, left.activation, left.inertia)

    def measure(
        self, protocol: RecordingProtocol, rng: np.random.Generator, right_catheter: bool = False
    ) -> dict[str, Curve]:
        """Measure both volumes [m^3] and the left pressure [Pa] of its beat, time zero at the trigger.

        right_catheter: measure the right pressure, too.
        """
        beat, sensors = self.beat(), self.left.heart.sensors
        curves: Mapping[str, Curve] = beat_curves(beat, sensors)
        right = curves["rv_volume"]
        shown = Curve(right.times, self.gain * right.values, right.period)
        worse = replace(protocol, noise=NOISE * protocol.noise)
        measured = {
            **measure_beat(beat, sensors, protocol, rng),
            "rv_volume": record_volume(shown, worse, rng),
        }
        if right_catheter:
            pressure = curves["rv_pressure"]
            measured["rv_pressure"] = record_pressure(pressure, rng, protocol.catheter, RIGHT_ROUGHNESS)
        return measured


def draw_ventricles(rng: np.random.Generator) -> HiddenVentricles:
    """Draw a heart of both ventricles without any planted effect."""
    left, normal = draw_hidden(rng), Normal(rng)
    size = left.sphere.wall / WALL
    values = left.heart.with_parameters(RIGHT).parameters()
    scale = {f"circulation.pulmonary_tree.{name}": 1.0 / size for name in ("R_p", "Z_c", "L")}
    scale |= {f"circulation.{valve}.area": size for valve in ("tricuspid", "pulmonary")}
    drawn = {path: values[path] * scale.get(path, 1.0) for path in scale | RIGHT_SPREADS | RIGHT}
    drawn |= {path: drawn[path] * normal.factor(spread) for path, spread in RIGHT_SPREADS.items()}
    drawn["tissue.right.delay"] = DELAY[0] + DELAY[1] * normal()
    wall = size * RIGHT_WALL * normal.factor(WALL_SPREAD)
    heart = left.heart.with_parameters(drawn)
    return HiddenVentricles(replace(left, heart=heart), size * RIGHT_CAVITY, wall, normal.factor(GAIN))
