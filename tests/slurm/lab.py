"""A real SLURM of one node on this machine: munge, controller and node daemon, started by hand.

Needs root and Debian's packages slurm-wlm and munge, which are installed if they are absent. Everything it writes lies
in one folder, but for the link that stands in for SLURM's configuration while the lab is up.
"""

import os
import shutil
import signal
import socket
import subprocess
import time
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path
from string import Template

PROGRAMS = ("munged", "slurmctld", "slurmd", "sbatch", "srun", "squeue")
PORTS = {"controller_port": 16817, "node_port": 16818}
CONFIGURATION = Path(__file__).with_name("slurm.conf")
PLACE = Path("/etc/slurm/slurm.conf")
"""Default configuration of SLURM; the executor removes SLURM_CONF, which could name another, from its jobs."""
READY = ("idle", "mixed", "allocated")


class LabError(RuntimeError):
    """SLURM is not available."""


def install() -> None:
    """Fetch SLURM from Debian unless it is there; raises LabError if that cannot be."""
    if all(map(shutil.which, PROGRAMS)):
        return
    if os.geteuid() != 0 or not shutil.which("apt-get"):
        raise LabError(
            f"no SLURM here ({', '.join(PROGRAMS)}) and none to be had: expected root on Debian or Ubuntu"
        )
    quiet = os.environ | {"DEBIAN_FRONTEND": "noninteractive"}
    for command in (["update"], ["install", "--yes", "--no-install-recommends", "slurm-wlm", "munge"]):
        subprocess.run(["apt-get", "--quiet=2", *command], env=quiet, check=True, stdout=subprocess.DEVNULL)


def physical_memory() -> int:
    """Memory of the machine [MB]."""
    return os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES") // 2**20


class Lab:
    """Daemons of SLURM and faults of them; `folder` holds keys, state, spool and logs.

    cpus: how many jobs of one thread run at once. The node has nine tenths of the machine's memory: a group that is
    tried again asks for twice as much.
    """

    def __init__(self, folder: Path, cpus: int) -> None:
        if os.geteuid() != 0:
            raise LabError("munge and SLURM's daemons are started as root; this is somebody else")
        self.folder, self.host = folder, socket.gethostname().split(".")[0]
        self.munged: subprocess.Popen[bytes] | None = None
        for name in ("munge", "state", "spool"):
            (folder / name).mkdir(parents=True, mode=0o755)
        folder.chmod(0o755)  # munge refuses a folder that others may write, and must enter it itself
        stated = {
            "host": self.host,
            "folder": folder,
            "cpus": cpus,
            "memory": physical_memory() * 9 // 10,
            **PORTS,
        }
        (folder / "slurm.conf").write_text(Template(CONFIGURATION.read_text()).substitute(stated))

    def up(self) -> None:
        """Start all daemons and wait until the node takes jobs; raises LabError where a SLURM is configured."""
        if PLACE.exists():
            raise LabError(f"{PLACE} exists: this machine has a SLURM of its own, which is left alone")
        PLACE.parent.mkdir(exist_ok=True)
        PLACE.unlink(missing_ok=True)  # a link to a removed lab
        PLACE.symlink_to(self.folder / "slurm.conf")
        self._start_munge()
        self.run("slurmctld")
        await_that(lambda: "UP" in self.ask("scontrol", "ping"), "a controller that answers")
        self.start_node()

    def down(self) -> None:
        """Stop all daemons and take the link away."""
        for daemon in ("slurmd", "slurmctld"):
            self.kill(daemon, signal.SIGTERM)
        if self.munged is not None:
            self.munged.terminate()
            self.munged.wait()
        PLACE.unlink(missing_ok=True)

    def start_node(self) -> None:
        """Start the node daemon, as after a reboot, and wait until the node takes jobs."""
        self.run("slurmd", "-b", "-N", self.host)
        await_that(lambda: self.node_state() in READY, "a node that takes jobs")

    def lose_node(self) -> None:
        """Cut the power: the daemon ends with all that ran below it; returns when the controller has noticed."""
        ran = [process for job in self.jobs() for process in self.processes(job)]
        self.kill("slurmd")
        for process in (*stepping(), *ran):
            end(process)
        await_that(lambda: self.node_state().startswith("down"), "a node that is given up", 120.0)

    def kill_job(self, job: int) -> None:
        """Send SIGKILL to all processes of a job, as a kernel does that is out of memory."""
        for process in self.processes(job):
            end(process)

    def kill(self, daemon: str, how: signal.Signals = signal.SIGKILL) -> None:
        """Send a signal to slurmd or slurmctld, and wait until it is gone."""
        file = self.folder / f"{daemon}.pid"
        if not file.exists():
            return
        process = int(file.read_text())
        end(process, how)
        await_that(lambda: not Path(f"/proc/{process}").exists(), f"{daemon}'s end")
        file.unlink(missing_ok=True)

    def node_state(self) -> str:
        """State of the node from sinfo; a trailing * means that the node does not answer."""
        return self.ask("sinfo", "--noheader", "--Format", "StateLong").strip()

    def jobs(self, state: str = "RUNNING") -> list[int]:
        """Numbers of the jobs in a state."""
        return [
            int(text)
            for text in self.ask("squeue", "--noheader", "--states", state, "--format", "%A").split()
        ]

    def processes(self, job: int) -> list[int]:
        """Processes that SLURM assigns to a job."""
        lines = self.ask("scontrol", "listpids", str(job)).splitlines()[1:]
        return [int(line.split()[0]) for line in lines if int(line.split()[0]) > 1]

    def states(self) -> dict[int, str]:
        """States of all jobs, running and ended."""
        lines = self.ask("squeue", "--noheader", "--states", "all", "--format", "%A %T").splitlines()
        return {int(number): state for number, state in map(str.split, lines)}

    def run(self, *command: str) -> None:
        """Carry out a command of SLURM."""
        subprocess.run(command, check=True)

    def ask(self, *command: str) -> str:
        """Output of a command of SLURM, whether or not it succeeds."""
        return subprocess.run(command, capture_output=True, text=True, check=False).stdout

    def _start_munge(self) -> None:
        munge = self.folder / "munge"
        (munge / "key").write_bytes(os.urandom(1024))
        for path in (munge / "key", munge):
            shutil.chown(path, "munge", "munge")
        (munge / "key").chmod(0o400)
        files = {
            "socket": "socket",
            "key-file": "key",
            "pid-file": "pid",
            "seed-file": "seed",
            "log-file": "log",
        }
        options = [f"--{option}={munge / name}" for option, name in files.items()]
        with (self.folder / "munged.log").open("wb") as log:  # its output in the foreground
            command = ["munged", "--foreground", *options]
            self.munged = subprocess.Popen(command, user="munge", group="munge", stderr=log)
        await_that((munge / "socket").exists, "munge's socket")


def await_that(holds: Callable[[], bool], what: str, seconds: float = 30.0) -> None:
    """Wait until something holds; raises LabError if it never does."""
    limit = time.monotonic() + seconds
    while not holds():
        if time.monotonic() > limit:
            raise LabError(f"waited {seconds:g} s for {what}")
        time.sleep(0.2)


def stepping() -> list[int]:
    """Processes between the node daemon and a job."""
    lines = [(file.parent.name, file.read_bytes()) for file in Path("/proc").glob("[0-9]*/cmdline")]
    return [int(process) for process, line in lines if line.startswith(b"slurmstepd: [")]


def end(process: int, how: signal.Signals = signal.SIGKILL) -> None:
    """Send a signal to a process that may be gone."""
    with suppress(ProcessLookupError):
        os.kill(process, how)
