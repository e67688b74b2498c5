"""Fit a cardiac model to a heart, simulate it, and diagnose what the fitted model lacks: ``import heartfit as hf``.

``__init__.pyi`` lists the public names for type checkers, editors and this module, which imports each of them as it is
first used: ``import heartfit`` and the command line start at once. docs/python.md documents them.
"""

import os
import re
from functools import cache
from importlib import import_module
from pathlib import Path

from heartfit.core.kernel_cache import kernel_folder

if "NUMBA_CACHE_DIR" not in os.environ:  # numba reads it on import; the jobs of a workflow inherit it
    os.environ["NUMBA_CACHE_DIR"] = str(kernel_folder(Path(__file__).parent))

_LISTED = re.compile(r"^from (heartfit\.\S+) import (\w+) as (\w+)$", re.MULTILINE)


@cache
def _public_names() -> dict[str, tuple[str, str]]:
    """Module and name there of every public name."""
    listed = Path(__file__).with_suffix(".pyi").read_text(encoding="utf-8")
    return {name: (module, there) for module, there, name in _LISTED.findall(listed)}


def __getattr__(name: str) -> object:
    """Import a public name; raises AttributeError for another one."""
    if name == "mechanisms":
        return import_module("heartfit.mechanisms")
    if name not in _public_names():
        raise AttributeError(f"heartfit has no {name}; dir(heartfit) lists its public names")
    module, there = _public_names()[name]
    globals()[name] = value = getattr(import_module(module), there)
    return value


def __dir__() -> list[str]:
    return sorted([*_public_names(), "mechanisms"])
