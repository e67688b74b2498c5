"""Simulator that a function of a test replaces, whose neighbouring beats are run one by one."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

from heartfit.core.arrays import Floats
from heartfit.discovery.refit.extension import Extension
from heartfit.discovery.refit.nearby_beats import NearbyBeats, simulate_each


@dataclass(frozen=True)
class OneByOne:
    """Simulator with the beats of ``run``."""

    run: Callable[[Extension, Mapping[str, float]], Any]

    def __call__(self, extension: Extension, parameters: Mapping[str, float]) -> Any:
        return self.run(extension, parameters)

    def nearby(self, extension: Extension, x: Floats) -> NearbyBeats:
        return simulate_each(self, extension, x)
