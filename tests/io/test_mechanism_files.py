"""Mechanisms from outside the folder: a file that is named, and the entry point of a package."""

import re
from importlib.metadata import EntryPoint
from pathlib import Path

import pytest

from heartfit.cli import main as cli
from heartfit.cli.diagnose import run_mechanism_files
from heartfit.core.errors import InputError
from heartfit.roles import registered, registry

PAGE = Path(__file__).parents[2] / "docs" / "write_a_mechanism.md"
PUMP = re.search(r"```python\n(.*?)```", PAGE.read_text(), re.DOTALL)[1]


@pytest.fixture(autouse=True)
def _own_registry(monkeypatch):
    monkeypatch.setattr(registry, "_REGISTRY", registered())


@pytest.fixture
def pump(tmp_path):
    file = tmp_path / "numpy.py"  # a name that shadows no module
    file.write_text(PUMP)
    return file


def test_a_file_that_is_named_registers_its_mechanisms(pump):
    assert run_mechanism_files([pump]) == ["BalloonPump"]
    assert registered()["BalloonPump"].switch().name == "rise"


def test_a_package_offers_its_own_by_an_entry_point(pump, monkeypatch):
    monkeypatch.syspath_prepend(pump.parent)
    pump.rename(pump.parent / "pump_of_a_package.py")
    offered = [EntryPoint("pumps", "pump_of_a_package", registry.GROUP)]
    monkeypatch.setattr(registry, "entry_points", lambda group: offered)
    registry._import_modules.cache_clear()
    assert "BalloonPump" in registered()
    registry._import_modules.cache_clear()


@pytest.mark.parametrize(
    ("text", "complaint"),
    [
        ("x = 1\ny = x / 0\n", "line 2: ZeroDivisionError: division by zero"),
        ("def f(:\n", "SyntaxError"),
        (PUMP.replace("(Pressure)", ""), "TypeError: BalloonPump plays no role"),
        (PUMP.replace("off=0.0, ", ""), "declares 0 parameters with an off value"),
        ("x = 1\n", "declares no mechanism"),
    ],
)
def test_mistakes_in_a_file_are_reported_in_one_line(tmp_path, capsys, text, complaint):
    file = tmp_path / "mine.py"
    file.write_text(text)
    assert cli.main(["diagnose", "none.csv", "--mechanism", str(file)]) == 2
    message = capsys.readouterr().err
    assert message.startswith(f"heartfit: {file}")
    assert complaint in message
    assert message.count("\n") == 1


@pytest.mark.parametrize("name", ["missing.py", "folder", "mine.txt"])
def test_a_file_that_is_no_python_is_refused(tmp_path, name):
    (tmp_path / "folder").mkdir()
    (tmp_path / "mine.txt").write_text(PUMP)
    with pytest.raises(InputError, match="no file of Python"):
        run_mechanism_files([tmp_path / name])
