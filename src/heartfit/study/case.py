"""Cases of a study: rows of its table, and sources of measured hearts."""

from collections.abc import Mapping
from typing import Annotated, Literal, Self

from pydantic import Field, PositiveInt, field_validator, model_validator

from heartfit.core.validation import Name, Seed, Strict
from heartfit.geometry.parametric import ParametricVentricles
from heartfit.roles import Sensor, registered
from heartfit.synthetic.campaign import DRAWN

WALLS = ("fit", "surfaces", "segmentation")
"""Keys of a source that may provide the wall."""


class Labels(Strict):
    """Label numbers of a segmentation; they differ between data sets and are never guessed."""

    lv_cavity: PositiveInt
    lv_wall: PositiveInt
    rv_cavity: PositiveInt
    rv_wall: PositiveInt | None = None

    @model_validator(mode="after")
    def _differ(self) -> Self:
        numbers = self.numbers()
        if len(set(numbers.values())) < len(numbers):
            pairs = ", ".join(f"{name} {number}" for name, number in numbers.items())
            raise ValueError(f"two labels share a number ({pairs}); give each label its own number")
        return self

    def numbers(self) -> dict[str, int]:
        """Return the label numbers that are set, by name."""
        return self.model_dump(exclude_none=True)


class RecordedPressure(Strict):
    """Recording of the left ventricular pressure over one beat or several."""

    file: str = Field(
        min_length=1, description="CSV with a time in s or ms and pressures; the first line names the columns"
    )
    unit: Literal["mmHg", "kPa"] | None = Field(
        None, description="unit of the pressure, if the column's name does not state it"
    )
    column: str | None = Field(
        None, description="column of the left ventricle, if there are several pressures"
    )
    trigger: str | None = Field(
        None, description="column of the ECG, or of a marker that steps up at each trigger"
    )
    upstroke: float | None = Field(
        None,
        gt=0,
        lt=0.4,
        description="s, from the trigger to the steepest rise of the pressure, if no column marks the trigger",
    )
    zero: float = Field(0.0, description="reading of the line at zero pressure, in the unit of the recording")
    delay: float = Field(0.0, gt=-0.2, lt=0.2, description="s, delay of the line")

    @model_validator(mode="after")
    def _has_one_trigger(self) -> Self:
        if self.trigger is not None and self.upstroke is not None:
            raise ValueError("trigger and upstroke both say when a beat begins; leave one out")
        if self.upstroke is not None and self.delay:
            raise ValueError(
                "upstroke says when the pressure rises, including the delay of the line; leave delay out"
            )
        return self


class Source(Strict):
    """Data of a measured case; paths are absolute or relative to the working directory, and are only read.

    The wall comes from one of three: a biv-me fit, a folder of surface meshes of every phase, or a segmentation
    with a cine from which its motion is registered.
    """

    fit: str | None = Field(None, min_length=1, description="folder in the layout of a biv-me subject")
    surfaces: str | None = Field(None, min_length=1, description="folder of surface meshes, one per phase")
    segmentation: str | None = Field(
        None, min_length=1, description="label volume at end diastole, or one of each frame of the images"
    )
    labels: Labels | None = Field(None, description="label numbers of the segmentation")
    rv_wall_thickness: float = Field(
        3e-3, gt=1e-3, lt=1e-2, description="m, used if the wall of the right ventricle is not segmented"
    )
    images: str | None = Field(None, min_length=1, description="cine: a 4-D file, or a folder")
    end_diastole: int = Field(0, ge=0, description="frame of the images at end diastole")
    pressure: RecordedPressure | None = Field(None, description="recording of the left ventricular pressure")

    @model_validator(mode="after")
    def _has_one_wall(self) -> Self:
        stated = [name for name in WALLS if getattr(self, name) is not None]
        if len(stated) != 1:
            raise ValueError(
                f"{' and '.join(stated) or 'no source'} given for the wall; expected one of {', '.join(WALLS)}"
            )
        if (self.segmentation is None) != (self.labels is None):
            raise ValueError(
                "segmentation and labels go together; expected labels such as "
                "{lv_cavity: 1, lv_wall: 2, rv_cavity: 3}"
            )
        if self.segmentation is not None and self.images is None:
            raise ValueError(
                "images are missing; expected the cine from which the motion of a segmentation is registered"
            )
        if self.segmentation is None and self.end_diastole:
            raise ValueError(
                "end_diastole applies to a segmentation only; phase 0 of a fit and of surfaces is end diastole"
            )
        return self

    @property
    def segmented(self) -> bool:
        """True if the motion must be registered from images."""
        return self.segmentation is not None


SHAPE = ("edv", "wall_thickness", "sphericity", "rv_edv", "rv_wall_thickness")
Factor = Annotated[float, Field(gt=0, lt=20)]
HIDDEN = ("sigma_0", "mu", "c_1", "R_p")
Kind = Literal["measured", "virtual", "sealed"]
CASE_KINDS: dict[Kind, str] = {
    "measured": "measured heart",
    "virtual": "virtual heart, truth known",
    "sealed": "virtual heart with or without a hidden effect, which the search for missing mechanisms is not told",
}
"""Kinds of cases and their descriptions in the report; all but measured ones need no source."""


class Case(Strict):
    """Subject of a study; a virtual one has a shape, hidden parameters, and a seed of all other hidden values."""

    case: Name = Field(pattern="^[^_]*$")
    kind: Kind
    period: float = Field(gt=0.3, lt=2.0, description="s")
    conduction: Literal["healthy", "lbbb"] = Field(
        "healthy", description="conduction, which sets the start of depolarisation"
    )
    qrs: float | None = Field(None, gt=0.05, lt=0.3, description="s, duration of the QRS complex")
    catheter: bool = Field(False, description="true if the left ventricular pressure is recorded")
    edp: float | None = Field(
        None,
        ge=0,
        lt=5e3,
        description="Pa, left ventricular pressure at end diastole; the study's if not given",
    )
    seed: Seed | None = None
    edv: float | None = Field(None, gt=5e-5, lt=4e-4, description="m^3")
    wall_thickness: float | None = Field(None, gt=4e-3, lt=25e-3, description="m")
    sphericity: float | None = Field(None, gt=1, lt=3, description="long axis over diameter")
    rv_edv: float | None = Field(None, gt=5e-5, lt=4e-4, description="m^3")
    rv_wall_thickness: float | None = Field(None, gt=1e-3, lt=1e-2, description="m")
    sigma_0: Factor | None = Field(None, description="ratio to the cohort's mean, as for mu, c_1 and R_p")
    mu: Factor | None = None
    c_1: Factor | None = None
    R_p: Factor | None = None
    plant: str | None = Field(
        None,
        description="mechanism that the calibrator lacks, by name or `drawn` by the seed; sealed hearts only",
    )
    plant_scales: float = Field(0.0, description="amplitude of a named mechanism, in its scales")

    @model_validator(mode="after")
    def _is_complete(self) -> Self:
        needed = ("seed", *SHAPE, *HIDDEN) if self.virtual else ()
        missing = [name for name in needed if getattr(self, name) is None]
        if missing:
            raise ValueError(f"{self.case} is {self.kind} and lacks {', '.join(missing)}; give numbers")
        if self.plant is not None and self.kind != "sealed":
            raise ValueError(f"{self.case} is {self.kind} and has a plant; expected kind sealed, or no plant")
        if self.conduction == "lbbb" and self.qrs is None:
            raise ValueError(
                f"{self.case} has a bundle branch block and lacks qrs; give its duration, qrs_ms"
            )
        return self

    @field_validator("plant")
    @classmethod
    def _acts_on_the_heart(cls, plant: str | None) -> str | None:
        hearts = [name for name, kind in registered().items() if not issubclass(kind, Sensor)]
        if plant is not None and plant not in (DRAWN, *hearts):
            raise ValueError(
                f"plant {plant!r} is no mechanism of a heart; expected {DRAWN}, or one of {', '.join(hearts)}"
            )
        return plant

    @property
    def virtual(self) -> bool:
        """True for a generated heart, False for a measured one."""
        return self.kind != "measured"

    @property
    def healthy(self) -> bool:
        """True for a volunteer, False for a patient."""
        return self.conduction == "healthy"

    @property
    def hidden(self) -> Mapping[str, float]:
        """Hidden parameters of a virtual case, as ratios to the cohort's mean."""
        return {name: getattr(self, name) for name in HIDDEN}

    def shape(self) -> ParametricVentricles:
        """Return the ventricles of a virtual case."""
        return ParametricVentricles(**{name: getattr(self, name) for name in SHAPE})
