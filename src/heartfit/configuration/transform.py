"""How curves are observed, and the numbers of the unscented transform."""

from collections.abc import Mapping
from typing import Annotated, Self

from pydantic import Field, PositiveFloat, model_validator

from heartfit.calibration.unscented import Scaling
from heartfit.configuration.strict import Strict
from heartfit.observation.curve import Curve
from heartfit.observation.operator import CurveFeatures, PressureFeatures, VolumeFeatures
from heartfit.observation.vector import operators


class Operator(Strict):
    """How volume curves are observed; see heartfit.observation.operator."""

    frames: int = Field(ge=8, le=1000)
    window: int = Field(ge=3, description="frames of the smoothing filter, odd")
    order: int = Field(ge=1)
    period_uncertainty: float = Field(ge=0, lt=0.5, description="relative standard deviation")

    @model_validator(mode="after")
    def _can_be_applied(self) -> Self:
        self.trial_features(self.frames)
        return self

    def features(self, measured: Mapping[str, Curve]) -> dict[str, CurveFeatures]:
        """The operator of each curve that is observed: the LV's volume, and its pressure where measured."""
        return operators(measured, self.frames, self.window, self.order)

    def trial_features(self, frames: int) -> dict[str, CurveFeatures]:
        """The operators of a trial of the measurement, whose images have this number of frames."""
        return {
            "lv_volume": VolumeFeatures(frames, self.window, self.order),
            "lv_pressure": PressureFeatures(),
        }


class Transform(Strict):
    """The numbers of the unscented transform, and whether bias and noise of the observations are used (R > 0)."""

    a: PositiveFloat = 1.0
    b: float = 2.0
    kappa: float = 0.0
    noise: bool = False
    fixed_sd: Annotated[float, Field(ge=0, lt=1, description="relative, of what is not estimated")] = 0.1

    def weighed(self) -> "Transform":
        """The same with the noise of the observations, whatever this one says."""
        return self.model_copy(update={"noise": True})

    def scaling(self) -> Scaling:
        """As the calibration takes it."""
        return Scaling(self.a, self.b, self.kappa)
