"""A setting: which model, what is estimated of it, and from which prior."""

from collections.abc import Mapping, Sequence
from typing import Annotated, Literal, Self

from pydantic import Field, PositiveFloat, model_validator

from heartfit.calibration.gaussian import Gaussian
from heartfit.catalogue import composed, declared
from heartfit.configuration.strict import Strict
from heartfit.heart import Heart
from heartfit.mechanics.body import Tissue
from heartfit.mechanism import Sensor
from heartfit.parameter import Parameter

Element = Literal["mixed", "p1", "sphere"]


class Prior(Strict):
    """Median and relative standard deviation of a parameter; where nothing is said, the declared ones."""

    mean: PositiveFloat | None = None
    sd: Annotated[float | None, Field(gt=0, lt=1)] = None

    def over(self, other: "Prior | Parameter") -> "Prior":
        """What this one says, else what `other` says."""
        base = Prior(mean=other.value, sd=other.sd) if isinstance(other, Parameter) else other
        return Prior(mean=self.mean or base.mean, sd=self.sd or base.sd)


class Setting(Strict):
    """A model and what is estimated of it."""

    element: Element
    reference: Literal["unloaded", "end_diastolic"] = Field("unloaded", description="the stress-free state")
    mechanisms: tuple[str, ...] = Field((), description="added to the heart, by name")
    estimate: tuple[str, ...] = Field(min_length=1)
    with_pressure: tuple[str, ...] = Field((), description="estimated too where the LV pressure is measured")
    heart: dict[str, float] = Field({}, description="parameters that differ from their declared value")
    prior: dict[str, Prior] = Field({}, description="what differs from the study's prior")

    @model_validator(mode="after")
    def _names_are_sound(self) -> Self:
        try:
            heart = composed(self.mechanisms)
            for name in (*self.estimate, *self.with_pressure, *self.heart, *self.prior):
                heart.path_of(name)
            heart.with_parameters(self.heart)
        except KeyError as unknown:
            raise ValueError(str(unknown.args[0])) from None
        if len(set(self.mechanisms)) < len(self.mechanisms):
            raise ValueError(f"{', '.join(self.mechanisms)}: a mechanism is added twice; name each once")
        estimated = (*self.estimate, *self.with_pressure)
        both = sorted(set(estimated) & set(self.heart))
        if both:
            raise ValueError(f"{both[0]} is estimated and fixed at once; give its mean under prior instead")
        if len(set(estimated)) < len(estimated):
            raise ValueError(f"{', '.join(estimated)}: a parameter is estimated twice; name each once")
        return self

    def seeing_pressure(self) -> "Setting":
        """The setting of a case whose LV pressure is measured."""
        return self.model_copy(
            update={"estimate": (*self.estimate, *self.with_pressure), "with_pressure": ()}
        )

    def estimating(self, names: Sequence[str]) -> "Setting":
        """The setting with these parameters estimated instead; one that was fixed is the mean of its prior."""
        freed = {name: Prior(mean=value) for name, value in self.heart.items() if name in names}
        prior = self.prior | {name: mean.over(self.prior.get(name, Prior())) for name, mean in freed.items()}
        fixed = {name: value for name, value in self.heart.items() if name not in names}
        changes = {"estimate": tuple(names), "with_pressure": (), "heart": fixed, "prior": prior}
        return self.model_copy(update=changes)

    def with_prior(self, table: Mapping[str, Prior]) -> "Setting":
        """The setting with the prior complete: its own, over the study's, over the declared one."""
        signed = [name for name in self.estimate if declared(name).low < 0.0]
        if signed:
            raise ValueError(
                f"{signed[0]} is estimated and may be negative, but priors are log-normal; fix it under heart"
            )
        merged = {
            name: self.prior.get(name, Prior()).over(table.get(name, Prior())).over(declared(name))
            for name in self.estimate
        }
        vague = [name for name, prior in merged.items() if prior.sd is None]
        if vague:
            raise ValueError(f"{vague[0]} is estimated and has no prior; give its sd under prior")
        return self.model_copy(update={"prior": merged})

    def gaussian(self) -> Gaussian:
        """The complete prior."""
        means = {name: self.prior[name].mean or 0.0 for name in self.estimate}
        return Gaussian.of_relative(means, {name: self.prior[name].sd or 0.0 for name in self.estimate})

    def base_heart(self, period: float) -> Heart:
        """The heart at the mean of the prior."""
        heart = composed(self.mechanisms, Heart(tissue=Tissue(element=self.element), period=period))
        return heart.with_parameters({**self.heart, **self.gaussian().physical()})

    def sensors(self, parameters: Mapping[str, float]) -> tuple[Sensor, ...]:
        """The sensors through which a beat with these parameters is observed; `parameters` by name, SI."""
        return composed(self.mechanisms).with_parameters({**self.heart, **parameters}).sensors

    def units(self) -> dict[str, str]:
        """SI unit of each estimated parameter."""
        return {name: declared(name).unit for name in self.estimate}


def require_known(name: str) -> None:
    """Raise ValueError, as validation wants it, when no parameter has this name."""
    try:
        declared(name)
    except KeyError as unknown:
        raise ValueError(str(unknown.args[0])) from None
