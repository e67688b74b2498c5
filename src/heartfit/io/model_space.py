"""A search as a problem of PEtab Select: files that it loads and searches again."""

from pathlib import Path
from typing import Any

import yaml

from heartfit.diagnosis.cause import Tried
from heartfit.errors import InputError
from heartfit.exchange.model_space import PROBLEM, by_evidence, by_likelihood, chosen, model_space, parameters
from heartfit.io.atomic import write_text
from heartfit.io.causes import read_cause

PETAB = {
    "format_version": 1,
    "parameter_file": "parameters.tsv",
    "problems": [{"sbml_files": [], "condition_files": [], "measurement_files": [], "observable_files": []}],
}
"""The simulator is not SBML: the problem declares parameters only."""


def write_model_space(folder: Path, cause: Path) -> str:
    """Write the models that a cause.json tells of; what is chosen of them, and what the verdict was, in a sentence.

    Raises InputError for a missing or broken file, and for one without the models.
    """
    said = read_cause(cause)
    tried = [Tried(**each | {"effects": tuple(each["effects"])}) for each in said.get("tried", ())]
    if not tried:
        raise InputError(
            f"{cause}: holds no models; expected those that were tried: diagnose the recording again"
        )
    evidence = by_evidence(tried, said["threshold"])
    _write_yaml(folder / "problem.yaml", PROBLEM)
    _write_rows(folder / "model_space.tsv", model_space(tried))
    _write_yaml(folder / "petab" / "problem.yaml", PETAB)
    _write_rows(folder / "petab" / "parameters.tsv", parameters(tried))
    _write_yaml(folder / "evidence.yaml", evidence)
    _write_yaml(folder / "likelihood.yaml", by_likelihood(tried, said["samples"]))
    return (
        f"{len(tried)} models; the least criterion has {chosen(evidence)}, the verdict is {said['verdict']}."
    )


def _write_yaml(path: Path, content: Any) -> None:
    write_text(path, yaml.safe_dump(content, sort_keys=False))


def _write_rows(path: Path, rows: list[list[str]]) -> None:
    write_text(path, "".join("\t".join(row) + "\n" for row in rows))
