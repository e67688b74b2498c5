"""A seal returns its answer, is not legible, and breaks where the answer was changed."""

from dataclasses import replace

import pytest

from heartfit.core.errors import InputError
from heartfit.io.seals import open_seal, seal
from heartfit.synthetic.campaign import Effect
from heartfit.synthetic.case import Answer

EFFECT = Effect("MitralRegurgitation", 3e-5, 0.0, "m^2", 2.0)
ANSWER = Answer(7, "single", (EFFECT,), {"no beat": 1}, {"sigma_0": -0.4}, 0.02)


def test_a_sealed_answer_is_read_back_and_not_legible(tmp_path):
    seal(tmp_path / "7.answer", ANSWER)
    assert open_seal(tmp_path / "7.answer", Answer) == ANSWER
    assert "Regurgitation" not in (tmp_path / "7.answer").read_text()


def test_an_answer_that_was_exchanged_breaks_the_seal(tmp_path):
    for name, answer in (("true", ANSWER), ("false", replace(ANSWER, kind="none", effects=()))):
        seal(tmp_path / name, answer)
    (digest, _), (_, body) = ((tmp_path / name).read_text().split() for name in ("true", "false"))
    (tmp_path / "true").write_text(f"{digest}\n{body}\n")
    with pytest.raises(InputError, match="seal is broken"):
        open_seal(tmp_path / "true", Answer)
