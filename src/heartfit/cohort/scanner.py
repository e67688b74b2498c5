"""The settings of a synthetic scanner."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Contrast:
    """Brightness of the tissues in a balanced cine, blood = 1, and the texture of the tissues.

    muscle_texture, lung_texture: standard deviation over the mean brightness; texture_length: m, the standard deviation
    of the Gaussian that smooths white noise into the texture.
    """

    blood: float = 1.0
    muscle: float = 0.4
    lung: float = 0.1
    fat: float = 0.75
    leaflets: float = 0.5
    muscle_texture: float = 0.2
    lung_texture: float = 0.3
    texture_length: float = 2.5e-3


@dataclass(frozen=True)
class Scanner:
    """How a beat is imaged: short-axis slices across the left ventricle's long axis.

    frames over the beat, equidistant from the trigger; voxel: width in the plane, m; slice_thickness and slice_gap, m;
    signal_to_noise: brightness of blood over the standard deviation of the noise in either channel, whose magnitude is
    Rician; window: time that a frame takes, s, over which it is blurred; breath_hold_shift: standard deviation of a
    slice's displacement in its plane, m, in each of both directions; margin: of the box about the heart, m;
    subvoxel: largest distance of the samples that a voxel averages, m; subframes: instants that a frame averages.
    """

    frames: int = 25
    voxel: float = 2e-3
    slice_thickness: float = 2e-3
    slice_gap: float = 0.0
    signal_to_noise: float = 30.0
    window: float = 0.03
    breath_hold_shift: float = 0.0
    contrast: Contrast = Contrast()
    margin: float = 14e-3
    subvoxel: float = 1e-3
    subframes: int = 3
