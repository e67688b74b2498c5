"""Where the data of a measured case lie, and what their files do not say themselves."""

from typing import Literal, Self

from pydantic import Field, PositiveInt, model_validator

from heartfit.configuration.strict import Strict

WALLS = ("fit", "surfaces", "segmentation")


class Labels(Strict):
    """Which number stands for what in a segmentation: it differs between data sets, so it is never guessed."""

    lv_cavity: PositiveInt
    lv_wall: PositiveInt
    rv_cavity: PositiveInt
    rv_wall: PositiveInt | None = None

    @model_validator(mode="after")
    def _differ(self) -> Self:
        given = self.numbers()
        if len(set(given.values())) < len(given):
            said = ", ".join(f"{name} {number}" for name, number in given.items())
            raise ValueError(f"two labels share a number ({said}); give each its own")
        return self

    def numbers(self) -> dict[str, int]:
        """The labels that are there, by name."""
        return self.model_dump(exclude_none=True)


class RecordedPressure(Strict):
    """A recording of the left ventricle's pressure, over one beat or several."""

    file: str = Field(
        min_length=1, description="CSV; a time in s or ms and pressures, named in the first line"
    )
    unit: Literal["mmHg", "kPa"] | None = Field(None, description="where the column's name does not say it")
    column: str | None = Field(None, description="of the left ventricle, where there are several pressures")
    trigger: str | None = Field(
        None, description="the column of the ECG, or of a marker that steps up at each trigger"
    )
    upstroke: float | None = Field(
        None,
        gt=0,
        lt=0.4,
        description="s after the trigger, when the pressure rises fastest; where no column says the trigger",
    )
    zero: float = Field(0.0, description="what the line shows at no pressure, in the unit of the recording")
    delay: float = Field(0.0, gt=-0.2, lt=0.2, description="s, by which the line is late")

    @model_validator(mode="after")
    def _knows_the_trigger_once(self) -> Self:
        if self.trigger is not None and self.upstroke is not None:
            raise ValueError("trigger and upstroke both say when a beat begins; leave one out")
        if self.upstroke is not None and self.delay:
            raise ValueError("upstroke says when the pressure rises, late or not; leave delay out")
        return self


class Source(Strict):
    """The data of a measured case; paths are relative to the working directory, or absolute, and are only read.

    The wall comes from one of three: a biv-me fit, a folder of surface meshes in every phase, or a segmentation
    whose motion is registered.
    """

    fit: str | None = Field(None, min_length=1, description="folder in the layout of a biv-me subject")
    surfaces: str | None = Field(None, min_length=1, description="folder of surface meshes, one a phase")
    segmentation: str | None = Field(
        None, min_length=1, description="label volume, of end diastole or of each frame of the images"
    )
    labels: Labels | None = Field(None, description="of the segmentation")
    rv_wall_thickness: float = Field(
        3e-3, gt=1e-3, lt=1e-2, description="m, where the right ventricle's wall is not segmented"
    )
    images: str | None = Field(None, min_length=1, description="cine: a 4-D file, or a folder")
    end_diastole: int = Field(0, ge=0, description="frame of the images")
    pressure: RecordedPressure | None = Field(None, description="of the left ventricle")

    @model_validator(mode="after")
    def _says_the_wall_once(self) -> Self:
        given = [name for name in WALLS if getattr(self, name) is not None]
        if len(given) != 1:
            raise ValueError(
                f"{' and '.join(given) or 'no source'} given for the wall; expected one of {', '.join(WALLS)}"
            )
        if (self.segmentation is None) != (self.labels is None):
            raise ValueError(
                "segmentation and labels go together; expected labels such as "
                "{lv_cavity: 1, lv_wall: 2, rv_cavity: 3}"
            )
        if self.segmentation is not None and self.images is None:
            raise ValueError(
                "images are missing; expected the cine that the motion of a segmentation is registered from"
            )
        if self.segmentation is None and self.end_diastole:
            raise ValueError(
                "end_diastole is of a segmentation; phase 0 of a fit and of surfaces is end diastole"
            )
        return self

    @property
    def segmented(self) -> bool:
        """Whether the motion has to be registered from images."""
        return self.segmentation is not None
