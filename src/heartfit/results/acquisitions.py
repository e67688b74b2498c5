"""Registered and true motions, compared by acquisition of the images."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from heartfit.core.arrays import Floats
from heartfit.core.errors import InputError
from heartfit.observation.comparison import Comparison

HEADINGS = {
    "signal_to_noise": ("SNR", 1.0),
    "slice_thickness": ("slice thickness (mm)", 1e3),
    "slice_gap": ("slice gap (mm)", 1e3),
    "voxel": ("voxel (mm)", 1e3),
    "breath_hold_shift": ("breath-hold shift (mm)", 1e3),
    "window": ("window (ms)", 1e3),
}
"""Heading of each setting of the scanner in tables and figures, and factor from SI."""


@dataclass(frozen=True)
class Acquisitions:
    """Sequences of a baseline protocol, and of protocols that differ from it in one setting.

    settings: baseline value of each varied setting by its heading ("SNR", "slice thickness (mm)"); baseline:
    comparisons, one per sequence; varied: comparisons of the other protocols by heading and value. Raises InputError
    for a protocol without sequences, and for a varied setting without a baseline value.
    """

    settings: Mapping[str, float]
    baseline: Sequence[Comparison]
    varied: Mapping[str, Mapping[float, Sequence[Comparison]]]

    def __post_init__(self) -> None:
        for heading in self.varied:
            if heading not in self.settings:
                raise InputError(
                    f"acquisitions: {heading} is varied but has no baseline value; "
                    "expected a number: add it to the settings"
                )
        for label, comparisons in self.rows().items():
            if not comparisons:
                raise InputError(
                    f"acquisitions: {label} has no sequences; expected at least one: "
                    "add a sequence or remove the protocol"
                )

    @classmethod
    def of(
        cls,
        settings: Mapping[str, float],
        tried: Sequence[tuple[str, float] | None],
        comparisons: Iterable[Comparison],
    ) -> "Acquisitions":
        """Group the comparisons by ``tried``: a setting of the scanner and its value, or None for the baseline.

        settings: baseline values (SI) by the names of the scanner settings.
        """
        baseline: list[Comparison] = []
        varied: dict[str, dict[float, list[Comparison]]] = {}
        for protocol, comparison in zip(tried, comparisons, strict=True):
            if protocol is None:
                baseline.append(comparison)
            else:
                heading, value = _heading_and_value(*protocol)
                varied.setdefault(heading, {}).setdefault(value, []).append(comparison)
        return cls(
            dict(_heading_and_value(name, value) for name, value in settings.items()), baseline, varied
        )

    def rows(self) -> dict[str, Sequence[Comparison]]:
        """Return the comparisons of each protocol, the baseline first."""
        varied = {
            f"{heading} {value:g}": by_value[value]
            for heading, by_value in self.varied.items()
            for value in sorted(by_value)
        }
        return {"baseline": self.baseline, **varied}

    def course(self, heading: str) -> dict[float, Sequence[Comparison]]:
        """Return the comparisons by the value of one setting in ascending order, including the baseline."""
        return dict(sorted({**self.varied[heading], self.settings[heading]: self.baseline}.items()))


def _heading_and_value(setting: str, value: float) -> tuple[str, float]:
    """Return heading and value, in the unit of the heading, of a setting of the scanner."""
    heading, factor = HEADINGS.get(setting, (setting.replace("_", " "), 1.0))
    return heading, round(factor * value, 9)


def percent_errors(comparisons: Sequence[Comparison]) -> dict[str, Floats]:
    """Return the error (N,) of each observation per sequence [%], negative for an underestimated size."""
    errors = [comparison.observation_errors() for comparison in comparisons]
    return {name: 100.0 * np.array([error[name] for error in errors]) for name in errors[0]}


def strain_errors(comparisons: Sequence[Comparison]) -> Floats:
    """Return registered less true strain (N, 3, 16) at end systole [% strain]."""
    return 100.0 * np.array([comparison.strain_error_at_end_systole() for comparison in comparisons])
