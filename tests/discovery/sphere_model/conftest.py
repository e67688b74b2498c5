"""A library small enough for a unit test."""

from collections.abc import Iterator

import pytest

from heartfit.discovery.sphere_model import forward_model as library
from heartfit.discovery.sphere_model import searched_recording as case
from heartfit.discovery.sphere_model.forward_model import SphereForwardModel

NAMES = ("CatheterDelay", "CatheterOffset", "ImageShrinkage", "MitralRegurgitation")


@pytest.fixture(scope="module")
def few_mechanisms() -> Iterator[None]:
    """Search among four mechanisms instead of all."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(case, "candidates", few)
        yield


def few(model: SphereForwardModel) -> dict[str, library.Candidate]:
    return {name: candidate for name, candidate in library.candidates(model).items() if name in NAMES}
