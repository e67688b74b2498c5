"""Tables of the searches with and without the right ventricle."""

from benchmarks.right_ventricle import RightTrial, right_hearts_table, right_table
from heartfit.discovery.sphere_model.cause import Cause, Diagnosis


def diagnosed(factor: float, *names: str) -> Diagnosis:
    causes = tuple(Cause(name, factor, 0.2e-4, "m^2", (0.1e-4, 0.3e-4)) for name in names)
    return Diagnosis(
        "named" if names else "none", causes, (), "", (), 7, 0.8, 5.0, {"MitralRegurgitation": factor}
    )


TRIALS = (
    RightTrial(1, "MitralRegurgitation", 2.0, diagnosed(4.0), diagnosed(9.0, "MitralRegurgitation")),
    RightTrial(
        2,
        "MitralRegurgitation",
        2.0,
        diagnosed(8.0, "MitralRegurgitation"),
        diagnosed(11.0, "MitralRegurgitation"),
    ),
    RightTrial(3, "", 0.0, diagnosed(1.0), diagnosed(6.0, "AorticRegurgitation")),
)


def test_a_name_is_right_or_wrong_and_every_name_of_a_sound_heart_is_wrong() -> None:
    sound, ill = right_table(TRIALS).to_dict("records")
    assert sound["effect"] == "none"
    assert (sound["named by the left"], sound["named by both"]) == ("0 right, 0 wrong", "0 right, 1 wrong")
    assert (ill["named by the left"], ill["named by both"]) == ("1 right, 0 wrong", "2 right, 0 wrong")
    assert (ill["ln Bayes factor, left"], ill["ln Bayes factor, both"]) == ("6.0", "10.0")
    assert sound["ln Bayes factor, both"] == "–"


def test_every_heart_has_a_row_with_both_verdicts() -> None:
    rows = right_hearts_table(TRIALS).to_dict("records")
    assert [row["both ventricles"] for row in rows] == ["mitral regurgitation"] * 2 + ["aortic regurgitation"]
    assert rows[0]["left ventricle"] == "`none`"
    assert rows[0]["beats"] == "7, 7"
