"""Configuration of virtual images, their registration, and the measurement of the registration error."""

from collections.abc import Mapping
from typing import Any, Self

from pydantic import Field, model_validator

from heartfit.core.validation import LARGEST_COUNT, Count, Seed, Strict
from heartfit.imaging.registration import FreeForm
from heartfit.observation.noise_model import MIN_SEQUENCES
from heartfit.personalise.numerics import Generator
from heartfit.synthetic.scanner import Catheter, Contrast, Scanner

BASELINE = "baseline"
"""Name of the acquisition by the cohort's scanner."""


class ImageContrast(Strict):
    """Brightness and texture of the tissues; see heartfit.synthetic.scanner."""

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
    """Settings of the scanner; see heartfit.synthetic.scanner."""

    frames: int = Field(default=Scanner.frames, ge=8, le=200)
    voxel: float = Field(default=Scanner.voxel, gt=2e-4, lt=0.01, description="m, in the plane")
    slice_thickness: float = Field(default=Scanner.slice_thickness, gt=2e-4, lt=0.03, description="m")
    slice_gap: float = Field(default=Scanner.slice_gap, ge=0, lt=0.03, description="m")
    signal_to_noise: float = Field(default=Scanner.signal_to_noise, gt=1, description="ratio for blood")
    window: float = Field(
        default=Scanner.window,
        ge=0,
        lt=0.2,
        description="s, duration of a frame, over which the motion blurs it",
    )
    breath_hold_shift: float = Field(
        default=Scanner.breath_hold_shift,
        ge=0,
        lt=0.03,
        description="m, standard deviation of the displacement of a slice",
    )
    margin: float = Field(
        default=Scanner.margin, gt=0, lt=0.1, description="m, margin of the box around the heart"
    )
    subvoxel: float = Field(
        default=Scanner.subvoxel,
        gt=1e-4,
        lt=0.01,
        description="m, distance of the samples that a voxel averages",
    )
    subframes: int = Field(default=Scanner.subframes, ge=1, le=100)
    contrast: ImageContrast = ImageContrast()

    def scanner(self) -> Scanner:
        """Return the scanner of the virtual cohort."""
        return Scanner(**{**self.model_dump(), "contrast": Contrast(**self.contrast.model_dump())})


class PressureLine(Strict):
    """Settings of the catheter; see heartfit.synthetic.scanner."""

    rate: float = Field(default=Catheter.rate, gt=50, lt=1e5, description="Hz")
    noise: float = Field(
        default=Catheter.noise, ge=0, lt=5e3, description="Pa, standard deviation of a sample"
    )
    offset: float = Field(
        default=Catheter.offset, ge=0, lt=5e3, description="Pa, standard deviation of the zero of a recording"
    )

    def catheter(self) -> Catheter:
        """Return the catheter of the virtual cohort."""
        return Catheter(**self.model_dump())


class Registration(Strict):
    """Settings of the registration of frames to end diastole; see heartfit.imaging.registration."""

    knots: float = Field(default=FreeForm.knots, gt=1e-3, lt=0.1, description="m, distance of control points")
    stiffness: float = Field(default=FreeForm.stiffness, gt=0, description="m^2")
    incompressibility: float = Field(default=FreeForm.incompressibility, ge=0)
    reach: float = Field(
        default=FreeForm.reach, gt=0, lt=0.05, description="m, extent of the region beyond the wall"
    )
    levels: tuple[tuple[Count, Count], ...] = Field(
        default=FreeForm.levels, min_length=1, description="voxels per block and most steps, per level"
    )

    end_diastole: int = Field(default=0, ge=0, description="frame of the images at end diastole")

    def free_form(self) -> FreeForm:
        """Return the free-form registration with these settings."""
        return FreeForm(**self.model_dump(exclude={"end_diastole"}))


class RegistrationError(Generator):
    """Hearts that are simulated, imaged and registered to measure the registration error, and varied protocols.

    mesh, numerics: of these hearts, coarser than the cohort's; varied: alternative values by setting of the scanner,
    tried on the first few hearts; fresh: further hearts, held out from the noise model, to validate it.
    """

    sequences: int = Field(
        ge=MIN_SEQUENCES, le=LARGEST_COUNT, description="hearts imaged by the cohort's protocol"
    )
    varied_sequences: Count = Field(description="hearts imaged by each varied protocol")
    fresh: Count = Field(description="further hearts imaged by the cohort's protocol")
    seed: Seed = Field(description="seed of the first heart")
    noise_model: str | None = Field(
        None,
        min_length=1,
        description="stored noise model, which serves where its protocol is the study's; without `methods` only",
    )
    varied: dict[str, tuple[float, ...]] = Field(
        {}, description="alternative values by setting of the scanner"
    )

    @model_validator(mode="after")
    def _settings_exist(self) -> Self:
        for name in self.varied:
            if name not in Acquisition.model_fields:
                known = ", ".join(Acquisition.model_fields)
                raise ValueError(f"varied.{name} is no setting of the scanner; expected one of {known}")
        if self.varied_sequences > self.sequences:
            raise ValueError(
                f"varied_sequences = {self.varied_sequences} is more than sequences = {self.sequences}"
            )
        return self

    def acquisitions(self) -> dict[str, tuple[str, float]]:
        """Return setting and value of each varied protocol, by its name in paths."""
        return {
            f"{name}-{value:g}": (name, value) for name, values in self.varied.items() for value in values
        }


def flat(content: Mapping[str, Any]) -> dict[str, float | int | str | bool]:
    """Flatten nested tables into one with dotted names; lists become text."""
    result: dict[str, float | int | str | bool] = {}
    for name, value in content.items():
        inner = value.model_dump() if isinstance(value, Strict) else value
        if isinstance(inner, Mapping):
            result |= {f"{name}.{key}": entry for key, entry in flat(inner).items()}
        else:
            result[name] = inner if isinstance(inner, float | int | str | bool) else str(inner)
    return result
