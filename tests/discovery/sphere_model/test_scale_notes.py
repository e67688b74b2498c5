"""A scale that keeps a mechanism from being found is told."""

from dataclasses import dataclass

import pytest

import heartfit as hf
from heartfit.core.parameter import redeclared
from heartfit.discovery.sphere_model import forward_model as library
from heartfit.discovery.sphere_model import searched_recording
from heartfit.discovery.sphere_model.diagnose import diagnose
from heartfit.roles import Stenosis, mechanism, registry

pytestmark = pytest.mark.usefixtures("coarse_search")


def test_a_scale_that_hides_a_mechanism_is_told(monkeypatch: pytest.MonkeyPatch) -> None:
    """A stenosis of ten scales leads before mitral dynamics only where its scale is four times as large."""
    monkeypatch.setattr(registry, "_REGISTRY", dict(registry.registered()))

    @mechanism
    @dataclass(frozen=True)
    class NarrowStenosis(Stenosis):
        """Mitral stenosis with a fifth of its scale."""

        valve = "mitral"
        reference_flow = 2e-4
        gradient: float = redeclared(
            Stenosis, "gradient", 250.0, symbol="G_{mi}", meaning="loss at 200 mL/s", scale=100.0
        )

    names = ("NarrowStenosis", "MitralDynamics")
    monkeypatch.setattr(
        searched_recording,
        "candidates",
        lambda model: {name: library.candidates(model)[name] for name in names},
    )
    ill = hf.adult() + hf.mechanisms.MitralStenosis(gradient=1000.0)
    found = diagnose(hf.measure(hf.simulate(ill), volume_noise=0.01))
    assert (found.verdict, found.mechanisms[0].name) == ("named", "MitralDynamics")
    assert any(
        line.startswith("the finding depends on the scale of NarrowStenosis: MitralDynamics (")
        and "; with 4 times this scale NarrowStenosis (" in line
        for line in found.warnings
    )
