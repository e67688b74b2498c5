"""A browser with software graphics and nothing else: no network, no profile, the size of a laptop's screen."""

import os
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path

import pytest
from playwright.sync_api import Page, Request, sync_playwright

from heartfit.geometry.mesh import VentricularMesh
from heartfit.io.report import assets
from heartfit.results.report.page import render
from tests.browser.__main__ import browser_path
from tests.results.report.conftest import HOSTILE
from tests.results.report.small_report import study

FLAGS = (
    "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run", "--disable-background-networking",
    "--disable-component-update", "--disable-sync", "--use-angle=swiftshader", "--enable-unsafe-swiftshader",
)  # fmt: skip
SCREEN = {"width": 1366, "height": 768}
REPORTS = [path for path in os.environ.get("REPORTS", "").split(os.pathsep) if path]


@dataclass
class Opened:
    """Report in the browser, with its console errors and its network requests."""

    page: Page
    errors: list[str] = field(default_factory=list)
    requests: list[str] = field(default_factory=list)

    def listen(self) -> None:
        self.page.on("console", lambda line: self.errors.append(line.text) if line.type == "error" else None)
        self.page.on("pageerror", lambda error: self.errors.append(str(error)))
        self.page.on("request", self._ask)

    def _ask(self, request: Request) -> None:
        if not request.url.startswith(("data:", "blob:")):
            self.requests.append(request.url)


@pytest.fixture(scope="session", params=["made up", *REPORTS])
def report(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Page to open: made-up results, then the named reports."""
    if request.param != "made up":
        return Path(request.param).resolve()
    mesh: VentricularMesh = request.getfixturevalue("ventricle")
    path = tmp_path_factory.mktemp("report") / "report.html"
    path.write_text(render(study(mesh, note=HOSTILE), assets()), encoding="utf-8")
    return path


@pytest.fixture(scope="session")
def opened(report: Path, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Opened]:
    """The page, loaded from its file."""
    profile = tmp_path_factory.mktemp("profile")
    with sync_playwright() as playwright:
        context = playwright.chromium.launch_persistent_context(
            profile, executable_path=browser_path(), headless=True, args=FLAGS, viewport=SCREEN
        )
        here = Opened(context.pages[0])
        here.listen()
        here.page.goto(report.as_uri())
        yield here
        context.close()
