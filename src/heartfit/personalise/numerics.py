"""Numerical settings: meshes, time steps, filling pressures, observation and transform."""

from collections.abc import Collection, Mapping
from dataclasses import dataclass
from typing import Annotated, Self

from pydantic import Field, PositiveFloat, model_validator

from heartfit.calibration.unscented import Scaling
from heartfit.core.validation import Strict
from heartfit.heart.simulation import Numerics
from heartfit.observation.curve import Curve
from heartfit.observation.operator import (
    CurveFeatures,
    PressureFeatures,
    RightVolumeFeatures,
    VolumeFeatures,
    operators,
)


@dataclass(frozen=True)
class Protocol:
    """Numerics of the beat; pressures (lv, rv) at end diastole, Pa."""

    numerics: Numerics
    end_diastolic_pressure: tuple[float, float]


class MeshSize(Strict):
    """Target edge length, and largest distance of the boundary from the measured surface."""

    edge_length: float = Field(gt=1e-3, lt=0.05, description="m")
    tolerance: float = Field(gt=1e-5, lt=5e-3, description="m")


class TimeScheme(Strict):
    """Time step, and criterion of periodic beats."""

    time_step: float = Field(gt=1e-5, le=0.02, description="s")
    second_order: bool = Field(True, description="BDF2 and midpoints of the fibres, or backward Euler")
    max_beats: int = Field(ge=1, le=1000)
    drift: float = Field(gt=0, lt=1, description="largest relative change from beat to beat")

    def numerics(self) -> Numerics:
        """Return the numerics of a simulation."""
        return Numerics(**self.model_dump())


class Pressures(Strict):
    """End-diastolic pressures of the ventricles, which load the measured mesh."""

    lv: float = Field(ge=0, lt=5e3, description="Pa")
    rv: float = Field(ge=0, lt=5e3, description="Pa")


class Generator(Strict):
    """Mesh and time scheme of generated hearts."""

    mesh: MeshSize
    numerics: TimeScheme

    def protocol(self, pressures: Pressures) -> Protocol:
        """Return the protocol of a generated heart."""
        return Protocol(self.numerics.numerics(), (pressures.lv, pressures.rv))


class Operator(Strict):
    """Observation of volume curves; see heartfit.observation.operator."""

    frames: int = Field(ge=8, le=1000)
    window: int = Field(ge=3, description="frames of the smoothing filter, odd")
    order: int = Field(ge=1)
    period_uncertainty: float = Field(ge=0, lt=0.5, description="relative standard deviation")

    @model_validator(mode="after")
    def _can_be_applied(self) -> Self:
        self.trial_features(self.frames)
        return self

    def features(self, measured: Mapping[str, Curve], also: Collection[str] = ()) -> dict[str, CurveFeatures]:
        """Return the operator of each observed curve: LV volume, its pressure if measured, and those of ``also``."""
        return operators(measured, self.frames, self.window, self.order, also)

    def trial_features(self, frames: int) -> dict[str, CurveFeatures]:
        """Return the operators of a synthetic measurement with this number of image frames."""
        return {
            "lv_volume": VolumeFeatures(frames, self.window, self.order),
            "lv_pressure": PressureFeatures(),
        }

    def right_features(self, frames: int) -> dict[str, CurveFeatures]:
        """Return the operator of a synthetic right ventricular volume with this number of image frames."""
        return {"rv_volume": RightVolumeFeatures(frames, self.window, self.order)}


class Transform(Strict):
    """Parameters of the unscented transform, and whether bias and noise of the observations are used (R > 0)."""

    a: PositiveFloat = 1.0
    b: float = 2.0
    kappa: float = 0.0
    noise: bool = False
    fixed_sd: Annotated[
        float, Field(ge=0, lt=1, description="relative, of parameters that are not estimated")
    ] = 0.1

    def with_noise(self) -> "Transform":
        """Return the same transform with the noise of the observations."""
        return self.model_copy(update={"noise": True})

    def scaling(self) -> Scaling:
        """Return the scaling of the sigma points."""
        return Scaling(self.a, self.b, self.kappa)
