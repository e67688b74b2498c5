"""The fingerprint follows imports."""

import pytest

from heartfit.io import fingerprint as module


@pytest.fixture
def package(tmp_path, monkeypatch):
    """Package in which a imports b.c, which imports d; no module imports e."""
    folder = tmp_path / "small"
    texts = {
        "__init__.py": "",
        "a.py": "from small.b import c\n",
        "b/__init__.py": "",
        "b/c.py": "import numpy\nfrom small.d import x\n",
        "d.py": "x = 1\n",
        "e.py": "",
    }
    for name, text in texts.items():
        path = folder / name
        path.parent.mkdir(exist_ok=True, parents=True)
        path.write_text(text)
    (tmp_path / "script.py").write_text("from small.a import c\n")
    monkeypatch.setattr(module, "PACKAGE", folder)
    module._imported.cache_clear()
    yield folder
    module._imported.cache_clear()


def test_the_modules_below_a_script(package):
    modules = {
        path.relative_to(package).as_posix() for path in module.modules_below(package.parent / "script.py")
    }
    assert modules == {"__init__.py", "a.py", "b/__init__.py", "b/c.py", "d.py"}


@pytest.mark.parametrize(("edited", "changes"), [("d.py", True), ("b/__init__.py", True), ("e.py", False)])
def test_the_fingerprint_changes_only_with_the_modules_below(package, edited, changes):
    before = module.fingerprint(package.parent / "script.py")
    (package / edited).write_text("y = 2\n")
    assert (module.fingerprint(package.parent / "script.py") != before) is changes
