"""What it costs to suck a bellows together until its walls touch, on an axisymmetric mesh.

CPU seconds of the solve, one thread, kernels compiled before. Run: python
benchmarks/core/contact_axisymmetric.py; a minute.
"""

from dataclasses import dataclass
from time import process_time

import turgor as tg
from turgor.core.engine.warmup.compiling import compile_kernels
from turgor.core.engine.warmup.needs import Needs
from turgor.units import MPa, kPa

#: Folds of the bellows, and pressure [kPa] at which its walls touch.
FOLDS, PRESSURE = 2, -10.0


@dataclass(frozen=True, slots=True)
class Facts:
    """Mesh, path and time of the run."""

    unknowns: int
    steps: int
    iterations: int
    touching: int
    seconds: float


def run() -> Facts:
    """Solve it once."""
    mesh = tg.mesh(tg.actuators.BellowsOfRevolution(folds=FOLDS).build(), cells="axisymmetric")
    rubber = tg.Material(name="rubber", law=tg.laws.NeoHooke(C10=0.1 * MPa))
    model = tg.Model(mesh, {"body": rubber}, [tg.Fixed("fixed")], [tg.Pressure("cavity", PRESSURE * kPa)])
    compile_kernels(None, Needs(nodes=mesh.cell_type.nodes, sides=mesh.cell_type.side.nodes))
    start = process_time()
    solution = tg.solve(model, options=tg.EngineOptions(threads=1))
    spent = process_time() - start
    touching = sum(bool(state.touches and state.touches["self"].area > 0) for state in solution.states[1:])
    return Facts(mesh.unknown_count, len(solution.steps), solution.iterations, touching, spent)


def section() -> str:
    """The run as a section of the page of results."""
    facts = run()
    return (
        f"## Contact on an axisymmetric mesh\n\nA bellows of {FOLDS} folds and {facts.unknowns:,} unknowns, sucked "
        f"together at {PRESSURE:g} kPa; its walls touch in {facts.touching} of the {facts.steps} steps. "
        f"{facts.iterations} iterations, {facts.seconds:.0f} CPU s, one thread.\n"
    )


if __name__ == "__main__":
    print(section())
