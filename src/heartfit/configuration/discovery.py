"""What is done to name the cause of what a simulation gets wrong."""

from pydantic import Field, PositiveFloat, field_validator

from heartfit.catalogue import composed
from heartfit.configuration.fields import Count, Seed
from heartfit.configuration.setting import Element
from heartfit.configuration.strict import Strict


class ElementQuestion(Strict):
    """Whether a setting's misfit is its element's: who explains a heart of the other one, on the generator's mesh."""

    setting: str = Field(default="paper", description="the calibrator")
    element: Element = Field(default="mixed", description="of the hidden heart, and of the rival")
    mechanism: str = Field(default="MitralRegurgitation", description="the other rival, by name")
    period: PositiveFloat = Field(default=0.9, description="s")
    seed: Seed = Field(default=1, description="of the errors of the measurement")

    @field_validator("mechanism")
    @classmethod
    def _mechanism_is_known(cls, name: str) -> str:
        return _known((name,))[0]


class Discovery(Strict):
    """Which cases are searched on the sphere, and which are refitted and proved in three dimensions."""

    settings: tuple[str, ...] = Field(
        default=(), description="whose cases are searched, about ten seconds each"
    )
    cases: tuple[str, ...] = Field(
        default=(), description="that are refitted and proved, about 120 beats each"
    )
    trials: tuple[str, ...] = Field(
        default=(),
        description="mechanisms that these cases are extended by whatever is named, 10 to 20 beats each",
    )
    most_steps: Count = Field(default=20, description="steps of a refit, if it does not settle before")

    element: ElementQuestion = ElementQuestion()

    @field_validator("trials")
    @classmethod
    def _trials_are_known(cls, names: tuple[str, ...]) -> tuple[str, ...]:
        return _known(names)


def _known(names: tuple[str, ...]) -> tuple[str, ...]:
    """The names of mechanisms; raises ValueError for one that there is not."""
    try:
        composed(names)
    except KeyError as unknown:
        raise ValueError(str(unknown.args[0])) from None
    return names
