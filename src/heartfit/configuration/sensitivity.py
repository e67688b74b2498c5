"""How it is found which parameters the observations see."""

from pydantic import Field, PositiveFloat, field_validator

from heartfit.calibration.unscented import Scaling
from heartfit.configuration.fields import Seed
from heartfit.configuration.strict import Strict
from heartfit.heart import FOURTEEN
from heartfit.sensitivity.covariance import surrounding


class SphereStudy(Strict):
    """Sobol's indices of the same subject as a sphere."""

    samples: int = Field(default=256, ge=16, le=1 << 16, description="base samples, a power of two")
    seed: Seed = 0
    heart: dict[str, PositiveFloat] = Field(default={}, description="prior means that differ, for a sphere")

    @field_validator("samples")
    @classmethod
    def _is_a_power_of_two(cls, samples: int) -> int:
        if samples & (samples - 1):
            raise ValueError(
                f"{samples} base samples; expected a power of two, or Sobol's sequence loses its balance"
            )
        return samples


class SensitivityStudy(Strict):
    """The beats about the prior's mean of one case, one parameter after the other."""

    case: str = Field(description="the volunteer on whom it is tried")
    parameters: tuple[str, ...] = Field(default=FOURTEEN, min_length=7)
    step: float = Field(default=1.0, gt=0, le=3, description="standard deviations of the prior")
    cap: float = Field(
        default=1.75, gt=1, le=10, description="largest factor by which a plausible parameter changes"
    )
    sphere: SphereStudy = SphereStudy()

    def scaling(self) -> Scaling:
        """Of the transform that draws the points."""
        return surrounding(len(self.parameters), self.step)
