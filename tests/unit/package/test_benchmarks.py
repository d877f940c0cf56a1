"""Every benchmark can be imported, so that none breaks unnoticed when the names that it uses change."""

import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).parents[3]

#: Those that need NGSolve or run in an environment of their own.
LEFT_OUT = ("third_order", "peers/felupe_", "peers/fenicsx", "peers/ngsolve_")


def test_every_benchmark_can_be_imported():
    names = [path.relative_to(ROOT).with_suffix("").as_posix() for path in (ROOT / "benchmarks").rglob("*.py")]
    names = sorted(name.replace("/", ".") for name in names if not any(part in name for part in LEFT_OUT))
    assert len(names) > 45
    script = f"from importlib import import_module\nfor name in {names}:\n    import_module(name)"
    done = subprocess.run([sys.executable, "-c", script], cwd=ROOT, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr[-2000:]
