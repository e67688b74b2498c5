"""Open the report in headless Chromium as a reader does: python3 study.py browser [REPORT ...].

Without a name the reports of the study and of its coarse run are opened, where they are; always one of made-up results.
"""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

FOLDER = Path(__file__).parent
MADE = ("results/report.html", "results/smoke/report.html")
INSTALL = (
    ("apt-get", "update", "-qq"),
    ("apt-get", "install", "-y", "-qq", "--no-install-recommends", "chromium"),
)


def main(arguments: list[str]) -> int:
    """Find the browser, installing Debian's if need be, and pass the tests of this folder."""
    reports = arguments or [report for report in MADE if Path(report).exists()]
    print(
        f"browser: {chromium()} opens made-up results{''.join(f', {report}' for report in reports)}",
        flush=True,
    )
    os.environ["REPORTS"] = os.pathsep.join(reports)
    return int(pytest.main([str(FOLDER), "-m", "long", "-v"]))


def chromium() -> str:
    """The browser's program; leaves with one line where there is none and none can be installed."""
    if not browser_path() and shutil.which("apt-get") and os.geteuid() == 0:
        print("browser: installs Debian's chromium", flush=True)
        quiet = os.environ | {"DEBIAN_FRONTEND": "noninteractive"}
        for command in INSTALL:
            subprocess.run(command, check=True, env=quiet, stdout=subprocess.DEVNULL)
    program = browser_path()
    if program is None:
        sys.exit(
            "browser: no chromium; expected the program on the path: install it (Debian: apt-get install chromium)"
        )
    return program


def browser_path() -> str | None:
    return shutil.which("chromium") or shutil.which("chromium-browser")


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
