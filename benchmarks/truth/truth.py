"""How far a mesh is from the truth: fifteen loaded actuators whose measures are known by two discretizations.

    python benchmarks/truth/truth.py                 all runs, and docs/truth.md anew; an hour or two of one core
    python benchmarks/truth/truth.py --case NAME     only this case (may be given again); the others stay as they were
    python benchmarks/truth/truth.py --only-truth    only the reference values; needs NGSolve (make truth)
    python benchmarks/truth/truth.py --quick         only default sizes and the target of 2 %, against the stored values
    python benchmarks/truth/truth.py --missing       only what is not stored yet
    python benchmarks/truth/truth.py --page          nothing but the page, from what is stored

Every run is a process of its own with one thread; meshing and solving count, compilation does not. Reference values
lie in `truth_values.json` with how they were found, runs in `truth_runs.json`.
"""

import argparse
import json
import os
import subprocess
import sys
from pathlib import Path
from typing import Any

sys.path.insert(0, str(Path(__file__).parents[2]))  # so that `benchmarks` is found
from benchmarks.shared.machine import machine
from benchmarks.truth.truth_cases import CASES
from benchmarks.truth.truth_cases.case import GRADED, Case
from benchmarks.truth.truth_page import page

HERE = Path(__file__).parent
VALUES, RUNS = HERE / "truth_values.json", HERE / "truth_runs.json"
PAGE = HERE.parents[1] / "docs" / "truth.md"
#: Meshes with more unknowns than this are not solved.
MOST = 200_000
#: Steps that every kind of cells is solved at.
LADDER = ("double", "default", "half", "target")


def read(path: Path) -> dict[str, Any]:
    """What is stored."""
    return json.loads(path.read_text("utf-8")) if path.exists() else {}


def write(path: Path, stored: dict[str, Any]) -> None:
    """Store, sorted, so that a change shows as one."""
    path.write_text(json.dumps(stored, indent=1, sort_keys=True) + "\n", "utf-8")


def key(case: Case, kind: str, step: str, formulation: str = "mixed") -> str:
    """Name of a run."""
    return "|".join((case.name, kind, step, formulation))


def separate(arguments: list[str]) -> dict[str, Any]:
    """Run a script in a process of its own on one thread; the JSON of its last line, or why there is none."""
    threads = dict.fromkeys(("OMP_NUM_THREADS", "NUMBA_NUM_THREADS", "OPENBLAS_NUM_THREADS"), "1")
    command = [sys.executable, *arguments]
    done = subprocess.run(command, capture_output=True, text=True, check=False, env=os.environ | threads)
    lines = done.stdout.splitlines()
    if done.returncode or not lines:
        return {"note": (done.stderr.strip().splitlines() or ["no output"])[-1][:200]}
    result: dict[str, Any] = json.loads(lines[-1])
    return result


def measured(case: Case, kind: str, step: str, formulation: str) -> dict[str, Any]:
    """One run."""
    if kind == "third order":
        return separate([str(HERE / "third_order.py"), case.name, "--json"])
    asked = {"case": case.name, "kind": kind, "step": step, "formulation": formulation, "most": MOST}
    return separate([str(HERE / "truth_run.py"), json.dumps(asked)])


def witnesses(case: Case) -> tuple[tuple[str, str], tuple[str, str]]:
    """Two discretizations that must agree: kind of cells and step of each."""
    third, refined = ("third order", "fine"), ("tetrahedra", "refined")
    if case.touches and case.first == "hexahedra":
        return ("hexahedra", "quarter"), refined
    if case.touches:
        return refined, ("hexahedra", "refined")
    hexahedra = ("hexahedra", GRADED if case.graded else case.confirmed)
    return (third, hexahedra) if case.first == "third order" else (hexahedra, third)


def wanted(case: Case, *, only_truth: bool, quick: bool) -> list[tuple[str, str, str]]:
    """Kinds, steps and formulations of a case."""
    proof = [(kind, step, "mixed") for kind, step in witnesses(case)]
    if only_truth:
        return proof
    kinds = [(kind, "default", "mixed") for kind in case.kinds]
    if quick:
        return [*kinds, ("tetrahedra", "target", "mixed")]
    before = [(kind, "default", "continuous") for kind in case.kinds]
    if case.jumps:
        before.append(("tetrahedra", "half", "continuous"))
    ladder = [(kind, step, "mixed") for kind in case.kinds for step in LADDER]
    return list(dict.fromkeys([*kinds, *ladder, *before, *proof]))


def renew_values(cases: list[Case], runs: dict[str, Any]) -> None:
    """Store the reference values of cases from the runs of their two discretizations."""
    values = read(VALUES)
    for case in cases:
        results = [(kind, runs.get(key(case, kind, step), {})) for kind, step in witnesses(case)]
        if not all("values" in row for _, row in results):
            continue
        values[case.name] = {
            "title": case.title,
            "unit": {each.name: each.unit for each in case.measures},
            "witnesses": [
                {name: row[name] for name in ("size", "cells", "unknowns", "values")} | {"kind": kind}
                for kind, row in results
            ],
            "value": {each.name: reference(case, each.name, [row for _, row in results]) for each in case.measures},
        }
    write(VALUES, values)


def reference(case: Case, name: str, rows: list[dict[str, Any]]) -> float:
    """That of the first discretization, or the mean of both where neither is known to be the better one."""
    numbers = [row["values"][name] for row in rows]
    return float(sum(numbers) / len(numbers) if case.first == "mean" else numbers[0])


def arguments() -> argparse.Namespace:
    """What was asked for."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--case", action="append", choices=[case.name for case in CASES])
    for name in ("only-truth", "quick", "missing", "page"):
        parser.add_argument(f"--{name}", action="store_true")
    return parser.parse_args()


def main() -> None:
    """Run what was asked for, print and store each run as it is done, and write the page."""
    asked = arguments()
    chosen = [case for case in CASES if asked.case is None or case.name in asked.case]
    for case in () if asked.page else chosen:
        for kind, step, formulation in wanted(case, only_truth=asked.only_truth, quick=asked.quick):
            runs, name = read(RUNS), key(case, kind, step, formulation)
            if asked.missing and "values" in runs.get(name, {}):
                continue
            row = measured(case, kind, step, formulation)
            write(RUNS, read(RUNS) | {name: row})
            print(name, json.dumps(row), flush=True)
        renew_values([case], read(RUNS))
    renew_values(chosen, read(RUNS)) if asked.page else None
    text = page(CASES, read(VALUES), read(RUNS), machine())
    PAGE.write_text(text, "utf-8")
    print(text)


if __name__ == "__main__":
    main()
