"""What every mechanism offers, whatever its role."""

from abc import ABC
from dataclasses import replace
from typing import Self

from heartfit.parameter import Parameter, parameters_of


class Mechanism(ABC):  # noqa: B024
    """What every mechanism offers, whatever its role."""

    @classmethod
    def switch(cls) -> Parameter:
        """The one parameter that turns the mechanism off; ``TypeError`` if there is not exactly one."""
        switches = [declared for declared in parameters_of(cls) if declared.off is not None]
        if len(switches) != 1:
            raise TypeError(
                f"{cls.__name__} declares {len(switches)} parameters with an off value: expected one"
            )
        return switches[0]

    def turned_off(self) -> Self:
        """The same mechanism at its off value."""
        return replace(self, **{self.switch().name: self.switch().off})  # type: ignore[type-var]
