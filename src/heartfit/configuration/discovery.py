"""What is done to name the cause of what a simulation gets wrong."""

from pydantic import Field, PositiveInt

from heartfit.configuration.strict import Strict


class Discovery(Strict):
    """Which cases are searched on the sphere, and which are refitted and proved in three dimensions."""

    settings: tuple[str, ...] = Field(
        default=(), description="whose cases are searched, about ten seconds each"
    )
    cases: tuple[str, ...] = Field(
        default=(), description="that are refitted and proved, about 100 beats each"
    )
    most_steps: PositiveInt = Field(
        default=3, description="unscented steps of a refit, if it does not settle before"
    )
