"""Hexahedra against tetrahedra at equal error: a fast PneuNet on a stiff base, and a closed tube that is inflated.

Both are cases of the truth set (`benchmarks/truth/truth.py`): errors are against its reference values, not against the
finest mesh of the table. Every row is a process of its own with one thread, meshing and solving included, compilation
not.
Run: python benchmarks/accuracy/swept.py; it takes a few minutes and writes swept.md beside this file.
"""

import json
import sys
from pathlib import Path
from typing import Any

sys.path.insert(0, str(Path(__file__).parents[2]))  # so that `benchmarks` is found
from benchmarks.shared.tables import table
from benchmarks.truth.truth import VALUES, read, separate
from benchmarks.truth.truth_cases import CASES

#: Case: cells and size [mm] of each run.
RUNS = {
    "fast_pneunet_stiff_base": [
        ("hexahedra", 4.0), ("hexahedra", 3.0), ("hexahedra", 2.0), ("hexahedra", 1.5),
        ("tetrahedra", 4.0), ("tetrahedra", 3.0), ("tetrahedra", 2.0), ("tetrahedra", 1.4), ("tetrahedra", 1.0),
    ],
    "closed_tube": [
        ("hexahedra", 8.0), ("hexahedra", 4.0), ("hexahedra", 2.0),
        ("tetrahedra", 6.0), ("tetrahedra", 3.0), ("tetrahedra", 1.5),
    ],
}  # fmt: skip
HEAD = ("cells", "size [mm]", "number", "unknowns", "value", "error", "iterations", "mesh [CPU s]", "solve [CPU s]")
ONE_RUN = Path(__file__).parents[1] / "truth" / "truth_run.py"


def run(case: str, kind: str, size: float) -> dict[str, Any]:
    """Mesh and solve in a process of its own."""
    request = {"case": case, "kind": kind, "step": str(size), "formulation": "mixed", "most": 1e6}
    row = separate([str(ONE_RUN), json.dumps(request)])
    if "values" not in row:
        raise SystemExit(row["note"])
    return row


def section(name: str) -> str:
    """The table of a case: its headline measure."""
    case = next(case for case in CASES if case.name == name)
    headline = case.measures[0]
    truth = read(VALUES)[name]["value"][headline.name]
    lines = []
    for kind, size in RUNS[name]:
        got = run(name, kind, size)
        value = got["values"][headline.name]
        lines.append((
            kind, f"{size:g}", f"{got['cells']}", f"{got['unknowns']}", f"{value:.4f}", f"{value / truth - 1:+.2%}",
            f"{got['iterations']}", f"{got['meshing']:.1f}", f"{got['solving']:.1f}",
        ))  # fmt: skip
    about = f"{headline.name.replace('_', ' ')} [{headline.unit}], reference {truth:.4f}"
    return f"## {case.title}: {about}\n\n{table(HEAD, lines)}\n"


if __name__ == "__main__":
    text = "# Hexahedra against tetrahedra\n\n" + "\n".join(section(name) for name in RUNS)
    (Path(__file__).parent / "swept.md").write_text(text, encoding="utf-8")
    print(text)
