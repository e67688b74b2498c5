"""How volunteers are imaged, how images are registered, and how what registration costs is measured."""

from collections.abc import Mapping
from typing import Any, Self

from pydantic import Field, model_validator

from heartfit.cohort.catheter import Catheter
from heartfit.cohort.scanner import Contrast, Scanner
from heartfit.configuration.fields import MOST, Count, Seed
from heartfit.configuration.generator import Generator
from heartfit.configuration.strict import Strict
from heartfit.observation.noise_model import FEWEST_SEQUENCES
from heartfit.registration.matching import FreeForm

BASELINE = "baseline"
"""The acquisition by the cohort's own scanner."""


class ImageContrast(Strict):
    """Brightness of the tissues; see heartfit.cohort.scanner."""

    blood: float = Field(default=Contrast.blood, gt=0)
    muscle: float = Field(default=Contrast.muscle, ge=0)
    lung: float = Field(default=Contrast.lung, ge=0)
    fat: float = Field(default=Contrast.fat, ge=0)
    leaflets: float = Field(default=Contrast.leaflets, ge=0)
    muscle_texture: float = Field(
        default=Contrast.muscle_texture, ge=0, lt=1, description="relative deviation"
    )
    lung_texture: float = Field(default=Contrast.lung_texture, ge=0, lt=1, description="relative deviation")
    texture_length: float = Field(default=Contrast.texture_length, gt=0, lt=0.1, description="m")


class Acquisition(Strict):
    """The settings of the scanner; see heartfit.cohort.scanner."""

    frames: int = Field(default=Scanner.frames, ge=8, le=200)
    voxel: float = Field(default=Scanner.voxel, gt=2e-4, lt=0.01, description="m, in the plane")
    slice_thickness: float = Field(default=Scanner.slice_thickness, gt=2e-4, lt=0.03, description="m")
    slice_gap: float = Field(default=Scanner.slice_gap, ge=0, lt=0.03, description="m")
    signal_to_noise: float = Field(default=Scanner.signal_to_noise, gt=1, description="of blood")
    window: float = Field(default=Scanner.window, ge=0, lt=0.2, description="s, blurred by the motion")
    breath_hold_shift: float = Field(
        default=Scanner.breath_hold_shift, ge=0, lt=0.03, description="m, sd of a slice"
    )
    margin: float = Field(default=Scanner.margin, gt=0, lt=0.1, description="m, of the box about the heart")
    subvoxel: float = Field(
        default=Scanner.subvoxel, gt=1e-4, lt=0.01, description="m, what a voxel averages"
    )
    subframes: int = Field(default=Scanner.subframes, ge=1, le=100)
    contrast: ImageContrast = ImageContrast()

    def scanner(self) -> Scanner:
        """As the cohort takes it."""
        return Scanner(**{**self.model_dump(), "contrast": Contrast(**self.contrast.model_dump())})


class PressureLine(Strict):
    """The catheter; see heartfit.cohort.catheter."""

    rate: float = Field(default=Catheter.rate, gt=50, lt=1e5, description="Hz")
    noise: float = Field(default=Catheter.noise, ge=0, lt=5e3, description="Pa, sd of a sample")
    offset: float = Field(default=Catheter.offset, ge=0, lt=5e3, description="Pa, sd of a recording")

    def catheter(self) -> Catheter:
        """As the cohort takes it."""
        return Catheter(**self.model_dump())


class Registration(Strict):
    """How frames are matched to end diastole; see heartfit.registration.matching."""

    knots: float = Field(default=FreeForm.knots, gt=1e-3, lt=0.1, description="m, between control points")
    stiffness: float = Field(default=FreeForm.stiffness, gt=0, description="m^2")
    incompressibility: float = Field(default=FreeForm.incompressibility, ge=0)
    reach: float = Field(default=FreeForm.reach, gt=0, lt=0.05, description="m, beyond the wall")
    levels: tuple[tuple[Count, Count], ...] = Field(
        default=FreeForm.levels, min_length=1, description="voxels of a block, most steps"
    )

    end_diastole: int = Field(default=0, ge=0, description="frame of the images")

    def free_form(self) -> FreeForm:
        """As the registration takes it."""
        return FreeForm(**self.model_dump(exclude={"end_diastole"}))


class RegistrationError(Generator):
    """Which hearts are simulated, imaged and registered to learn what that costs, and by which other protocols.

    mesh, numerics: of these hearts, coarser than the cohort's; varied: by the name of a setting of the scanner its
    other values, each of which is tried on the first few hearts; fresh: further hearts that the noise model has not
    seen, to try it on.
    """

    sequences: int = Field(ge=FEWEST_SEQUENCES, le=MOST, description="hearts imaged by the cohort's protocol")
    varied_sequences: Count = Field(description="hearts imaged by each other protocol")
    fresh: Count = Field(description="further hearts imaged by the cohort's protocol")
    seed: Seed = Field(description="from which on the hearts are drawn")
    varied: dict[str, tuple[float, ...]] = Field({}, description="other values by setting of the scanner")

    @model_validator(mode="after")
    def _settings_exist(self) -> Self:
        for name in self.varied:
            if name not in Acquisition.model_fields:
                known = ", ".join(Acquisition.model_fields)
                raise ValueError(f"varied.{name} is no setting of the scanner; known are {known}")
        if self.varied_sequences > self.sequences:
            raise ValueError(
                f"varied_sequences = {self.varied_sequences} is more than sequences = {self.sequences}"
            )
        return self

    def acquisitions(self) -> dict[str, tuple[str, float]]:
        """Setting and value of each other protocol, by its name in paths."""
        return {
            f"{name}-{value:g}": (name, value) for name, values in self.varied.items() for value in values
        }


def flat(content: Mapping[str, Any]) -> dict[str, float | int | str | bool]:
    """Tables within tables as one, with dotted names; lists as text."""
    result: dict[str, float | int | str | bool] = {}
    for name, value in content.items():
        inner = value.model_dump() if isinstance(value, Strict) else value
        if isinstance(inner, Mapping):
            result |= {f"{name}.{key}": each for key, each in flat(inner).items()}
        else:
            result[name] = inner if isinstance(inner, float | int | str | bool) else str(inner)
    return result
