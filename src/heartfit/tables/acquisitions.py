"""Comparisons of registered with true motions, by how the images were acquired."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from heartfit.errors import InputError
from heartfit.geometry.arrays import Floats
from heartfit.observation.comparison import Comparison

HEADINGS = {
    "signal_to_noise": ("SNR", 1.0),
    "slice_thickness": ("slice thickness (mm)", 1e3),
    "slice_gap": ("slice gap (mm)", 1e3),
    "voxel": ("voxel (mm)", 1e3),
    "breath_hold_shift": ("breath-hold shift (mm)", 1e3),
    "window": ("window (ms)", 1e3),
}
"""What tables and figures call the settings of the scanner, and the factor from SI."""


@dataclass(frozen=True)
class Acquisitions:
    """Sequences of one baseline protocol, and of protocols that differ from it in one setting.

    settings: the baseline's value of each setting that is varied, by its heading ("SNR", "slice thickness (mm)");
    baseline: its comparisons, one for each sequence; varied: by heading and by value those of the other protocols.
    Raises InputError for a protocol without sequences and for a setting whose baseline is not told.
    """

    settings: Mapping[str, float]
    baseline: Sequence[Comparison]
    varied: Mapping[str, Mapping[float, Sequence[Comparison]]]

    def __post_init__(self) -> None:
        for heading in self.varied:
            if heading not in self.settings:
                raise InputError(
                    f"acquisitions: {heading} is varied, its baseline is not told; expected a number: give it"
                )
        for label, comparisons in self.rows().items():
            if not comparisons:
                raise InputError(
                    f"acquisitions: {label} has no sequences; expected one or more: leave it out"
                )

    @classmethod
    def of(
        cls,
        settings: Mapping[str, float],
        tried: Sequence[tuple[str, float] | None],
        comparisons: Iterable[Comparison],
    ) -> "Acquisitions":
        """The comparisons sorted by what was ``tried``: a setting of the scanner and its value, or the baseline (None).

        settings: the baseline's values, SI, by the names that the scanner has for them.
        """
        baseline: list[Comparison] = []
        varied: dict[str, dict[float, list[Comparison]]] = {}
        for what, comparison in zip(tried, comparisons, strict=True):
            if what is None:
                baseline.append(comparison)
            else:
                heading, value = _shown(*what)
                varied.setdefault(heading, {}).setdefault(value, []).append(comparison)
        return cls(dict(_shown(name, value) for name, value in settings.items()), baseline, varied)

    def rows(self) -> dict[str, Sequence[Comparison]]:
        """The comparisons of each protocol, the baseline first."""
        others = {
            f"{heading} {value:g}": by_value[value]
            for heading, by_value in self.varied.items()
            for value in sorted(by_value)
        }
        return {"baseline": self.baseline, **others}

    def course(self, heading: str) -> dict[float, Sequence[Comparison]]:
        """The comparisons by the value of one setting, ascending, the baseline among them."""
        return dict(sorted({**self.varied[heading], self.settings[heading]: self.baseline}.items()))


def _shown(setting: str, value: float) -> tuple[str, float]:
    """Heading and value, in the heading's unit, of a setting of the scanner."""
    heading, factor = HEADINGS.get(setting, (setting.replace("_", " "), 1.0))
    return heading, round(factor * value, 9)


def percent_errors(comparisons: Sequence[Comparison]) -> dict[str, Floats]:
    """Error (N,) in percent of each observation, negative where its size is underestimated, sequence by sequence."""
    errors = [comparison.observation_errors() for comparison in comparisons]
    return {name: 100.0 * np.array([each[name] for each in errors]) for name in errors[0]}


def strain_errors(comparisons: Sequence[Comparison]) -> Floats:
    """Registered less true strain (N, 3, 16) at end systole, in percent strain."""
    return 100.0 * np.array([comparison.strain_error_at_end_systole() for comparison in comparisons])
