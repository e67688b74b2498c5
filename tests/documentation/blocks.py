"""Blocks of code of a page, run one after the other in a separate folder.

A block of Python whose first line names a file is written there; any other runs. In a block of console a line that
begins with $ is a command, and what stands below is what it prints, but for the numbers. What is neither run here nor
elsewhere says so in a comment of the page just above it:

    <!-- run by tests/one_test.py -->   or   <!-- not run: it takes hours -->

and a page of which all is run elsewhere says so once: <!-- every block is run by tests/one_test.py -->
"""

import os
import re
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).parents[2]
FENCE = re.compile(r"^(<!-- [^\n]* -->\n)?(?:\n)?^```(\w*)\n(.*?)^```$", re.MULTILINE | re.DOTALL)
COMMAND = re.compile(r"heartfit |snakemake |python3? |\.venv/bin/|git |pip |apt-get ")
ELSEWHERE = re.compile(r"^<!-- every block is (run by .*) -->$", re.MULTILINE)
FILE = re.compile(r"# (\w+\.py)\n")
NUMBER = re.compile(r"[-+]?\d[\d.]*(e[-+]?\d+)?")


@dataclass(frozen=True)
class Block:
    """Code of a fence, its language, and the comment above it."""

    language: str
    code: str
    remark: str

    @property
    def run_here(self) -> bool:
        """Python and console, unless a comment says something else."""
        return self.language in ("python", "console") and not self.remark

    @property
    def silent(self) -> bool:
        """True for a command-like block without a remark on where it is run."""
        command = self.language == "console" or COMMAND.match(self.code) is not None
        return command and not self.remark and not (self.run_here and self.code.startswith("$ "))


def blocks_of(page: Path) -> list[Block]:
    """The blocks of a page in their order."""
    text = page.read_text(encoding="utf-8")
    elsewhere = [f"<!-- {remark} -->" for remark in ELSEWHERE.findall(text)]
    return [
        Block(language, code, *elsewhere or [remark.strip()])
        for remark, language, code in FENCE.findall(text)
    ]


def pages_of(folder: str) -> list[Path]:
    """The pages below a folder, without the copies that a site is built of."""
    return [
        page
        for page in sorted((ROOT / folder).rglob("*.md"))
        if ROOT / "docs" / "studies" not in page.parents
    ]


def carry_out(page: Path, folder: Path) -> None:
    """Run the blocks of a page that are run here; raises AssertionError that names the first one that fails."""
    for block in blocks_of(page):
        if block.run_here:
            (_python if block.language == "python" else _console)(block.code, folder)


def _python(code: str, folder: Path) -> None:
    named = FILE.match(code)
    script = folder / (named[1] if named else "block.py")
    script.write_text(code, encoding="utf-8")
    if not named:
        _run([sys.executable, script.name], folder)


def _console(code: str, folder: Path) -> None:
    for part in re.split(r"^\$ ", code, flags=re.MULTILINE)[1:]:
        command, _, expected = part.partition("\n")
        output = _run(["bash", "-c", command], folder)
        assert NUMBER.sub("#", output) == NUMBER.sub("#", expected), f"{command}: prints\n{output}"


def _run(command: list[str], folder: Path) -> str:
    places = {
        "PATH": f"{Path(sys.executable).parent}{os.pathsep}{os.environ['PATH']}",
        "PYTHONPATH": str(ROOT / "src"),
    }
    run = subprocess.run(command, cwd=folder, env=os.environ | places, capture_output=True, text=True)
    assert run.returncode == 0, f"{command[-1]}:\n{run.stdout}{run.stderr}"
    return run.stdout
