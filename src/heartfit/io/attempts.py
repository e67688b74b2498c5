"""What extensions that nobody named gain, as JSON."""

from dataclasses import fields
from pathlib import Path
from typing import Any

import numpy as np

from heartfit.diagnosis.cause import Attempt, Cause, Gain, Refitted, Trace
from heartfit.io.results import read_result, write_result


def write_attempt(path: Path, attempt: Attempt, fingerprint: str) -> None:
    """Write all of it; an evidence that no search gave becomes null."""
    shallow = {each.name: getattr(attempt, each.name) for each in fields(attempt)}
    write_result(path, shallow, fingerprint, {"sizes": "SI", "traces": "SI"})


def read_attempt(path: Path) -> Attempt:
    """What write_attempt wrote; raises InputError for a missing or broken file."""
    content = read_result(Path(path))
    refitted = content["refitted"]
    sizes = tuple(_cause(each) for each in refitted["extension"])
    return Attempt(
        Refitted(**{**refitted, "extension": sizes}),
        tuple(Gain(**{**each, "interval": tuple(each["interval"])}) for each in content["gain"]),
        tuple(_trace(each) for each in content["traces"]),
    )


def _cause(content: dict[str, Any]) -> Cause:
    factor = content["ln_bayes_factor"]
    known = {"ln_bayes_factor": np.nan if factor is None else factor, "interval": tuple(content["interval"])}
    return Cause(**{**content, **known})


def _trace(content: dict[str, Any]) -> Trace:
    return Trace(content["curve"], **{name: np.array(content[name]) for name in content if name != "curve"})
