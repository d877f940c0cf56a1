"""`make bench`: what a solve costs, as a table with versions and machine, beside what other codes need.

python benchmarks/run.py [bender] [demo] [growth] [contact] [bellows] [newton] [running] [meshing] [iterative]
    [compiling] [overhead] [demo_run]
    [peers_S] [peers_M] [peers_L] [shared_S] [shared_M] [shared_L]

All by default; renews results.md.
"""

import json
import os
import subprocess
import sys
import tempfile
from collections.abc import Mapping
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

sys.path.insert(0, str(Path(__file__).parents[1]))  # so that `benchmarks` is found
from benchmarks.core import compiling, contact, contact_axisymmetric, iterative, meshing, newton
from benchmarks.job import demo_run, overhead, running
from benchmarks.peers import compare
from benchmarks.shared.machine import machine
from benchmarks.shared.tables import table
from turgor.core.engine.algebra.linear import available_solvers

HERE = Path(__file__).parent
PAGE = HERE / "results.md"
TWO = min(2, os.cpu_count() or 1)

#: Mesh sizes, and whether all edges are halved: 15,000 to a million unknowns. netgen takes long for as many.
GROWTH = tuple((size * 1e-3, size == 1.05) for size in (4.0, 2.4, 1.6, 1.15, 0.85, 0.625, 1.05))

Facts = Mapping[str, Any]


def measure(request: Mapping[str, Any], cache: str | None = None) -> Facts:
    """Run one case in its own process; ``cache`` names an empty folder to see what the first use costs."""
    threads = str(request["threads"])
    names = ("OMP_NUM_THREADS", "MKL_NUM_THREADS", "OPENBLAS_NUM_THREADS", "NUMBA_NUM_THREADS")
    environment = os.environ | dict.fromkeys(names, threads) | ({"NUMBA_CACHE_DIR": cache} if cache else {})
    command = [sys.executable, str(HERE / "shared" / "case.py"), json.dumps(request)]
    result = subprocess.run(command, env=environment, check=True, stdout=subprocess.PIPE, text=True)
    return json.loads(result.stdout.splitlines()[-1])


def memory(facts: Facts) -> str:
    """Peak memory in MiB."""
    return "unknown" if np.isnan(facts["memory"]) else f"{facts['memory']:.0f}"


def rest(facts: Facts) -> float:
    """Wall time of the solve that is neither compilation, set-up, assembly, factorization nor solving [s]."""
    return facts["total"] - sum(
        facts[key] for key in ("compile", "setup", "assembly", "residual", "factorization", "solve")
    )


def bender() -> str:
    """The reference bender on one thread."""
    rows = []
    for solver in available_solvers():
        facts = measure({"case": "bender", "solver": solver, "threads": 1})
        each = sum(facts[key] for key in ("assembly", "residual", "factorization", "solve")) / facts["iterations"]
        cells = (f"{facts['cpu']:.1f}", f"{each:.3f}", str(facts["iterations"]), f"{facts['deviation']:.1e}")
        rows.append((f"turgor, {solver}", *cells, memory(facts)))
    head = ("code", "CPU s, whole process", "s an iteration", "iterations", "tip off FEniCSx by", "peak MiB")
    text = (
        "20 equal steps to 100 kPa, residual to 1e-8, 15,779 unknowns, one thread, kernels compiled before. "
        "Other codes: see the peers."
    )
    return f"## Reference bender\n\n{text}\n\n{table(head, rows)}\n"


def demo() -> str:
    """The demo at about 60,000 unknowns, first use and later ones."""
    rows = []
    for solver in available_solvers():
        request = {"case": "demo", "solver": solver, "threads": TWO}
        with tempfile.TemporaryDirectory() as empty:
            rows.append(demo_row(f"{solver}, first use", measure(request, cache=empty)))
        rows.append(demo_row(solver, facts := measure(request)))
    head = (
        "linear solver",
        "wall s",
        "compile s",
        "set-up s",
        "steps",
        "iterations",
        "assembly s/it",
        "residual s/it",
        "factor s/it",
    )
    head += ("solve s/it", "rest s/it", "assembly/factor", "peak MiB")
    text = (
        f"Fast PneuNet of the example at a mesh size of 2.2 mm, {facts['unknowns']:,} unknowns, to 6 kPa, {TWO} "
        "threads; wall time of solve. Assembly is the forming of tangents; residuals include predictions and "
        "linearized stresses."
    )
    return f"## Demo\n\n{text}\n\n{table(head, rows)}\n"


def demo_row(name: str, facts: Facts) -> tuple[str, ...]:
    """One row: wall time and where each iteration spends it."""
    count = facts["iterations"]
    parts = (facts["assembly"], facts["residual"], facts["factorization"], facts["solve"], rest(facts))
    each = tuple(f"{part / count:.3f}" for part in parts)
    ratio = f"{facts['assembly'] / facts['factorization']:.2f}"
    seconds = (f"{facts['total']:.1f}", f"{facts['compile']:.1f}", f"{facts['setup']:.1f}")
    return (name, *seconds, str(facts["steps"]), str(count), *each, ratio, memory(facts))


def growth() -> str:
    """Time and memory from 15,000 to a million unknowns, with fitted exponents."""
    keys = ("setup", "assembly", "residual", "factorization", "solve")
    asked = {"case": "growth", "solver": "auto", "threads": TWO}
    runs = [measure(asked | {"size": size, "halved": halved}) for size, halved in GROWTH]
    columns = {key: [run[key] / (1 if key == "setup" else run["iterations"]) for run in runs] for key in keys}
    columns["all"] = [run["total"] - run["compile"] for run in runs]
    columns["memory"] = [run["memory"] - run["before"] for run in runs]
    size = [run["unknowns"] for run in runs]
    rows = [
        (f"{n:,}", run["solver"], str(run["iterations"]), *(f"{columns[key][i]:.3g}" for key in columns))
        for i, (n, run) in enumerate(zip(size, runs, strict=True))
    ]
    # from about 100,000 only: small problems are dominated by what does not grow
    upper = slice(len(size) // 2, None)
    fits = [np.polyfit(np.log(size[upper]), np.log(columns[key][upper]), 1)[0] for key in columns]
    rows.append((f"exponent from {size[upper][0]:,} on", "", "", *(f"{fit:.2f}" for fit in fits)))
    head = ("unknowns", "solver", "iterations", "set-up", "assembly/it", "residual/it", "factor/it", "solve/it", "all")
    text = "Six-chamber fast PneuNet, first load step of 1 kPa, wall seconds, linear solver chosen by itself,"
    return f"## Growth\n\n{text} {TWO} threads.\n\n{table((*head, 'MiB above start'), rows)}\n"


def main() -> None:
    """Run the parts named on the command line, print each as it is done, write them all."""
    parts = {"bender": bender, "demo": demo, "growth": growth, "contact": contact.section}
    parts["bellows"] = contact_axisymmetric.section
    parts |= {"newton": newton.section, "running": running.section, "meshing": meshing.section}
    parts |= {"iterative": iterative.section, "compiling": compiling.section, "overhead": overhead.section}
    parts |= {"demo_run": demo_run.section}
    parts |= {f"peers_{size}": partial(compare.section, size) for size in compare.problem.STEPS}
    parts |= {f"shared_{size}": partial(compare.section, size, TWO) for size in compare.problem.STEPS}
    chosen = sys.argv[1:] or list(parts)
    if unknown := [name for name in chosen if name not in parts]:
        sys.exit(f"unknown part {', '.join(unknown)}; known: {', '.join(parts)}.")
    about = "\n".join(f"- {name}: {value}" for name, value in machine().items())
    known = written()
    measure({"case": "growth", "solver": "rslab", "threads": TWO, "size": 4e-3})  # compiles the kernels if they are not
    last = "Written by `make bench`; the machine is that of the last run, which may have renewed a part."
    head = f"# Benchmarks\n\n{last}\n\n{about}"
    print(head)
    for name in chosen:
        section = parts[name]().strip()
        print(f"\n{section}", flush=True)
        known[section.partition("\n")[0]] = section
        PAGE.write_text("\n\n".join((head, *known.values())) + "\n", encoding="utf-8")


def written() -> dict[str, str]:
    """The sections of the page by their headings; none where there is no page."""
    text = PAGE.read_text("utf-8") if PAGE.exists() else ""
    sections = ("## " + each.strip() for each in text.split("\n## ")[1:])
    return {section.partition("\n")[0]: section for section in sections}


if __name__ == "__main__":
    main()
