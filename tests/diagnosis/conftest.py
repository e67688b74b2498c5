"""A library small enough for a unit test."""

from collections.abc import Iterator

import pytest

from heartfit.diagnosis import case, library
from heartfit.diagnosis.twin import Twin

FEW = ("CatheterDelay", "CatheterOffset", "ImageShrinkage", "MitralRegurgitation")


@pytest.fixture(scope="session")
def few_mechanisms() -> Iterator[None]:
    """The search among four mechanisms instead of all."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(case, "candidates", few)
        yield


def few(twin: Twin) -> dict[str, library.Candidate]:
    return {name: each for name, each in library.candidates(twin).items() if name in FEW}
