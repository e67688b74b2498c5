"""The data with their whitenings, where hypotheses are fitted and judged."""

from dataclasses import dataclass, field

from heartfit.discovery.data import Data
from heartfit.discovery.explanation import Explanation
from heartfit.discovery.forward import Counted
from heartfit.discovery.hypothesis import Hypothesis
from heartfit.discovery.optimise import fit
from heartfit.discovery.rival import Rival
from heartfit.discovery.whitening import Whitening
from heartfit.geometry.arrays import Floats


@dataclass(eq=False)
class Bench:
    """Fits hypotheses to the same data and counts the simulations of all."""

    data: Data
    simulations: int = 0
    whitening: Whitening = field(init=False)
    rival: Rival = field(init=False)

    def __post_init__(self) -> None:
        self.whitening, self.rival = Whitening.of(self.data), Rival.of(self.data)

    def explain(
        self, hypothesis: Hypothesis, start: Floats, slopes: Floats | None = None
    ) -> Explanation | None:
        """The hypothesis fitted from ``start`` (d,), or None where its simulations fail."""
        model = Counted(hypothesis)
        found = fit(model, self.data.values, self.whitening, start, slopes)
        self.simulations += model.runs
        return None if found is None else Explanation.of(found, self.data.values, self.whitening)

    def simulate(self, hypothesis: Hypothesis, x: Floats) -> Floats | None:
        """What the hypothesis predicts (n,) at x (d,), or None."""
        self.simulations += 1
        return hypothesis.forward(x)

    def better(self, old: Explanation, start: Floats) -> Explanation:
        """The old explanation, or one of a lower objective if the fit finds it from ``start``."""
        new = self.explain(old.fit.hypothesis, start)
        return new if new is not None and new.fit.objective < old.fit.objective else old
