"""No user's file is unpickled, evaluated or unpacked, read from the syntax tree."""

import ast
from collections.abc import Iterator

from tests.sources import ROOT, nodes, tree_of

FILES = [*sorted((ROOT / "src").rglob("*.py")), *sorted((ROOT / "workflow").rglob("*.py")), ROOT / "study.py"]

MODULES = {
    "pickle",
    "cPickle",
    "dill",
    "cloudpickle",
    "joblib",
    "marshal",
    "shelve",
    "tarfile",
    "zipfile",
    "imp",
    "runpy",
}
"""Modules whose readers make objects or files from data."""

CALLS = {
    *(
        "eval",
        "exec",
        "compile",
        "__import__",
        "exec_module",
        "system",
        "popen",
        "unpack_archive",
        "extractall",
    ),
    *("read_pickle", "unsafe_load", "full_load", "load_all", "safe_load"),
}
"""yaml.safe_load too: it follows aliases and takes a key twice; heartfit.io.configuration does not."""

HARMLESS = {"re.compile", "platform.system"}

EXCEPTIONS = {"diagnose.py": {"exec_module"}}
"""Exceptions: a file of mechanisms is run if it is named on the command line."""


def name_of(call: ast.Call) -> str:
    """eval, re.compile, self.spec.loader.exec_module: as it is written."""
    return ast.unparse(call.func)


def imported(node: ast.AST) -> list[str]:
    """The modules of which more than an error is imported."""
    if isinstance(node, ast.Import):
        return [alias.name.split(".")[0] for alias in node.names]
    if isinstance(node, ast.ImportFrom) and {alias.name for alias in node.names} != {"BadZipFile"}:
        return [(node.module or "").split(".")[0]]
    return []


def is_dangerous(call: ast.Call, file: str) -> bool:
    name = name_of(call)
    values = {keyword.arg: getattr(keyword.value, "value", None) for keyword in call.keywords}
    return (
        (name.split(".")[-1] in CALLS - EXCEPTIONS.get(file, set()) and name not in HARMLESS)
        or bool(values.get("shell") or values.get("allow_pickle"))
        or name == "yaml.load"
        or (name == "np.load" and values.get("allow_pickle", True) is not False)
        or (name.endswith("Environment") and "autoescape" not in values)
    )


def dangers(tree: ast.Module, file: str) -> Iterator[str]:
    """Dangerous calls and imports of a file, with their lines."""
    for node in nodes(tree):
        yield from (f"line {node.lineno}: imports {name}" for name in imported(node) if name in MODULES)
        if isinstance(node, ast.Call) and is_dangerous(node, file):
            yield f"line {node.lineno}: {name_of(node)}"


def test_no_input_is_evaluated() -> None:
    assert not {str(file): lines for file in FILES if (lines := [*dangers(tree_of(file), file.name)])}


FORBIDDEN = (
    "import pickle",
    "from tarfile import open",
    "eval(text)",
    "exec(text)",
    "yaml.load(text)",
    "yaml.safe_load(text)",
    "np.load(path)",
    "np.load(path, allow_pickle=True)",
    "subprocess.run(text, shell=True)",
    "os.system(text)",
    "Environment()",
    "spec.loader.exec_module(module)",
)


def test_every_forbidden_call_is_reported() -> None:
    assert [text for text in FORBIDDEN if not [*dangers(ast.parse(text), "x.py")]] == []
