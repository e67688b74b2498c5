"""Beats of spherical hearts, and the recordings that images and a catheter would make of them."""

from collections.abc import Sequence

import numpy as np

from heartfit.core.errors import InputError
from heartfit.discovery.sphere_model.nominal_heart import NominalHeart
from heartfit.discovery.sphere_model.recording import KNOWN_CURVES, Recording
from heartfit.heart.beat import Beat
from heartfit.heart.heart import Heart
from heartfit.heart.simulation import Numerics
from heartfit.heart.sphere.body import Sphere
from heartfit.heart.sphere.simulation import simulate_spheres
from heartfit.observation.beat import beat_curves
from heartfit.roles import Sensor
from heartfit.synthetic.hidden import PRESSURE_NOISE, RecordingProtocol, record_pressure, record_volume

LIMIT_CYCLE = Numerics(max_beats=30, drift=1e-5)
"""Steps of 5 ms, and beats until the next one differs from the last by 1e-5 of its stroke."""


def simulate(
    heart: NominalHeart | Heart,
    spheres: Sphere | Sequence[Sphere] | None = None,
    numerics: Numerics | None = None,
) -> Beat:
    """Simulate the beat of a heart on its limit cycle.

    heart: that of :func:`heartfit.discovery.sphere_model.nominal_heart.adult`, which has its ventricles, or a ``Heart``
    with its left ventricle, or both, as ``spheres``. numerics: steps of 5 ms and at most 30 beats if None. A simulation
    that fails is a beat with the ``status`` "failed" and a ``reason``. Raises InputError for a ``Heart`` without
    spheres, and for two definitions of the ventricles. Ventricles on tetrahedra:
    :func:`heartfit.personalise.run.run_beat`.
    """
    numerics = numerics or LIMIT_CYCLE
    if isinstance(heart, NominalHeart):
        if spheres is not None:
            raise InputError(
                "simulate: the heart has ventricles, and spheres define them again; expected one: leave spheres out"
            )
        return heart.beat(numerics)
    if spheres is None:
        raise InputError(
            "simulate: this Heart has no ventricles; expected spheres such as Sphere.from_volumes(cavity=1.2e-4, "
            "wall=1.2e-4), or the heart of adult(), which has them: add them"
        )
    return simulate_spheres(heart, spheres, numerics)


def measure(
    beat: Beat,
    curves: Sequence[str] = ("lv_volume", "lv_pressure"),
    *,
    sensors: Sequence[Sensor] = (),
    frames: int = 25,
    volume_noise: float = 0.02,
    pressure_noise: float = PRESSURE_NOISE,
    seed: int = 0,
) -> Recording:
    """Measure a simulated beat as cine MRI and a catheter would, time zero at the R wave.

    curves: names among "lv_volume", "rv_volume", "lv_pressure", "rv_pressure" and "aorta_pressure". volume_noise:
    standard deviation of a frame over the largest volume, neighbours correlated by 0.6. pressure_noise: of a sample
    [Pa], of which ten at 1 kHz are averaged. Both curves also have the smooth error of 0.6 mL and 150 Pa that no model
    explains. sensors: instruments among the mechanisms of the heart. Raises InputError for a failed beat, and for a
    curve that a recording does not know or the beat does not have.
    """
    if not beat.completed:
        raise InputError(f"measure: the beat failed ({beat.reason}); expected one that was completed")
    true, rng = beat_curves(beat, sensors), np.random.default_rng(seed)
    for name in curves:
        if name not in KNOWN_CURVES or name not in true:
            present = ", ".join(known for known in KNOWN_CURVES if known in true)
            raise InputError(f"measure: no curve {name}; expected some of {present}: correct the name")
    protocol = RecordingProtocol(frames, volume_noise)
    return Recording.from_curves(
        {
            name: record_volume(true[name], protocol, rng)
            if name.endswith("_volume")
            else record_pressure(true[name], rng, pressure_noise / PRESSURE_NOISE)
            for name in curves
        }
    )
