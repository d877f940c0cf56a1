"""A SLURM cluster of one node on the loopback interface, with the real daemons, for as long as a test runs."""

import os
import shutil
import socket
import subprocess
import time
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from tempfile import TemporaryDirectory

#: What the cluster consists of; Debian's packages are slurm-wlm and munge.
PROGRAMS = ("munged", "slurmctld", "slurmd", "sbatch", "squeue", "sinfo", "scontrol")

#: Seconds until the node must be idle.
PATIENCE = 30.0

SETTINGS = """
ClusterName=loopback
SlurmctldHost={host}(127.0.0.1)
SlurmUser=root
SlurmctldPort={first}
SlurmdPort={second}
AuthType=auth/munge
AuthInfo=socket={folder}/munge.sock
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd.pid
SlurmctldLogFile={folder}/slurmctld.log
SlurmdLogFile={folder}/slurmd.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
MpiDefault=none
SwitchType=switch/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
NodeName={host} NodeAddr=127.0.0.1 CPUs={cores} State=UNKNOWN
PartitionName=all Nodes={host} Default=YES MaxTime=INFINITE State=UP
"""


def missing() -> str:
    """Why no cluster can be started here; empty where it can."""
    folders = os.environ.get("PATH", "") + ":/usr/sbin:/sbin"
    lacking = [name for name in PROGRAMS if shutil.which(name, path=folders) is None]
    if lacking:
        return f"{', '.join(lacking)} is not installed (Debian: slurm-wlm, munge)"
    return "" if os.geteuid() == 0 else "slurmd needs root"


@contextmanager
def slurm_cluster() -> Iterator[Mapping[str, str]]:
    """Start a cluster and give the environment in which sbatch finds it; stop it at the end."""
    # a short path: the name of a socket has 107 letters at most
    with TemporaryDirectory(prefix="slurm-", dir="/tmp") as name:
        folder = Path(name)
        folder.chmod(0o755)
        environment = os.environ | {
            "SLURM_CONF": str(folder / "slurm.conf"),
            "PATH": os.environ.get("PATH", "") + ":/usr/sbin:/sbin",
        }
        _write(folder)
        _munge(folder, environment)
        try:
            for each in (("slurmctld", "-i", "-c"), ("slurmd",)):
                subprocess.run(each, env=environment, check=True, timeout=PATIENCE, capture_output=True)
            _wait(environment)
            yield environment
        finally:
            subprocess.run(
                ["scontrol", "shutdown"], env=environment, capture_output=True, timeout=PATIENCE, check=False
            )
            for each in ("slurmd.pid", "slurmctld.pid"):
                _end(folder / each)
            _end(folder / "munged.pid", signals=(9,))  # it takes two seconds for a gentle end


def run_array(script: str, folder: Path, environment: Mapping[str, str]) -> None:
    """Submit a script and wait until all of its tasks are done; ``sbatch --wait`` looks every ten seconds only."""

    def said(*command: str) -> list[str]:
        return subprocess.run(
            command, env=environment, cwd=folder, check=True, timeout=PATIENCE, capture_output=True, text=True
        ).stdout.split()

    (job,) = said("sbatch", "--parsable", script)
    end = time.monotonic() + 10 * PATIENCE
    while (states := set(said("squeue", "--noheader", "--states=all", "--format=%T", "--jobs", job))) != {"COMPLETED"}:
        assert time.monotonic() < end and not states & {"FAILED", "CANCELLED", "NODE_FAIL"}, states
        time.sleep(0.1)


def _write(folder: Path) -> None:
    (folder / "state").mkdir()
    (folder / "spool").mkdir()
    key = folder / "munge.key"
    key.write_bytes(os.urandom(1024))
    key.chmod(0o400)
    host = socket.gethostname().split(".")[0]
    first, second = _free_ports()
    text = SETTINGS.format(host=host, folder=folder, first=first, second=second, cores=os.cpu_count() or 1)
    (folder / "slurm.conf").write_text(text, encoding="utf-8")


def _free_ports() -> tuple[int, int]:
    with socket.socket() as one, socket.socket() as other:
        one.bind(("127.0.0.1", 0))
        other.bind(("127.0.0.1", 0))
        return one.getsockname()[1], other.getsockname()[1]


def _munge(folder: Path, environment: Mapping[str, str]) -> None:
    names = {"key-file": "munge.key", "socket": "munge.sock", "pid-file": "munged.pid", "log-file": "munged.log",
             "seed-file": "munge.seed"}  # fmt: skip
    options = [f"--{option}={folder / file}" for option, file in names.items()]
    subprocess.run(["munged", "--force", *options], env=environment, check=True, timeout=PATIENCE, capture_output=True)


def _wait(environment: Mapping[str, str]) -> None:
    end = time.monotonic() + PATIENCE
    while time.monotonic() < end:
        told = subprocess.run(["sinfo", "-h", "-o", "%T"], env=environment, capture_output=True, text=True, check=False)
        if told.stdout.strip() == "idle":
            return
        time.sleep(0.2)
    raise TimeoutError("the node of the SLURM cluster did not become idle")


def _end(file: Path, signals: tuple[int, ...] = (15, 9)) -> None:
    """End a daemon by the file that names its process, and wait until it is gone."""
    try:
        number = int(file.read_text())
    except (OSError, ValueError):
        return
    for signal in signals:
        for attempt in range(50):
            try:
                os.kill(number, signal if attempt == 0 else 0)
            except OSError:
                return
            time.sleep(0.05)
