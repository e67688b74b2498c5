"""PEtab Select loads the tried models and selects the same model by our criterion."""

import json
import warnings
from dataclasses import asdict

import pytest
import yaml

from heartfit.cli import main as cli
from heartfit.discovery.inference.decide import DEFAULT_RULES
from heartfit.discovery.sphere_model.cause import Diagnosis, FittedModel
from heartfit.io.causes import write_cause
from heartfit.results.model_space import best_model, models_by_evidence, models_by_likelihood

with warnings.catch_warnings():
    warnings.simplefilter("ignore")
    from petab_select import Models, Problem, ui


def tried(leak: float, delay: float, both: float | None = None) -> tuple[FittedModel, ...]:
    """Baseline with the ln evidence 0, singles and a pair with the given ones."""
    pair = () if both is None else (FittedModel(("CatheterDelay", "MitralRegurgitation"), both, 75.0, 25),)
    singles = (
        FittedModel(("MitralRegurgitation",), leak, 80.0, 24),
        FittedModel(("CatheterDelay",), delay, 86.0, 24),
    )
    return (FittedModel((), 0.0, 90.0, 23), *singles, *pair)


def exported(folder, models):
    card = Diagnosis("named", (), (), "", (), 0, 0.8, DEFAULT_RULES.detected, tried=models, samples=130)
    write_cause(folder / "cause" / "cause.json", card, (), "0123")
    assert cli.main(["petab-select", str(folder / "cause"), "-o", str(folder / "space")]) == 0
    return folder / "space"


def searched(folder, criteria, criterion=None):
    """Model at which a forward search of the calibrated models ends."""
    problem = Problem.from_yaml(folder / "problem.yaml")
    calibrated, space, ended = Models.from_yaml(folder / criteria, problem=problem), None, False
    while not ended:
        begun = ui.start_iteration(
            problem, candidate_space=space, criterion=criterion, user_calibrated_models=calibrated
        )
        assert not begun["uncalibrated_models"]
        iteration = ui.end_iteration(problem, begun["candidate_space"], calibrated_models=Models())
        space, ended = iteration["candidate_space"], iteration["terminate"]
    return ui.get_best(problem, problem.state.models, criterion=criterion).model_id


@pytest.mark.filterwarnings("ignore")
@pytest.mark.parametrize(
    ("models", "choice"),
    [
        (tried(4.9, 3.0), "none"),
        (tried(5.1, 3.0), "MitralRegurgitation"),
        (tried(30.0, 12.0, 36.9), "MitralRegurgitation"),
        (tried(30.0, 12.0, 37.1), "CatheterDelay_and_MitralRegurgitation"),
    ],
)
def test_a_forward_search_selects_the_same_model_as_the_thresholds(tmp_path, capsys, models, choice):
    folder = exported(tmp_path, models)
    assert f"{choice} has the lowest criterion, the verdict is named" in capsys.readouterr().out
    assert searched(folder, "evidence.yaml") == choice


@pytest.mark.filterwarnings("ignore")
def test_a_model_search_by_other_criteria_is_possible(tmp_path):
    folder = exported(tmp_path, tried(4.0, 3.0))
    assert searched(folder, "likelihood.yaml", "BIC") == "MitralRegurgitation"


def test_criteria_are_their_formulas():
    none, *_ = models_by_likelihood(tried(1.0, 1.0), 130)
    assert none["criteria"]["AIC"] == 2 * 23 + 2 * 90.0
    assert none["criteria"]["BIC"] == pytest.approx(23 * 4.867534 + 180.0)
    leak = models_by_evidence(tried(7.0, 1.0), 5.0)[1]
    assert leak["criteria"] == {"NLLH": -2.0}
    assert best_model(models_by_evidence(tried(7.0, 1.0), 10.0)) == "none"


def test_a_card_of_an_old_format_is_refused_in_one_line(tmp_path, capsys):
    card = Diagnosis("none", (), (), "", (), 0, 0.8, DEFAULT_RULES.detected)
    write_cause(tmp_path / "cause.json", card, (), "0123")
    assert cli.main(["petab-select", str(tmp_path)]) == 2
    assert "holds no models" in capsys.readouterr().err


def test_files_are_the_same_to_the_byte_and_hold_every_model(tmp_path):
    folder = exported(tmp_path, tried(7.0, 3.0, 8.0))
    before = {path: path.read_bytes() for path in folder.rglob("*.*") if path.is_file()}
    exported(tmp_path, tried(7.0, 3.0, 8.0))
    assert before == {path: path.read_bytes() for path in folder.rglob("*.*") if path.is_file()}
    stored = json.loads((tmp_path / "cause" / "cause.json").read_text())["tried"]
    assert stored == json.loads(json.dumps([asdict(model) for model in tried(7.0, 3.0, 8.0)]))
    assert len(yaml.safe_load((folder / "evidence.yaml").read_text())) == 4
