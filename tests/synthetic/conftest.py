"""The mesh of the average wall that tests deform."""

import numpy as np
import pytest

from heartfit.synthetic.volunteer import Template


def built(*size: float) -> Template:
    """A coarse template, which loses less on the way to these shapes than the study's to its own."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("heartfit.synthetic.volunteer.TEMPLATE_ANGLE", np.deg2rad(9.0))
        return Template.build(*size)


@pytest.fixture(scope="session")
def template() -> Template:
    return built(0.02, 1.4e-3)
