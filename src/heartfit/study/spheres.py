"""Configuration of studies on the sphere: sensitivities, and hearts of known truth."""

from collections.abc import Mapping
from typing import TYPE_CHECKING, Self

from pydantic import Field, PositiveFloat, field_validator, model_validator

from heartfit.calibration.sensitivity import one_at_a_time_scaling
from heartfit.calibration.unscented import Scaling
from heartfit.core.validation import LARGEST_COUNT, Count, Seed, Strict
from heartfit.heart.heart import PAPER_PARAMETERS
from heartfit.observation.operator import CurveFeatures, PressureFeatures, VolumeFeatures
from heartfit.personalise.numerics import TimeScheme
from heartfit.personalise.setting import Prior, Setting


class SphereSensitivity(Strict):
    """Sobol indices of the same subject as a sphere."""

    samples: int = Field(default=256, ge=16, le=1 << 16, description="number of base samples, a power of two")
    seed: Seed = 0
    heart: dict[str, PositiveFloat] = Field(
        default={}, description="prior means of a sphere that differ from the study's"
    )

    @field_validator("samples")
    @classmethod
    def _is_a_power_of_two(cls, samples: int) -> int:
        if samples & (samples - 1):
            raise ValueError(
                f"{samples} base samples; expected a power of two, which keeps the Sobol sequence balanced"
            )
        return samples


class SensitivityStudy(Strict):
    """One-at-a-time perturbations of the parameters of one case around the prior's mean."""

    case: str = Field(description="volunteer whose parameters are perturbed")
    parameters: tuple[str, ...] = Field(default=PAPER_PARAMETERS, min_length=7)
    step: float = Field(
        default=1.0, gt=0, le=3, description="perturbation, in standard deviations of the prior"
    )
    cap: float = Field(
        default=1.75, gt=1, le=10, description="largest factor by which a plausible parameter changes"
    )
    sphere: SphereSensitivity = SphereSensitivity()

    def scaling(self) -> Scaling:
        """Return the scaling of the transform that draws the points."""
        return one_at_a_time_scaling(len(self.parameters), self.step)


if TYPE_CHECKING:
    from heartfit.synthetic.known_hearts import KnownHeartSampler


class SphereStudy(Strict):
    """Study of spherical hearts of known truth: their number, shape, measurement noise and estimated parameters."""

    hearts: Count = Field(description="number of hearts on which methods are compared")
    covered: Count = Field(description="number of hearts whose intervals are counted for coverage")
    seed: Seed
    simulations: int = Field(ge=30, le=LARGEST_COUNT, description="most simulations of a method per heart")
    steps: Count = Field(description="most repetitions of the unscented step")
    period: float = Field(gt=0.3, lt=2.0, description="s")
    cavity: float = Field(gt=5e-5, lt=4e-4, description="m^3, cavity volume at end diastole")
    wall: float = Field(gt=2e-5, lt=4e-4, description="m^3, wall volume")
    numerics: TimeScheme
    noise: dict[str, PositiveFloat] = Field(description="relative standard deviation by observation")
    setting: Setting

    @model_validator(mode="after")
    def _noise_is_complete(self) -> Self:
        names = {*VolumeFeatures.names, *PressureFeatures.names}
        if set(self.noise) != names:
            raise ValueError(
                f"noise of {sorted(self.noise)}; expected one number for each of {sorted(names)}"
            )
        return self

    def known_hearts(
        self,
        prior: Mapping[str, Prior],
        features: Mapping[str, CurveFeatures],
        pressure: float,
    ) -> "KnownHeartSampler":
        """Return the sampler of hearts observed by these features at this end-diastolic pressure [Pa]."""
        from heartfit.synthetic.known_hearts import (
            KnownHeartSampler,  # imported here: only spheres need a root finder
            SphericalCase,
        )

        observing = self.setting.with_lv_pressure() if "lv_pressure" in features else self.setting
        setting = observing.with_prior(prior)
        model = SphericalCase(
            setting.base_heart(self.period),
            self.cavity,
            self.wall,
            pressure,
            features,
            self.numerics.numerics(),
        )
        names = [name for operator in features.values() for name in operator.names]
        noise = {name: self.noise[name] for name in names}
        return KnownHeartSampler(model, setting.gaussian(), noise, self.seed)
