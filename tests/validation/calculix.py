"""Run CalculiX on an exported model and read the displacements that it prints."""

import os
import shutil
import subprocess
from pathlib import Path

import numpy as np
import pytest

#: The solver, where it is installed (Debian: calculix-ccx).
CCX = shutil.which("ccx")

needs_calculix = pytest.mark.skipif(CCX is None, reason="CalculiX (ccx) is not installed")


def run_ccx(file: Path) -> None:
    """Solve an .inp file in its folder; refuse when it did not end well."""
    assert CCX is not None
    environment = {**os.environ, "OMP_NUM_THREADS": "1"}
    done = subprocess.run([CCX, "-i", file.stem], cwd=file.parent, env=environment, capture_output=True, text=True)
    if done.returncode or "*ERROR" in done.stdout:
        raise RuntimeError(f"ccx failed on {file.name}: {done.stdout[-1000:]}")


def displacements(file: Path, node_count: int) -> list[tuple[float, np.ndarray]]:
    """Time and displacement [m] of every node (n, 3) at the end of each step, from the .dat file.

    Nodes that the file does not name, those in the middle of the sides of 27-node hexahedra, are NaN.
    """
    results = []
    for block in file.with_suffix(".dat").read_text().split("displacements")[1:]:
        head, *lines = block.splitlines()
        rows = np.array([line.split() for line in lines if len(line.split()) == 4], dtype=float)
        u = np.full((node_count, 3), np.nan)
        u[rows[:, 0].astype(int) - 1] = rows[:, 1:] * 1e-3
        results.append((float(head.split()[-1]), u))
    return results
