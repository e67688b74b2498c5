"""The three-dimensional heart of a case, with or without an extension."""

from collections.abc import Mapping
from dataclasses import dataclass

from heartfit.beat import Beat, motion_of
from heartfit.configuration.generator import Pressures
from heartfit.configuration.numerics import TimeScheme
from heartfit.geometry.mesh import VentricularMesh
from heartfit.geometry.motion import Motion
from heartfit.observation.beat import beat_curves
from heartfit.observation.curve import Curve
from heartfit.proof.extension import Extension
from heartfit.protocol import run_beat


@dataclass(frozen=True, eq=False)
class Model:
    """Called with an extended setting and its parameters, by name and SI, it gives their beat."""

    mesh: VentricularMesh
    period: float
    pressures: Pressures
    scheme: TimeScheme

    def __call__(
        self, extension: Extension, parameters: Mapping[str, float], keep_positions: bool = False
    ) -> Beat:
        return run_beat(
            self.mesh,
            extension.setting,
            self.period,
            parameters,
            self.pressures,
            self.scheme,
            keep_positions=keep_positions,
        )


@dataclass(frozen=True, eq=False)
class Shown:
    """A completed beat as it is measured: curves by name, and the wall's motion from the trigger on."""

    curves: Mapping[str, Curve]
    motion: Motion

    @classmethod
    def of(cls, beat: Beat, extension: Extension, parameters: Mapping[str, float]) -> "Shown":
        """A beat that kept its nodes."""
        return cls(beat_curves(beat, extension.setting.sensors(parameters)), motion_of(beat))
