"""Spheres of known truth, on which methods are compared and intervals counted."""

from collections.abc import Mapping
from typing import TYPE_CHECKING, Self

from pydantic import Field, PositiveFloat, model_validator

from heartfit.configuration.fields import MOST, Count, Seed
from heartfit.configuration.numerics import TimeScheme
from heartfit.configuration.setting import Prior, Setting
from heartfit.configuration.strict import Strict
from heartfit.observation.operator import CurveFeatures, PressureFeatures, VolumeFeatures

if TYPE_CHECKING:
    from heartfit.twins.draw import Twins


class SphereStudy(Strict):
    """How many hearts, of which shape, how well measured, and what is estimated of them."""

    hearts: Count = Field(description="on which methods are compared")
    covered: Count = Field(description="whose intervals are counted")
    seed: Seed
    simulations: int = Field(ge=30, le=MOST, description="most that a method may take on a heart")
    steps: Count = Field(description="most repetitions of the unscented step")
    period: float = Field(gt=0.3, lt=2.0, description="s")
    cavity: float = Field(gt=5e-5, lt=4e-4, description="m^3, at end diastole")
    wall: float = Field(gt=2e-5, lt=4e-4, description="m^3")
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

    def twins(
        self,
        prior: Mapping[str, Prior],
        features: Mapping[str, CurveFeatures],
        pressure: float,
    ) -> "Twins":
        """How hearts are drawn and seen by these features, under this end-diastolic pressure, Pa."""
        from heartfit.twins.draw import Twins  # spheres need a root finder, which no other job does
        from heartfit.twins.model import SphericalModel

        seen = self.setting.seeing_pressure() if "lv_pressure" in features else self.setting
        setting = seen.with_prior(prior)
        model = SphericalModel(
            setting.base_heart(self.period),
            self.cavity,
            self.wall,
            pressure,
            features,
            self.numerics.numerics(),
        )
        names = [name for operator in features.values() for name in operator.names]
        noise = {name: self.noise[name] for name in names}
        return Twins(model, setting.gaussian(), noise, self.seed)
