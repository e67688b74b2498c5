"""Search of misspecified hearts for tuning: no seed of scoring, and a line that shows departure and ranking."""

import pytest

from benchmarks.misspecified import line, main
from heartfit.synthetic.case import Answer
from heartfit.synthetic.misspecified import Misspecification
from heartfit.synthetic.scoring import Scored
from heartfit.synthetic.trial import ScoredDiagnosis


@pytest.mark.parametrize("first_seed", [100_000, 99_999])
def test_seeds_of_scoring_are_refused(first_seed):
    with pytest.raises(SystemExit, match="reserved for scoring"):
        main([str(first_seed), "2", "0"])


def test_a_line_shows_verdict_departure_and_the_strongest_of_the_ranking():
    departure = Misspecification({"circulation.left_atrium": -1.54}, 2.0, 0.5, 0.2, 0.031)
    answer = Answer(12, "none", (), {}, {}, 0.02, "misspecified", departure)
    finding = ScoredDiagnosis("unknown", ranking={"Scar": 0.1, "Leak": 6.0, "unknown": 8.0, "Kick": 3.0})
    text = line(Scored(answer, finding))
    assert text.startswith("12: nothing -> unknown")
    assert "unknown 8.0 Leak 6.0 Kick 3.0" in text
    assert "Scar" not in text
    assert "31 ms, errors 2 0.5 0.2, left_atrium -1.5" in text
