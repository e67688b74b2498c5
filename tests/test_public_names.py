"""The public names of ``import heartfit``: listed once, imported on first use, and no slower to start."""

import ast
import subprocess
import sys

import pytest

import heartfit
from tests.sources import PACKAGE

HEAVY = {"numba", "numpy", "pandas", "scipy"}


def loaded_after(statement):
    """Modules that an interpreter has loaded after a statement."""
    code = f"{statement}\nimport sys\nprint(*sys.modules)"
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    return set(run.stdout.split())


def test_every_listed_name_can_be_imported():
    values = {name: getattr(heartfit, name) for name in dir(heartfit)}
    assert len(values) > 45
    assert None not in values.values()
    assert values["adult"]().parameters()["tissue.active.sigma_0"] == 190e3


def test_type_checkers_see_the_names_that_exist():
    stub = ast.parse((PACKAGE / "__init__.pyi").read_text())
    listed = {alias.asname for node in stub.body if isinstance(node, ast.ImportFrom) for alias in node.names}
    assert sorted(listed) == dir(heartfit)


def test_import_heartfit_loads_no_library():
    assert HEAVY & loaded_after("import heartfit; dir(heartfit)") == set()
    assert "pandas" not in loaded_after("import heartfit; heartfit.simulate(heartfit.adult())")


def test_an_unknown_name_is_refused():
    with pytest.raises(AttributeError, match=r"heartfit has no simulat; dir\(heartfit\)"):
        heartfit.simulat  # noqa: B018


def test_mechanisms_are_those_of_the_registry():
    from heartfit.mechanisms.mitral_regurgitation import MitralRegurgitation

    assert heartfit.mechanisms.MitralRegurgitation is MitralRegurgitation
    assert "MitralRegurgitation" in dir(heartfit.mechanisms)
    with pytest.raises(AttributeError, match="did you mean MitralRegurgitation"):
        heartfit.mechanisms.MitralRegurgitaton  # noqa: B018
