"""Files of Python that declare mechanisms: run only where somebody names them on the command line."""

import sys
from collections.abc import Iterable
from importlib.util import module_from_spec, spec_from_file_location
from pathlib import Path
from traceback import extract_tb

from heartfit.errors import InputError
from heartfit.mechanism import registered


def run_mechanism_files(paths: Iterable[Path]) -> list[str]:
    """Run the files, which register what they declare; the names of the mechanisms that are new.

    Raises InputError for a missing file, one that fails, with the line, and one that registers nothing.
    """
    return [name for path in paths for name in _run(path)]


def _run(path: Path) -> list[str]:
    if not path.is_file() or path.suffix != ".py":
        raise InputError(
            f"{path}: no file of Python; expected one that declares a mechanism: correct the path"
        )
    known = registered()
    try:
        _import(path)
    except Exception as problem:  # whatever a file may raise that is not ours
        raise InputError(f"{path}{_line(path, problem)}: {type(problem).__name__}: {problem}") from problem
    new = [name for name in registered() if name not in known]
    if not new:
        raise InputError(f"{path}: declares no mechanism; expected a class under @mechanism")
    return new


def _import(path: Path) -> None:
    spec = spec_from_file_location(f"_mechanism_{path.stem}", path)
    if spec is None or spec.loader is None:
        raise ImportError("not to be imported")
    module = module_from_spec(spec)
    sys.modules[module.__name__] = module  # dataclasses ask it for the names of annotations
    spec.loader.exec_module(module)


def _line(path: Path, problem: Exception) -> str:
    """Where in the file it went wrong."""
    lines = [each.lineno for each in extract_tb(problem.__traceback__) if each.filename == str(path)]
    return f", line {lines[-1]}" if lines else ""
