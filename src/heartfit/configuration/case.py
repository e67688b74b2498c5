"""A row of the table of cases."""

from collections.abc import Mapping
from typing import Annotated, Literal, Self

from pydantic import Field, field_validator, model_validator

from heartfit.configuration.fields import Name, Seed
from heartfit.configuration.strict import Strict
from heartfit.geometry.parametric import ParametricVentricles
from heartfit.mechanism import Mechanism, Sensor, registered

SHAPE = ("edv", "wall_thickness", "sphericity", "rv_edv", "rv_wall_thickness")
Factor = Annotated[float, Field(gt=0, lt=20)]
HIDDEN = ("sigma_0", "mu", "c_1", "R_p")


class Case(Strict):
    """A subject; a virtual one also says its shape, its hidden parameters and the seed of all else that is hidden."""

    case: Name = Field(pattern="^[^_]*$")
    kind: Literal["measured", "virtual"]
    period: float = Field(gt=0.3, lt=2.0, description="s")
    conduction: Literal["healthy", "lbbb"] = Field("healthy", description="where depolarisation starts")
    qrs: float | None = Field(None, gt=0.05, lt=0.3, description="s, duration of the QRS complex")
    catheter: bool = Field(False, description="whether the pressure of the left ventricle is recorded")
    edp: float | None = Field(
        None, ge=0, lt=5e3, description="Pa, of the left ventricle at end diastole; the study's if not given"
    )
    seed: Seed | None = None
    edv: float | None = Field(None, gt=5e-5, lt=4e-4, description="m^3")
    wall_thickness: float | None = Field(None, gt=4e-3, lt=25e-3, description="m")
    sphericity: float | None = Field(None, gt=1, lt=3, description="long axis over diameter")
    rv_edv: float | None = Field(None, gt=5e-5, lt=4e-4, description="m^3")
    rv_wall_thickness: float | None = Field(None, gt=1e-3, lt=1e-2, description="m")
    sigma_0: Factor | None = Field(None, description="over the cohort's mean, as the next three")
    mu: Factor | None = None
    c_1: Factor | None = None
    R_p: Factor | None = None
    plant: str | None = Field(
        None, description="a mechanism that a virtual heart has and the calibrator lacks"
    )
    plant_scales: float = Field(0.0, description="its amplitude, over the scale that a search gives it")

    @model_validator(mode="after")
    def _is_complete(self) -> Self:
        needed = ("seed", *SHAPE, *HIDDEN) if self.kind == "virtual" else ()
        missing = [name for name in needed if getattr(self, name) is None]
        if missing:
            raise ValueError(f"{self.case} is virtual and lacks {', '.join(missing)}; give a number")
        if self.conduction == "lbbb" and self.qrs is None:
            raise ValueError(
                f"{self.case} has a bundle branch block and lacks qrs; give its duration, qrs_ms"
            )
        return self

    @field_validator("plant")
    @classmethod
    def _acts_on_the_heart(cls, plant: str | None) -> str | None:
        hearts = [name for name, kind in registered().items() if not issubclass(kind, Sensor)]
        if plant is not None and plant not in hearts:
            raise ValueError(f"plant {plant!r} is no mechanism of a heart; known are {', '.join(hearts)}")
        return plant

    def planted_sizes(self) -> list[tuple[str, float, str]]:
        """Name, amplitude, SI, and its unit of what a virtual case hides; only an evaluation may know it."""
        return [
            (type(each).__name__, getattr(each, each.switch().name), each.switch().unit)
            for each in self.planted()
        ]

    def planted(self) -> tuple[Mechanism, ...]:
        """The mechanism that a virtual case hides, none if it hides none."""
        if self.plant is None:
            return ()
        kind = registered()[self.plant]
        return (kind(**{kind.switch().name: kind.switch().at(self.plant_scales)}),)

    @property
    def healthy(self) -> bool:
        """Whether the case is a volunteer rather than a patient."""
        return self.conduction == "healthy"

    @property
    def hidden(self) -> Mapping[str, float]:
        """The hidden parameters of a virtual case, over the cohort's mean."""
        return {name: getattr(self, name) for name in HIDDEN}

    def shape(self) -> ParametricVentricles:
        """The ventricles of a virtual case."""
        return ParametricVentricles(**{name: getattr(self, name) for name in SHAPE})
