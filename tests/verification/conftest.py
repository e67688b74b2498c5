"""The published slab, if this machine has its data."""

from pathlib import Path

import pytest

NIEDERER = "../shared/data/niederer2011/chaste_activation_time_h0.05_dt0.01.dat"
DESELECTED = pytest.StashKey[int]()


@pytest.fixture(scope="session")
def published_slab() -> Path:
    return _published_slab()


def _published_slab() -> Path:
    return Path(__file__).parents[2] / NIEDERER


def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    """Deselect the tests that need the data if it is missing; the summary gives the reason."""
    if _published_slab().is_file():
        return
    needing = [item for item in items if "published_slab" in getattr(item, "fixturenames", ())]
    items[:] = [item for item in items if item not in needing]
    config.hook.pytest_deselected(items=needing)
    config.stash[DESELECTED] = len(needing)


def pytest_terminal_summary(terminalreporter: pytest.TerminalReporter, config: pytest.Config) -> None:
    if count := config.stash.get(DESELECTED, 0):
        terminalreporter.write_line(f"{count} tests of the published slab deselected: there is no {NIEDERER}")
