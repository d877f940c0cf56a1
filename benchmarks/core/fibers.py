"""Discrete threads against smeared fibers: time of a tube with 80 turns, single and double helix.

Every row is a process of its own with one thread, meshing and solving included, compilation not. A tube of 160 mm is
wound with one thread a hand of 80 turns, 2 mm from turn to turn, and inflated. The target is a discrete winding within
1.5 times the time of the smeared one. Run: python benchmarks/core/fibers.py; a row takes about a minute.
"""

import json
import os
import subprocess
import sys

#: Hand, cells, size [mm], pressure [kPa].
CASES = (("right", "hexahedra", 6.0, 60.0), ("both", "hexahedra", 6.0, 60.0), ("right", "tetrahedra", 6.0, 60.0))

RUN = """
import json, sys, time
import turgor as tg
from turgor.core.engine.warmup.compiling import compile_kernels
from turgor.core.engine.warmup.needs import Needs
from turgor.core.geometry.actuators.fiber_reinforced_cylinder import FiberReinforcedCylinder
from turgor.core.materials.laws.laws import Hooke
from turgor.core.model.fibers import Fibers, Winding
from turgor.core.results.measures.measures import find_measure
from turgor.units import MPa, kPa, mm

form, hand, cells, size, pressure = sys.argv[1], sys.argv[2], sys.argv[3], float(sys.argv[4]), float(sys.argv[5])
kevlar = tg.Material(name="kevlar", law=Hooke(E=31067 * MPa, nu=0.36))
rubber = tg.Material(name="rubber", law=tg.laws.NeoHooke(C10=0.12 * MPa))
compile_kernels(None, Needs(nodes=27 if cells == "hexahedra" else 10))


def solve(size, length, pressure):
    winding = Winding(pitch=2 * mm, starts=1, hand=hand)
    fibers = Fibers(face="outside", material=kevlar, diameter=0.1778 * mm, winding=winding, form=form)
    mesh = tg.mesh(FiberReinforcedCylinder(length=length * mm, symmetric=False).build(), size=size * mm, cells=cells)
    model = tg.Model(
        mesh, {"body": rubber}, [tg.Fixed("fixed")], [tg.Pressure("cavity", pressure * kPa)], reinforcements=[fibers]
    )
    return mesh, tg.solve(model, options=tg.EngineOptions(linear_solver="rslab", threads=1))


solve(8.0, 20, 1.0)  # compiles what is left
start = time.process_time()
mesh, solution = solve(size, 160, pressure)
seconds = time.process_time() - start
tip = tg.measure(solution, find_measure("tip_displacement_x"), mesh_error=False).column("tip_displacement_x")[-1] / mm
iterations = sum(step.iterations for step in solution.steps)
print(json.dumps({"unknowns": mesh.unknown_count, "tip": tip, "iterations": iterations, "seconds": seconds}))
"""


def run(form: str, case: tuple[str, str, float, float]) -> dict[str, float]:
    """Mesh and solve in a process of its own."""
    one_thread = os.environ | {"OMP_NUM_THREADS": "1", "NUMBA_NUM_THREADS": "1"}
    command = [sys.executable, "-c", RUN, form, *map(str, case)]
    done = subprocess.run(command, capture_output=True, text=True, check=False, env=one_thread)
    if done.returncode:
        raise SystemExit(done.stderr)
    result: dict[str, float] = json.loads(done.stdout.splitlines()[-1])
    return result


def main() -> None:
    """Print the table."""
    print("| hand | cells | unknowns | form | tip moves [mm] | iterations | CPU s | discrete / smeared |")
    print("| --- | --- | --- | --- | --- | --- | --- | --- |")
    for case in CASES:
        smeared, discrete = run("smeared", case), run("discrete", case)
        for form, row in (("smeared", smeared), ("discrete", discrete)):
            share = f"{row['seconds'] / smeared['seconds']:.2f}"
            cells = (case[0], case[1], f"{row['unknowns']}", form, f"{row['tip']:.3f}", f"{row['iterations']}")
            print("|", " | ".join((*cells, f"{row['seconds']:.1f}", share)), "|", flush=True)


if __name__ == "__main__":
    main()
