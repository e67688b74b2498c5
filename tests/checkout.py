"""Copy of the project that a test may break, with the compiled kernels of the project.

numba takes a kernel for compiled where it finds one of a source of the same size and date, in a folder that is named
after the source's. A copy keeps sizes and dates, so it need not compile for most of a minute what is there already.
"""

import os
import shutil
from importlib.util import module_from_spec, spec_from_file_location
from pathlib import Path

from numba.core.caching import _CacheLocator

ROOT = Path(__file__).parents[1]
PARTS = ("Snakefile", "config", "docs/templates", "profiles", "resources", "src", "workflow")
PACKAGE = Path("src") / "heartfit"


def copy_project(folder: Path, root: Path = ROOT) -> None:
    """Copy what a study needs into a folder; the measured heart and caches of Python are left out."""
    folder.mkdir(parents=True, exist_ok=True)
    for part in PARTS:
        if (root / part).is_dir():
            ignored = shutil.ignore_patterns("__pycache__", "bivme_patient1")
            shutil.copytree(root / part, folder / part, ignore=ignored)
        else:
            shutil.copy2(root / part, folder / part)
    source, target = root / PACKAGE, folder / PACKAGE
    for package in (target, *(path for path in target.rglob("*") if path.is_dir())):
        compiled = kernels_of(source, source / package.relative_to(target))
        if compiled.exists():
            shutil.copytree(compiled, kernels_of(target, package))


def kernels_of(package: Path, folder: Path) -> Path:
    """Folder in which numba keeps the kernels of one folder of a package."""
    return folder_of_kernels(package) / str(_CacheLocator.get_suitable_cache_subpath(str(folder / "any.py")))


def folder_of_kernels(package: Path) -> Path:
    """Kernel folder of the package, without importing the package: that would set NUMBA_CACHE_DIR to this project's."""
    spec = spec_from_file_location("kernel_cache", ROOT / PACKAGE / "core" / "kernel_cache.py")
    assert spec is not None
    assert spec.loader is not None
    module = module_from_spec(spec)
    spec.loader.exec_module(module)
    return Path(module.kernel_folder(package))


def environment_of(folder: Path) -> dict[str, str]:
    """Environment of processes that run the copy in a folder, with separate kernels."""
    return {name: value for name, value in os.environ.items() if name != "NUMBA_CACHE_DIR"} | {
        "PYTHONPATH": str(folder / "src")
    }
