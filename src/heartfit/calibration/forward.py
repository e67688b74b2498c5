"""The model as a calibration sees it: parameters in, observations out, and every run counted."""

from collections.abc import Callable, Mapping, Sequence

Outcome = Mapping[str, float] | str
"""Observations by name, or the reason why there are none."""
Forward = Callable[[Sequence[Mapping[str, float]]], list[Outcome]]
"""From the parameters of some simulations, by name and SI, to their outcomes."""


class Counted:
    """A forward model that counts the simulations asked of it."""

    def __init__(self, forward: Forward) -> None:
        self._forward, self.simulations = forward, 0

    def __call__(self, parameters: Sequence[Mapping[str, float]]) -> list[Outcome]:
        self.simulations += len(parameters)
        return self._forward(parameters)


class Remembered:
    """A forward model that runs no parameters twice: hearts of one shape and prior share their sigma points."""

    def __init__(self, forward: Forward) -> None:
        self._forward, self._known = forward, dict[frozenset[tuple[str, float]], Outcome]()

    def __call__(self, parameters: Sequence[Mapping[str, float]]) -> list[Outcome]:
        keys = [frozenset(each.items()) for each in parameters]
        new = {key: each for key, each in zip(keys, parameters, strict=True) if key not in self._known}
        self._known |= zip(new, self._forward(list(new.values())), strict=True)
        return [self._known[key] for key in keys]
