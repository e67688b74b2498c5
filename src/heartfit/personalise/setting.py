"""Settings: model, estimated parameters and prior."""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from functools import cache
from typing import Annotated, Any, Literal, Self

from pydantic import Field, PositiveFloat, model_validator

from heartfit.calibration.gaussian import Gaussian
from heartfit.core.pages import render_page, table_row
from heartfit.core.parameter import Parameter, parameters_of
from heartfit.core.validation import Strict
from heartfit.heart.finite_elements.body import Tissue
from heartfit.heart.heart import PAPER_PARAMETERS, Heart
from heartfit.roles import Mechanism, Sensor, registered, require_registered


def declaration(name: str) -> Parameter:
    """Return the declaration of a parameter, named as in Heart.with_parameters; raises KeyError for an unknown name."""
    return _declared(name, tuple(registered().values()))


@cache
def _declared(name: str, known: tuple[type[Mechanism], ...]) -> Parameter:
    """Return a declaration, cached for a state of the registry: jobs repeatedly use the same few names."""
    heart = compose_heart(kind.__name__ for kind in known)
    *parts, last = heart.parameter_path(name).split(".")
    part: Any = heart
    for step in parts:
        part = getattr(part, step, None) or _mechanism(heart, step)
    return next(entry for entry in parameters_of(part) if entry.name == last)


def _mechanism(heart: Heart, name: str) -> Any:
    return next(mechanism for mechanism in heart.mechanisms if type(mechanism).__name__ == name)


def compose_heart(mechanisms: Iterable[str], heart: Heart | None = None) -> Heart:
    """Return a heart (the standard one) plus named mechanisms; raises KeyError with the nearest known name."""
    result = heart or Heart()
    for name in mechanisms:
        result = result + require_registered(name)()
    return result


def parameter_page() -> str:
    """Render the reference page of all parameters, in Markdown."""
    table = "".join(_row(path, entry) for path, entry in _all_parameters())
    return render_page("parameters", table=table)


def _all_parameters() -> Iterator[tuple[str, Parameter]]:
    yield from ((path, declaration(path)) for path in compose_heart(registered()).parameters())


def _row(path: str, entry: Parameter) -> str:
    of_the_paper = entry.name in PAPER_PARAMETERS and "pulmonary_tree" not in path
    return table_row(
        f"`{path}`{'*' if of_the_paper else ''}",
        f"${entry.symbol}$",
        f"{entry.value:g}{'' if entry.unit == '1' else f' {entry.unit}'}",
        "" if entry.sd is None else f"{100 * entry.sd:g} %",
        "" if entry.off is None else f"{entry.off:g}",
        "" if entry.scale is None else f"{'' if entry.one_sided else '±'}{entry.scale:g}",
        entry.meaning,
    )


Element = Literal["mixed", "p1", "sphere"]


class Prior(Strict):
    """Median and relative standard deviation of a parameter; by default the declared ones."""

    mean: PositiveFloat | None = None
    sd: Annotated[float | None, Field(gt=0, lt=1)] = None

    def over(self, other: "Prior | Parameter") -> "Prior":
        """Return this prior, completed by the fields of `other`."""
        value = other.value if isinstance(other, Parameter) else other.mean
        completed = {"mean": self.mean or value or None, "sd": self.sd or other.sd}
        return self.model_copy(update=completed)  # of valid fields: a dry run merges twenty thousand priors


class Setting(Strict):
    """A model with its estimated and fixed parameters."""

    like: str | None = Field(None, description="setting whose fields serve where this one states none")
    element: Element
    iterations: Literal[1, 2] = Field(
        1,
        description="steps of the calibration; a second one starts at the estimate of the setting that is otherwise "
        "the same with one",
    )
    reference: Literal["unloaded", "end_diastolic"] = Field("unloaded", description="the stress-free state")
    mechanisms: tuple[str, ...] = Field((), description="added to the heart, by name")
    estimate: tuple[str, ...] = Field(min_length=1)
    with_pressure: tuple[str, ...] = Field((), description="estimated, too, if the LV pressure is measured")
    observe: tuple[Literal["rv_volume"], ...] = Field(
        (), max_length=1, description="curves observed besides the LV volume and, if measured, its pressure"
    )
    cases: tuple[str, ...] | None = Field(
        None, min_length=1, description="cases that it is for; all by default"
    )
    noise: bool = Field(
        False, description="update with the noise of the observations, whatever the transform"
    )
    heart: dict[str, float] = Field({}, description="parameters that differ from their declared value")
    prior: dict[str, Prior] = Field({}, description="differences from the study's prior")

    @model_validator(mode="after")
    def _names_are_sound(self) -> Self:
        try:
            heart = compose_heart(self.mechanisms)
            for name in (*self.estimate, *self.with_pressure, *self.heart, *self.prior):
                heart.parameter_path(name)
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

    def serves(self, case: str) -> bool:
        """True if the case, by name, is calibrated under this setting."""
        return self.cases is None or case in self.cases

    def with_lv_pressure(self) -> "Setting":
        """Return the setting of a case with a measured LV pressure."""
        return self.model_copy(
            update={"estimate": (*self.estimate, *self.with_pressure), "with_pressure": ()}
        )

    def with_estimated(self, names: Sequence[str]) -> "Setting":
        """Return the setting with these parameters estimated instead; a fixed value becomes the mean of the prior.

        It observes the left ventricle, serves all cases and takes one step: settings of the same model become equal.
        """
        freed = {name: Prior(mean=value) for name, value in self.heart.items() if name in names}
        prior = self.prior | {name: mean.over(self.prior.get(name, Prior())) for name, mean in freed.items()}
        fixed = {name: value for name, value in self.heart.items() if name not in names}
        model = {"estimate": tuple(names), "heart": fixed, "prior": prior}
        rest = {"with_pressure": (), "observe": (), "cases": None, "noise": False, "iterations": 1}
        changes = model | rest
        return self.model_copy(update=changes)

    def with_prior(self, table: Mapping[str, Prior]) -> "Setting":
        """Return the setting with a complete prior: the setting's, then the study's, then the declared one."""
        signed = [name for name in self.estimate if declaration(name).low < 0.0]
        if signed:
            raise ValueError(
                f"{signed[0]} is estimated and may be negative, but priors are log-normal; fix it under heart"
            )
        zero = [name for name in self.estimate if self._median(name, table) == 0.0]
        if zero:
            raise ValueError(
                f"{zero[0]} is estimated and zero by default, but priors are log-normal; give its mean under prior"
            )
        merged = {
            name: self.prior.get(name, Prior()).over(table.get(name, Prior())).over(declaration(name))
            for name in self.estimate
        }
        vague = [name for name, prior in merged.items() if prior.sd is None]
        if vague:
            raise ValueError(f"{vague[0]} is estimated and has no prior; give its sd under prior")
        return self.model_copy(update={"prior": merged})

    def _median(self, name: str, table: Mapping[str, Prior]) -> float:
        """Stated median of a parameter: the setting's, then the study's, then the declared value."""
        stated = (prior.mean for prior in (self.prior.get(name), table.get(name)) if prior is not None)
        return next((mean for mean in stated if mean is not None), declaration(name).value)

    def gaussian(self) -> Gaussian:
        """Return the complete prior."""
        means = {name: self.prior[name].mean or 0.0 for name in self.estimate}
        return Gaussian.from_relative(means, {name: self.prior[name].sd or 0.0 for name in self.estimate})

    def base_heart(self, period: float) -> Heart:
        """Return the heart at the mean of the prior."""
        heart = compose_heart(self.mechanisms, Heart(tissue=Tissue(element=self.element), period=period))
        return heart.with_parameters({**self.heart, **self.gaussian().physical()})

    def sensors(self, parameters: Mapping[str, float]) -> tuple[Sensor, ...]:
        """Return the sensors that observe a beat with these parameters; `parameters` by name [SI]."""
        return compose_heart(self.mechanisms).with_parameters({**self.heart, **parameters}).sensors

    def units(self) -> dict[str, str]:
        """SI unit of each estimated parameter."""
        return {name: declaration(name).unit for name in self.estimate}


def require_known(name: str) -> None:
    """Raise ValueError, as required for validation, if no parameter has this name."""
    try:
        declaration(name)
    except KeyError as unknown:
        raise ValueError(str(unknown.args[0])) from None
