"""Estimated mesh errors against true ones on random shapes: PneuNets, bellows and benders that no number was chosen by.

    python benchmarks/accuracy/estimates.py                 20 shapes of seed 43, and estimates.md; half an hour
    python benchmarks/accuracy/estimates.py --references    the same with new reference values, which are stored
    python benchmarks/accuracy/estimates.py --seed 7        shapes to choose numbers by; prints the page only
    python benchmarks/accuracy/estimates.py --count 6       the first shapes only; prints the page only

Every shape is solved on default tetrahedra and on default hexahedra, and the error of each measure at the last state is
estimated. The true error is the difference from a reference mesh: hexahedra, short next to sharp edges, refined twice.
"""

import argparse
import json
import sys
import time
from collections.abc import Iterator, Sequence
from pathlib import Path
from statistics import median
from typing import Any

sys.path.insert(0, str(Path(__file__).parents[2]))  # so that `benchmarks` is found
import turgor as tg
from benchmarks.accuracy.estimate_shapes import OPTIONS, Shape, described, drawn
from benchmarks.shared.tables import table
from turgor.accuracy.adaptivity.second_mesh import SecondMesh
from turgor.core.engine.transfer import Transfer
from turgor.core.geometry.geometry import Geometry
from turgor.core.meshing.sizing.default_size import default_size
from turgor.core.meshing.sweeping.section import Fineness
from turgor.core.meshing.sweeping.swept import swept_mesh
from turgor.core.solvers.remeshing.indicator import error_indicator
from turgor.core.solvers.remeshing.refine import refined

HERE = Path(__file__).parent
PAGE = HERE / "estimates.md"
#: Shapes of the page; numbers of the estimate are chosen by other seeds and by the truth set.
SEED, COUNT = 43, 20
KINDS = ("tetrahedra", "hexahedra")
#: Unknowns of the first and the last reference mesh at most; the last one may have this many times those of the first.
GRADED, FINEST, LEAST = 30_000, 80_000, 1.8
#: A true error below this share of the value counts as covered: the references are known no better.
FLOOR = 0.003


def references(seed: int) -> Path:
    """File of the reference values of a seed."""
    return HERE / f"estimates_seed_{seed}.json"


def reference(shape: Shape, pressure: float) -> dict[str, Any]:
    """Values on the finest mesh and on the one before it, both of hexahedra."""
    start = time.process_time()
    solution = tg.solve(shape.model(graded_mesh(shape.geometry()), pressure), options=OPTIONS)
    state, path = solution.states[-1], []
    most = max(FINEST, LEAST * solution.model.mesh.unknown_count)
    for growth in (2.7, 2.7, None):
        path.append((state.model.mesh.unknown_count, {each.name: float(each(state)) for each in shape.measures}))
        room = most / state.model.mesh.unknown_count
        if growth is None or room < 1.4:
            break
        refinement = refined(state.model.mesh, error_indicator(state), min(growth, room))
        second = SecondMesh(refinement, Transfer(state.model.mesh, refinement), OPTIONS)
        finer = second.solved_again(state, solution.procedure, exact=True)
        if finer is None:
            break
        state = finer
    return {
        "pressure": pressure,
        "values": path[-1][1],
        "before": path[-2][1] if len(path) > 1 else {},
        "unknowns": [unknowns for unknowns, _ in path],
        "seconds": round(time.process_time() - start, 1),
    }


def graded_mesh(geometry: Geometry) -> tg.Mesh:
    """Hexahedra of 0.8 times the default size, as short next to sharp edges as the number of unknowns lets them be."""
    size = 0.8 * default_size(geometry, "hexahedra")
    for share in (0.25, 0.35, 0.5, 0.7, 1.0):
        mesh = swept_mesh(geometry, Fineness(size=size, edge=share * geometry.smallest_wall))
        if mesh.unknown_count <= GRADED:
            break
    return mesh


def solved(shape: Shape, pressure: float, kind: str) -> tg.Solution:
    """The path on a default mesh."""
    return tg.solve(shape.model(tg.mesh(shape.geometry(), cells=kind), pressure), options=OPTIONS)


def run(shape: Shape, pressure: float, kind: str) -> dict[str, Any]:
    """Values and estimates on a default mesh, and what both took."""
    start = time.process_time()
    solution = solved(shape, pressure, kind)
    middle = time.process_time()
    response = tg.measure(solution, *shape.measures, mesh_error=True, options=OPTIONS)
    errors = {each.name: response.mesh_error(each.name) for each in shape.measures}
    return {
        "unknowns": solution.model.mesh.unknown_count,
        "values": {each.name: float(response.column(each.name)[-1]) for each in shape.measures},
        "estimates": {name: float(error[-1]) for name, error in errors.items() if error is not None},
        "solving": middle - start,
        "estimating": time.process_time() - middle,
    }


def compared(truth: dict[str, Any], row: dict[str, Any]) -> Iterator[tuple[str, float, float]]:
    """Name of each measure, its true error, and the estimated one; both as shares of the reference."""
    for name, value in truth["values"].items():
        yield name, row["values"][name] / value - 1, row["estimates"].get(name, float("nan")) / abs(value)


def covered(error: float, estimate: float) -> bool:
    """Whether the true error is within the estimated one, or so small that the reference is known no better."""
    return abs(error) <= max(estimate, FLOOR)


def page(shapes: Sequence[Shape], truths: Sequence[dict[str, Any]], rows: dict[tuple[int, str], dict[str, Any]]) -> str:
    """The page of all shapes."""
    lines = []
    for (number, kind), row in rows.items():
        truth = truths[number]
        for name, error, estimate in compared(truth, row):
            own = f"{abs(truth['before'][name] / truth['values'][name] - 1):.2%}" if truth["before"] else "–"
            ratio = f"{estimate / abs(error):.1f}" if abs(error) > FLOOR else "–"
            lines.append((
                f"{number + 1}", kind, f"{row['unknowns']:,}", name.replace("_", " "), f"{error:+.2%}",
                f"{estimate:.2%}", ratio, "yes" if covered(error, estimate) else "**no**", own,
                f"{row['solving']:.1f}", f"{row['estimating']:.1f}",
            ))  # fmt: skip
    head = ("shape", "cells", "unknowns", "measure", "true error", "estimate", "ratio", "covered", "reference",
            "solve [CPU s]", "estimate [CPU s]")  # fmt: skip
    listed = "\n".join(
        f"{number}. {shape.title}, {truth['pressure']:g} kPa"
        for number, (shape, truth) in enumerate(zip(shapes, truths, strict=True), 1)
    )
    return f"{introduction(len(shapes))}\n{listed}\n\n{table(head, lines)}\n\n{closing(truths, rows)}\n"


def introduction(count: int) -> str:
    """What the page shows."""
    return f"""# Estimated mesh errors against true ones

The first {count} shapes of a seed that no number of the estimate was chosen by; those were chosen by seed 7. Each is
solved on default tetrahedra and on default hexahedra. The true error is the difference from a reference mesh:
hexahedra, short next to sharp edges, refined where the error comes from; *reference* is how far its values moved with
the last refinement, which bounds its own error loosely. A true error below {FLOOR:.1%} counts as covered, and has no
ratio. Self-contact is off. Written by `python benchmarks/accuracy/estimates.py`.
"""


def closing(truths: Sequence[dict[str, Any]], rows: dict[tuple[int, str], dict[str, Any]]) -> str:
    """Counts for each kind of cells: deformation and 99th percentiles of stress apart."""
    sentences = []
    for kind in KINDS:
        pairs = [
            (name, error, estimate)
            for (number, of), row in rows.items() if of == kind
            for name, error, estimate in compared(truths[number], row)
        ]  # fmt: skip
        for what, chosen in (
            ("angle, displacement and volume", [pair for pair in pairs if not pair[0].startswith("von_mises")]),
            ("the 99th percentile of stress", [pair for pair in pairs if pair[0].startswith("von_mises")]),
        ):
            within = sum(covered(error, estimate) for _, error, estimate in chosen)
            large = [estimate / abs(error) for _, error, estimate in chosen if abs(error) > FLOOR]
            above = sum(ratio >= 1 for ratio in large)
            middle = f", median ratio {median(large):.1f}" if large else ""
            sentences.append(
                f"- {kind}, {what}: {within} of {len(chosen)} are covered; {above} of the {len(large)} whose true "
                f"error is above {FLOOR:.1%}{middle}"
            )
        mine = [row for (_, of), row in rows.items() if of == kind]
        cost = sum(row["estimating"] for row in mine) / sum(row["solving"] for row in mine)
        sentences.append(f"- {kind}, cost: all estimates take {cost:.0%} of the solves")
    return "\n".join(sentences)


def main() -> None:
    """References where they are missing, all runs, the page."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--seed", type=int, default=SEED)
    parser.add_argument("--count", type=int, default=COUNT)
    parser.add_argument("--references", action="store_true")
    chosen = parser.parse_args()
    shapes, file = drawn(chosen.seed, chosen.count), references(chosen.seed)
    stored = json.loads(file.read_text("utf-8")) if file.exists() and not chosen.references else []
    for shape in shapes[len(stored) :]:
        stored.append(described(shape) | reference(shape, shape.pressure()))
        file.write_text(json.dumps(stored, indent=1) + "\n", "utf-8")
        print(shape.title, stored[-1]["pressure"], stored[-1]["unknowns"], stored[-1]["seconds"], flush=True)
    rows = {}
    for number, shape in enumerate(shapes):
        for kind in KINDS:
            rows[number, kind] = run(shape, stored[number]["pressure"], kind)
            print(number, kind, json.dumps(rows[number, kind]), flush=True)
    text = page(shapes, stored[: len(shapes)], rows)
    print(text)
    if (chosen.seed, chosen.count) == (SEED, COUNT):
        PAGE.write_text(text, "utf-8")


if __name__ == "__main__":
    main()
