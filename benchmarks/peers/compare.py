"""The reference bender in turgor and in other codes, one after another on this machine.

Each code runs in a process of its own with one thread asked for, in an environment of its own: FEniCSx in the system's
Python with Debian's packages, the others in virtual environments below build/peers. What cannot be installed has a row
that says so. With both cores, turgor has two threads and FEniCSx, the fastest of the others, two processes that each
use one.
"""

import json
import os
import shutil
import subprocess
import sys
import time
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

import numpy as np

from benchmarks.peers import problem
from benchmarks.shared.tables import table
from turgor.core.engine.algebra.linear import available_solvers

HERE = Path(__file__).parent
THREADS = ("OMP_NUM_THREADS", "MKL_NUM_THREADS", "OPENBLAS_NUM_THREADS", "NUMBA_NUM_THREADS", "RAYON_NUM_THREADS")
LONGEST = 1800

#: Those that share their work between processes.
SHARED = ("FEniCSx",)

Facts = Mapping[str, Any]


class NotThereError(Exception):
    """A code cannot be had on this machine."""


def with_debian(*packages: str) -> Path:
    """The system's Python with packages of Debian."""
    python = Path("/usr/bin/python3")
    # the reference BLAS, which Debian takes by default, makes MUMPS three times as slow
    ask = [str(python), "-c", "import ctypes, dolfinx; ctypes.CDLL('libopenblas.so.0')"]
    if not python.exists():
        raise NotThereError("there is no /usr/bin/python3")
    if subprocess.run(ask, capture_output=True).returncode == 0:
        return python
    command = ["apt-get", "install", "-y", "--no-install-recommends", *packages]
    try:
        subprocess.run(command, capture_output=True, check=True)
        subprocess.run(ask, capture_output=True, check=True)
    except (OSError, subprocess.CalledProcessError):
        raise NotThereError(f"needs Debian's {' '.join(packages)}") from None
    return python


def with_pip(name: str, *packages: str) -> Path:
    """A virtual environment with packages of PyPI."""
    folder = problem.BUILD / name
    python = folder / "bin" / "python"
    try:
        if not (folder / "complete").exists():
            subprocess.run([sys.executable, "-m", "venv", str(folder)], capture_output=True, check=True)
            subprocess.run([str(python), "-m", "pip", "install", "-q", *packages], capture_output=True, check=True)
            (folder / "complete").touch()
    except (OSError, subprocess.CalledProcessError):
        raise NotThereError(f"{' and '.join(packages)} could not be installed") from None
    return python


#: Where each peer's Python comes from, and its script.
PEERS: dict[str, tuple[Callable[[], Path], str]] = {
    "FEniCSx": (lambda: with_debian("python3-dolfinx", "python3-petsc4py", "libopenblas0-pthread"), "fenicsx.py"),
    "NGSolve": (lambda: with_pip("ngsolve", "ngsolve", "numpy"), "ngsolve_.py"),
    "FElupe": (lambda: with_pip("felupe", "felupe", "pypardiso", "tensortrax"), "felupe_.py"),
}


def run(command: list[str], threads: int = 1) -> Facts:
    """What a process prints last, and its wall time."""
    began = time.perf_counter()
    told = os.environ | dict.fromkeys(THREADS, str(threads))
    done = subprocess.run(command, env=told, capture_output=True, text=True, timeout=LONGEST)
    if done.returncode:
        last = (done.stderr.strip().splitlines() or ["no message"])[-1]
        raise NotThereError(f"ended with '{last}'")
    return json.loads(done.stdout.splitlines()[-1]) | {"wall": time.perf_counter() - began}


def turgor(solver: str, size: str, threads: int = 1) -> Facts:
    """The bender in turgor."""
    request = {"case": "peer_bender", "solver": solver, "threads": threads, "size": size}
    return run([sys.executable, str(HERE.parent / "shared" / "case.py"), json.dumps(request)], threads)


def peer(name: str, size: str, cores: int) -> Facts:
    """The bender in another code; on several cores as so many processes of one thread, which FEniCSx knows."""
    python, script = PEERS[name]
    command = [str(python()), str(HERE / script), str(problem.mesh_file(size)), str(problem.STEPS[size])]
    if cores == 1:
        return run(command)
    if shutil.which("mpirun") is None:
        raise NotThereError("there is no mpirun")
    return run(["mpirun", "--allow-run-as-root", "--oversubscribe", "-n", str(cores), *command])


def found(size: str, cores: int) -> tuple[list[Facts], list[tuple[str, str]]]:
    """What each code says of a size, and why others say nothing."""
    problem.mesh_file(size)
    turgor(available_solvers()[0], "S")  # compiles the kernels if they are not
    codes: dict[str, Callable[[], Facts]] = {
        f"turgor, {s}": lambda s=s: turgor(s, size, cores) for s in available_solvers()
    }
    for name in PEERS if cores == 1 else SHARED:
        codes[name] = lambda name=name: peer(name, size, cores)
    facts, missing = [], []
    for name, call in codes.items():
        try:
            facts.append({"code": name} | dict(call()))
        except NotThereError as error:
            missing.append((name, str(error)))
        except subprocess.TimeoutExpired:
            missing.append((name, f"not done after {LONGEST} s"))
    return facts, missing


def rows(facts: list[Facts]) -> list[tuple[str, ...]]:
    """A row for each code; times and tips beside those of turgor."""
    first = facts[0]
    tips = np.array(first["tips"])
    out = []
    for each in facts:
        off = np.linalg.norm(np.array(each["tips"]) - tips, axis=1) / np.linalg.norm(tips, axis=1)
        out.append(
            (
                each["code"],
                f"{each['unknowns']:,}",
                f"{each['cpu']:.1f}",
                f"{each['wall']:.1f}",
                f"{each['wall'] / first['wall']:.1f}",
                str(each["iterations"]),
                f"{each['memory']:.0f}",
                f"{off.max():.0e}",
            )
        )
    return out


def section(size: str, cores: int = 1) -> str:
    """The table of a size, with one thread each or on so many cores."""
    facts, missing = found(size, cores)
    head = ("code", "unknowns", "CPU s", "wall s", "over turgor", "iterations", "peak MiB", "tip off turgor by")
    steps = problem.STEPS[size]
    asked = "one thread asked for" if cores == 1 else f"{cores} cores: threads of turgor, processes of FEniCSx"
    text = (
        f"Reference bender, mesh {size}, {steps} {'steps' if steps > 1 else 'step'} of 5 kPa, residual to 1e-8, P2-P1 "
        f"on straight edges, {asked}, whole processes, one after another."
    )
    told = "".join(f"\n- {name}: {why}." for name, why in missing)
    on = "" if cores == 1 else f", {cores} cores"
    return f"## Peers, mesh {size}{on}\n\n{text}\n\n{table(head, rows(facts))}\n{told}\n"
