"""A row of the table of cases."""

from typing import Literal, Self

from pydantic import Field, model_validator

from heartfit.configuration.strict import Strict
from heartfit.geometry.parametric import ParametricVentricles


class Case(Strict):
    """A subject; a virtual one also says its shape and the seed of its hidden truth."""

    case: str = Field(pattern=r"^[A-Za-z][A-Za-z0-9-]*$")
    kind: Literal["measured", "virtual"]
    period: float = Field(gt=0.3, lt=2.0, description="s")
    seed: int | None = None
    edv: float | None = Field(None, gt=5e-5, lt=4e-4, description="m^3")
    wall_thickness: float | None = Field(None, gt=4e-3, lt=25e-3, description="m")
    sphericity: float | None = Field(None, gt=1, lt=3, description="long axis over diameter")
    rv_edv: float | None = Field(None, gt=5e-5, lt=4e-4, description="m^3")
    rv_wall_thickness: float | None = Field(None, gt=1e-3, lt=1e-2, description="m")

    @model_validator(mode="after")
    def _virtual_is_complete(self) -> Self:
        missing = [name for name in type(self).model_fields if getattr(self, name) is None]
        if self.kind == "virtual" and missing:
            raise ValueError(f"{self.case} is virtual and lacks {', '.join(missing)}; give a number")
        return self

    def shape(self) -> ParametricVentricles:
        """The ventricles of a virtual case."""
        return ParametricVentricles(**self.model_dump(exclude={"case", "kind", "period", "seed"}))
