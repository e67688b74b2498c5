"""Snakemake in forks of one process that has imported it and a library, which takes as long as a dry run itself.

The process reads a folder, a file for output and errors, and arguments from each line, and answers with the exit code.
"""

import gc
import json
import os
import re
import subprocess
import sys
from importlib import import_module
from pathlib import Path


class ForkServer:
    """Runs Snakemake with one library; a context, which ends the process."""

    def __init__(self, library: Path) -> None:
        self.process = subprocess.Popen(
            [sys.executable, __file__],
            env=os.environ | {"PYTHONPATH": str(library)},
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            text=True,
        )

    def __enter__(self) -> "ForkServer":
        return self

    def __exit__(self, *_: object) -> None:
        self.process.kill()
        self.process.communicate()

    def snakemake(self, folder: Path, printed: Path, arguments: tuple[str, ...]) -> int:
        """Run Snakemake in a folder, write output and errors into one file and return the exit code."""
        assert self.process.stdin is not None
        assert self.process.stdout is not None
        self.process.stdin.write(json.dumps([str(folder), str(printed), arguments]) + "\n")
        self.process.stdin.flush()
        return int(self.process.stdout.readline())


def preload() -> None:
    """Import what Snakemake and the workflow import, and parse the library for the fingerprints of the scripts."""
    workflow = Path(__file__).parents[2] / "workflow"
    statements = "".join(file.read_text(encoding="utf-8") for file in workflow.rglob("*.smk"))
    for module in ("snakemake.report.html_reporter", *re.findall(r"^from (heartfit\S*) ", statements, re.M)):
        import_module(module)
    import_module("heartfit.roles").registered()
    for script in (workflow / "scripts").glob("*.py"):
        import_module("heartfit.io.fingerprint").fingerprint(script)


def serve() -> None:
    """Answer each line of the standard input."""
    preload()
    snakemake = import_module("snakemake.cli").main
    gc.freeze()  # the forks share the memory of what is imported, which no collection touches
    for line in sys.stdin:
        child = os.fork()
        if child == 0:
            folder, printed, arguments = json.loads(line)
            os.chdir(folder)
            with Path(printed).open("w") as file:
                os.dup2(file.fileno(), 1)
                os.dup2(file.fileno(), 2)
            try:
                snakemake(arguments)
            except SystemExit as end:
                sys.stdout.flush()
                os._exit(end.code)  # the memory is not freed object by object
        sys.stdout.write(f"{os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])}\n")
        sys.stdout.flush()


if __name__ == "__main__":
    serve()
