"""What contact costs in the demo: its share of the time, and a step with it against a step without.

The demo at a coarser mesh, followed to the same pressure with contact and without; without, the walls run through each
other. Every run is a process of its own with one thread, CPU seconds of the solve, kernels compiled before. The target
is a step with contact at no more than twice the time of one without. Run: python
benchmarks/core/contact.py; some minutes.
"""

import json
import os
import subprocess
import sys
from pathlib import Path
from typing import Any

#: Mesh size [mm], and pressure [kPa] of the demo.
SIZE, PRESSURE = 4.0, 22.5

RUN = """
import json, sys, time
import turgor as tg
from turgor.core.engine.contact.terms import ContactTerms
from turgor.core.engine.warmup.compiling import compile_kernels
from turgor.core.engine.warmup.needs import Needs
from turgor.core.engine.system import System
from turgor.core.engine.algebra.tangent import Tangent
from turgor.core.model.contact import Contact
from turgor.units import kPa, mm

touch, size, pressure, example = sys.argv[1] == "on", float(sys.argv[2]), float(sys.argv[3]), sys.argv[4]
seconds, running = {}, []


def clock(owner, name, part):
    inner = getattr(owner, name)

    def timed(*args, **kwargs):
        start = time.process_time()
        running.append(0.0)
        try:
            return inner(*args, **kwargs)
        finally:
            spent = time.process_time() - start
            seconds[part] = seconds.get(part, 0.0) + spent - running.pop()  # what runs inside counts there
            if running:
                running[-1] += spent

    setattr(owner, name, timed)


for owner, name, part in (
    (ContactTerms, "look", "search"), (ContactTerms, "shortening", "search"),
    (ContactTerms, "forces", "contact forces"), (ContactTerms, "prepare", "contact tangent"),
    (ContactTerms, "add_tangents", "contact tangent"),
    (System, "evaluate", "residuals"), (Tangent, "factor", "factorization"), (System, "tangent_data", "tangent"),
    (Tangent, "solve", "solution"),
):
    clock(owner, name, part)
job = tg.jobs.read_job(example)
mesh = tg.mesh(job.actuator.build(), size=size * mm)
contact = Contact() if touch else Contact(self_contact=False)
model = tg.Model(mesh, job.materials, job.supports, [tg.Pressure("cavity", pressure * kPa)], contact=contact)
options = tg.EngineOptions(threads=1)
compile_kernels(None, Needs(nodes=mesh.cell_type.nodes, sides=mesh.cell_type.side.nodes))
start = time.process_time()
solution = tg.solve(model, options=options, throw=False)
total = time.process_time() - start
touching = [bool(state.touches and state.touches["self"].area > 0) for state in solution.states[1:]]
print(json.dumps({
    "total": total, "parts": seconds, "steps": len(solution.steps), "iterations": solution.iterations,
    "factorizations": solution.timing.factorizations, "touching": sum(touching), "unknowns": mesh.unknown_count,
    "reached": solution.states[-1].load_factor, "solver": solution.timing.linear_solver,
}))
"""

PARTS = (
    "residuals",
    "tangent",
    "factorization",
    "solution",
    "search",
    "contact forces",
    "contact tangent",
)

Facts = dict[str, Any]


def run(contact: str) -> Facts:
    """Solve in a process of its own."""
    example = Path(__file__).parents[2] / "examples" / "fast_pneunet.toml"
    one_thread = os.environ | {"OMP_NUM_THREADS": "1", "NUMBA_NUM_THREADS": "1"}
    command = [sys.executable, "-c", RUN, contact, str(SIZE), str(PRESSURE), str(example)]
    done = subprocess.run(command, capture_output=True, text=True, check=False, env=one_thread)
    if done.returncode:
        raise SystemExit(done.stderr)
    result: Facts = json.loads(done.stdout.splitlines()[-1])
    return result


def section() -> str:
    """Both runs as a section of the page of results."""
    on, off = run("on"), run("off")
    rows = [(part, *(f"{facts['parts'].get(part, 0.0):.1f}" for facts in (on, off))) for part in PARTS]
    rest = (f"{facts['total'] - sum(facts['parts'].values()):.1f}" for facts in (on, off))
    rows += [("the rest", *rest), ("all", *(f"{facts['total']:.1f}" for facts in (on, off)))]
    rows += [("of it search, forces and tangent of contact", *(f"{contact_share(facts):.0%}" for facts in (on, off)))]
    for name in ("steps", "iterations", "factorizations"):
        rows.append((name, *(str(facts[name]) for facts in (on, off))))
    for name in ("step", "iteration", "factorization"):
        rows.append((f"CPU s for each {name}", *(f"{facts['total'] / facts[f'{name}s']:.2f}" for facts in (on, off))))
    twice = (on["total"] / on["steps"]) / (off["total"] / off["steps"])
    text = (
        f"The demo at a mesh size of {SIZE:g} mm, {on['unknowns']:,} unknowns, up to {PRESSURE:g} kPa; its walls touch "
        f"in {on['touching']} of the {on['steps']} steps. CPU seconds of the solve, one thread, {on['solver']}. "
        f"Without contact the walls run through each other. A step with contact takes {twice:.2f} times one without, "
        f"where the target is at most twice; there are {on['steps'] / off['steps']:.1f} times as many steps, because "
        "walls meet one after the other."
    )
    lines = ["| | with contact | without |", "|---|---|---|", *(f"| {' | '.join(row)} |" for row in rows)]
    return f"## Contact\n\n{text}\n\n" + "\n".join(lines) + "\n"


def contact_share(facts: Facts) -> float:
    """Share of the time that search, forces and tangents of contact take."""
    own = ("search", "contact forces", "contact tangent")
    return float(sum(facts["parts"].get(part, 0.0) for part in own) / facts["total"])


if __name__ == "__main__":
    print(section())
