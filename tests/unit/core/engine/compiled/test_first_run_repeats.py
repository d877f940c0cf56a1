"""The process that compiles computes, to the last digit, what later ones compute with the same code from disk."""

import os
import subprocess
import sys
from pathlib import Path

SCRIPT = """
import hashlib, sys
import numpy as np
sys.path.insert(0, sys.argv[1])
from results_cases import body, model
from turgor.core.engine.system import System

system = System(model(body()))
unknowns = 1e-3 * np.random.default_rng(5).standard_normal(system.size)
unknowns[system.prescribed] = 0
at = system.evaluate(unknowns, 0.5)
arrays = at.residual, system.stresses(at).cells, system.tangent_data(at)
print(*(hashlib.md5(np.ascontiguousarray(array).tobytes()).hexdigest() for array in arrays))
"""


def test_a_first_run_computes_what_later_ones_do(tmp_path):
    """Functions that are not inlined into a loop come from wherever they were compiled first."""
    environment = os.environ | {"NUMBA_CACHE_DIR": str(tmp_path), "OMP_NUM_THREADS": "1"}
    command = [sys.executable, "-c", SCRIPT, str(Path(__file__).parents[3])]
    first, second = (
        subprocess.run(command, env=environment, check=True, capture_output=True, text=True).stdout for _ in range(2)
    )
    assert first.split() == second.split()
    assert len(first.split()) == 3
