r"""Hidden spherical hearts that carry a planted effect, and the measurement of their beats.

The hidden heart is a sphere that differs from the diagnoser's model, as a patient's heart differs from any model: it
has first-order time steps of 1 ms and orifice valves. Inertances, wall mass and length dependence are part of the
diagnoser's model too, with other values; the diagnoser estimates inertances, length dependence and spread of the
activation, and holds mass and volume of the wall. Parameters that the diagnoser may fit are drawn from the priors,

.. math:: \theta = \bar\theta\, e^{s z}, \qquad \theta = \bar\theta + s z \text{ for times}, \qquad z \sim N(0, 1).

Size and heart rate scatter besides: at equal pressures, flows and volumes are proportional to the size, and the
duration of the action potential to the root of the period (Bazett 1920).

The measurement consists of frames of the volume and a catheter's pressure, with errors unknown to the diagnoser:

.. math:: V'_i = V(t_i) + r_V(t_i) + \epsilon_i, \quad \epsilon_i = a\,\epsilon_{i-1} + \sqrt{1 - a^2}\, s\, z_i, \qquad
          P'_j = \overline{P} + r_P(t_j) + \overline{\epsilon},

where the bar is the mean over 10 ms of samples at 1 kHz, and the smooth, periodic Gaussian process r is the discrepancy
that no model explains.
"""

from collections import defaultdict
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace

import numpy as np

from heartfit.core.arrays import Floats
from heartfit.heart.beat import Beat
from heartfit.heart.heart import Heart
from heartfit.heart.simulation import Numerics
from heartfit.heart.sphere.body import HEALTHY_ACTIVATION, Sphere
from heartfit.heart.sphere.heart import Inertia
from heartfit.heart.sphere.simulation import simulate_spheres
from heartfit.observation.beat import beat_curves
from heartfit.observation.curve import Curve
from heartfit.roles import Flow, Mechanism, Sensor
from heartfit.synthetic.out_of_library import add_effect
from heartfit.synthetic.volunteer import OTHER_MODEL, VALVES

FRAMES = (25, 30)
VOLUME_NOISE = (0.01, 0.03)
"""Range of the standard deviation of the volume over the end-diastolic volume."""
MEMORY = 0.6
"""Correlation of the errors of successive frames."""
PRESSURE_NOISE, RATE, AVERAGED = 300.0, 1000.0, 10
"""Standard deviation of a sample [Pa], sampling rate [Hz], samples per average."""
VOLUME_ROUGHNESS, PRESSURE_ROUGHNESS, ROUGHNESS_LENGTH = 0.6e-6, 150.0, 0.05
"""Standard deviations [m^3], [Pa] and correlation time [s] of the model discrepancy."""


@dataclass(frozen=True)
class RecordingProtocol:
    """Number of frames, and noise of the volume over the end-diastolic volume.

    memory: correlation of the errors of successive frames; catheter: noise of a catheter's sample over PRESSURE_NOISE.
    """

    frames: int
    noise: float
    memory: float = MEMORY
    catheter: float = 1.0

    @classmethod
    def draw(cls, rng: np.random.Generator) -> "RecordingProtocol":
        low, high = FRAMES
        return cls(int(rng.integers(low, high + 1)), float(rng.uniform(*VOLUME_NOISE)))


def measure_beat(
    beat: Beat, sensors: tuple[Sensor, ...], protocol: RecordingProtocol, rng: np.random.Generator
) -> dict[str, Curve]:
    """Measure volume [m^3] and pressure [Pa] of the left ventricle, time zero at the trigger."""
    true: Mapping[str, Curve] = beat_curves(beat, sensors)
    return {
        "lv_volume": record_volume(true["lv_volume"], protocol, rng),
        "lv_pressure": record_pressure(true["lv_pressure"], rng, protocol.catheter),
    }


def record_volume(true: Curve, protocol: RecordingProtocol, rng: np.random.Generator) -> Curve:
    """Record frames of the volume, with correlated errors and discrepancy."""
    frames = true.resampled(protocol.frames)
    errors = autoregressive_error(protocol.frames, protocol.memory, rng)
    error = protocol.noise * float(true.values.max()) * errors
    discrepancy = VOLUME_ROUGHNESS * smooth_process(frames.times, true.period, ROUGHNESS_LENGTH, rng)
    return Curve(frames.times, frames.values + discrepancy + error, true.period)


def record_pressure(
    true: Curve, rng: np.random.Generator, noise: float = 1.0, roughness: float = 1.0
) -> Curve:
    """Record with a catheter: averages over 10 ms, with discrepancy and noise.

    noise: of a sample over PRESSURE_NOISE; roughness: of the discrepancy over PRESSURE_ROUGHNESS.
    """
    count = int(true.period * RATE) // AVERAGED
    times = np.arange(count * AVERAGED) / RATE
    samples = true(times) + noise * PRESSURE_NOISE * rng.standard_normal(len(times))
    middles, means = (array.reshape(count, AVERAGED).mean(axis=1) for array in (times, samples))
    discrepancy = roughness * PRESSURE_ROUGHNESS * smooth_process(middles, true.period, ROUGHNESS_LENGTH, rng)
    return Curve(middles, means + discrepancy, true.period)


def autoregressive_error(count: int, memory: float, rng: np.random.Generator) -> Floats:
    """Draw a stationary sequence (count,) of variance 1 whose neighbours have the correlation ``memory``."""
    error = rng.standard_normal(count)
    for i in range(1, count):
        error[i] = memory * error[i - 1] + np.sqrt(1.0 - memory**2) * error[i]
    return error


def smooth_process(times: Floats, period: float, length: float, rng: np.random.Generator) -> Floats:
    r"""Draw a periodic Gaussian process at ``times`` (t,), of variance 1 and nearly squared-exponential correlation.

    .. math:: r(t) = \sum_k \sqrt{w_k}\, (a_k \cos \omega_k t + b_k \sin \omega_k t), \qquad
              w_k \propto e^{-(\omega_k \ell)^2 / 2}, \quad \omega_k = 2 \pi k / T
    """
    k = np.arange(1, 1 + int(np.ceil(period / length)))
    omega = 2.0 * np.pi * k / period
    weight = np.exp(-0.5 * (omega * length) ** 2)
    a, b = np.sqrt(weight / weight.sum()) * rng.standard_normal((2, len(k)))
    angle = omega * times[:, None]
    return np.cos(angle) @ a + np.sin(angle) @ b


NUMERICS = Numerics(time_step=1e-3, second_order=False, max_beats=20, drift=1e-3)

NOMINAL = {"sigma_0": 190e3, "R_p": 1.15e8, "circulation.left_atrium": 900.0, "slope": OTHER_MODEL["slope"]}
"""Nominal values that differ from the declared ones, SI: every fibre of a sphere lies in the plane of its wall."""
CAVITY, WALL = 1.2e-4, 1.2e-4
"""Volumes of the stress-free cavity and of the wall [m^3]."""
RIGHT_CAVITY, RIGHT_WALL = 1.2, 0.35
"""Cavity and wall volume of the right ventricle over those of the left one."""

RELATIVE = {
    "sigma_0": 0.20, "mu": 0.30, "c_1": 0.30, "R_p": 0.20, "k_RS": 0.20, "k_ATP": 0.20, "tau": 0.20, "Z_c": 0.20,
    "L": 0.30, "k_0": 0.30, "alpha": 0.30, "eta": 0.30, "circulation.left_atrium": 0.15, "slope": 0.25,
}  # fmt: skip
"""Standard deviations of the logarithms of the parameters."""
TIMES = {"onset": 8e-3, "duration": 15e-3, "trigger_delay": 5e-3}
"""Standard deviations of times [s]."""
FILLED, RESISTANCE = 0.15, 0.25
"""Standard deviations of the logarithms of stress-free cavity and mitral resistance, proportional to 1 / area^2."""

SIZE, PERIOD = 0.15, (0.86, 0.06)
"""Standard deviation of the logarithm of the heart's size; mean and standard deviation of the period [s]."""
AREA, INERTANCE, MASS, SPREAD, AMOUNT = 0.08, 0.40, 0.08, 0.20, 0.05
"""Standard deviations of the logarithms of valve areas, inertances, density, spread of the activation, wall volume."""
DENSITY = 1060.0
"""Density of the wall [kg/m^3]."""
INERTANCES = {"mitral": 3e4, "aortic": 4e4}
"""Inertances [Pa s^2/m^3] of a blood column of about 15 mm length in each valve."""
WALL_AMOUNT = "wall"
"""Name of density and volume of the wall where their centres are shifted as one."""
TRUNCATION = 2.5
"""Truncation of a draw [standard deviations]."""


@dataclass(frozen=True, eq=False)
class HiddenHeart:
    """Heart, its left ventricle, activation times (k,) [s], inertia, and the standard deviates of its parameters."""

    heart: Heart
    sphere: Sphere
    activation: Floats
    inertia: Inertia
    deviates: Mapping[str, float]

    def with_effects(self, effects: Iterable[Mechanism]) -> "HiddenHeart":
        """Return the same heart with these mechanisms."""
        heart = self.heart
        for effect in effects:
            heart = add_effect(heart, effect)
        return replace(self, heart=heart)

    def with_preload(self, factor: float) -> "HiddenHeart":
        """Return the same heart with the resting pressure of the left atrium multiplied by ``factor``."""
        pressure = factor * self.heart.circulation.left_atrium
        return replace(self, heart=self.heart.with_parameters({"circulation.left_atrium": pressure}))

    def beat(self) -> Beat:
        """Simulate the beat on the limit cycle, with a right ventricle if a leak leads to it."""
        leaks = [m for m in self.heart.mechanisms if isinstance(m, Flow)]
        right = any("rv" in (leak.upstream, leak.downstream) for leak in leaks)
        spheres = [self.sphere, _right_ventricle(self.sphere)] if right else [self.sphere]
        return simulate_spheres(self.heart, spheres, NUMERICS, self.activation, self.inertia)


def draw_hidden(rng: np.random.Generator, centres: Mapping[str, float] | None = None) -> HiddenHeart:
    """Draw a heart without any planted effect.

    centres: shifts of the centres of parameters, of the valves "mitral inertance" and "aortic inertance", and of
    "wall", its density and its volume [standard deviations].
    """
    normal, shift = Normal(rng), defaultdict(float, centres or {})
    deviates = {name: normal() + shift[name] for name in (*RELATIVE, *TIMES, "cavity", "mitral resistance")}
    size, period = normal.factor(SIZE), PERIOD[0] + PERIOD[1] * normal()
    heart = scatter_parameters(_average_heart(size, period), deviates, normal)
    cavity = size * CAVITY * np.exp(FILLED * deviates["cavity"])
    sphere = Sphere.from_volumes(cavity, size * WALL * normal.factor(AMOUNT, shift[WALL_AMOUNT]))
    inertances = tuple(
        (name, inertance / size * normal.factor(INERTANCE, shift[f"{name} inertance"]))
        for name, inertance in INERTANCES.items()
    )
    inertia = Inertia(DENSITY * normal.factor(MASS, shift[WALL_AMOUNT]), inertances)
    return HiddenHeart(heart, sphere, HEALTHY_ACTIVATION * normal.factor(SPREAD), inertia, deviates)


class Normal:
    """Source of standard normal numbers, truncated at 2.5 standard deviations."""

    def __init__(self, rng: np.random.Generator) -> None:
        self._rng = rng

    def __call__(self) -> float:
        return float(np.clip(self._rng.standard_normal(), -TRUNCATION, TRUNCATION))

    def factor(self, sd: float, centre: float = 0.0) -> float:
        """Draw a log-normal factor whose median lies ``centre`` standard deviations from 1."""
        return float(np.exp(sd * (self() + centre)))


def _average_heart(size: float, period: float) -> Heart:
    """Return the nominal heart of this size and period [s]."""
    heart = Heart(circulation=VALVES, period=period).with_parameters(NOMINAL)
    smaller = dict.fromkeys((f"circulation.systemic.{name}" for name in ("R_p", "Z_c", "L")), 1.0 / size)
    larger = dict.fromkeys(
        (f"circulation.{name}" for name in ("mitral.area", "aortic.area", "first_stroke")), size
    )
    return _scale_parameters(
        heart, smaller | larger | {"tissue.control.duration": np.sqrt(period / PERIOD[0])}
    )


def scatter_parameters(heart: Heart, deviates: Mapping[str, float], normal: Normal) -> Heart:
    """Return the heart with its parameters at these standard deviates, and with scattered valve areas."""
    heart = _scale_parameters(heart, {name: np.exp(sd * deviates[name]) for name, sd in RELATIVE.items()})
    values = heart.parameters()
    times = {name: values[heart.parameter_path(name)] + sd * deviates[name] for name, sd in TIMES.items()}
    mitral = normal.factor(AREA) * np.exp(-0.5 * RESISTANCE * deviates["mitral resistance"])
    areas = {"circulation.mitral.area": mitral, "circulation.aortic.area": normal.factor(AREA)}
    return _scale_parameters(heart.with_parameters(times), areas)


def _scale_parameters(heart: Heart, factors: Mapping[str, float]) -> Heart:
    values = heart.parameters()
    return heart.with_parameters(
        {name: values[heart.parameter_path(name)] * factor for name, factor in factors.items()}
    )


def _right_ventricle(left: Sphere) -> Sphere:
    inner = left.radius - 0.5 * left.thickness
    return Sphere.from_volumes(RIGHT_CAVITY * 4.0 / 3.0 * np.pi * inner**3, RIGHT_WALL * left.wall)
