"""Windings in .inp files: every thread as trusses whose ends follow the sides of cells by linear equations."""

from dataclasses import replace
from math import pi

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.cells.reference import tied
from turgor.core.engine.fibers.fiber_trusses import FiberTrusses, discrete_threads
from turgor.core.inp.context import Context, plain
from turgor.core.inp.materials import material_lines
from turgor.core.model.fibers import DISCRETE, Fibers
from turgor.units import N, mm

Array = NDArray[np.float64]

#: Nodes of the sides and cells in a file, for those that have middles.
FEWER = {9: 8, 27: 20}

#: Shape values below this are no terms of an equation.
NO_TERM = 1e-9


def thread_lines(context: Context) -> list[str]:
    """Write the windings of a model.

    Raises
    ------
    TurgorError
        If threads bend, which trusses do not.
    """
    lines = list[str]()
    for number, fibers in enumerate(context.model.reinforcements, start=1):
        label = f"threads_{number}"
        trusses = discrete_threads(context.model.mesh, replace(fibers, form=DISCRETE))
        nodes, points, shares = _nodes(context, trusses)
        lines += [f"** {trusses.count} threads of {plain(fibers.name)}", f"*NODE, NSET={label}"]
        lines += [
            f"{node}, " + ", ".join(f"{value:.12g}" for value in point / mm)
            for node, point in zip(nodes.tolist(), points, strict=True)
        ]
        if not (fibers.embedded and context.for_abaqus):
            for node, (sides, values) in zip(nodes.tolist(), shares, strict=True):
                lines += _tie(node, sides, values)
        ends = _ends(trusses, nodes)
        lines += _springs(context, label, fibers, trusses, ends) if not context.for_abaqus else _trusses(
            context, label, fibers, ends
        )  # fmt: skip
        _account(context, fibers, trusses)
    return lines


def _nodes(context: Context, trusses: FiberTrusses) -> tuple[NDArray[np.int64], Array, list[tuple[Array, Array]]]:
    """Numbers, places and shares of the ends: the begin of each truss, and the end of the last one of each thread."""
    last = np.append(trusses.thread[1:] != trusses.thread[:-1], True)
    places = trusses.ends(context.model.mesh.points)
    points, shares = list[Array](), list[tuple[Array, Array]]()
    for k, sides in enumerate(trusses.pieces.sides):
        points.append(places[k, 0])
        shares.append((sides, trusses.begin[k]))
        if last[k]:
            points.append(places[k, 1])
            shares.append((sides, trusses.end[k]))
    return np.array([next(context.nodes) for _ in points]), np.array(points), shares


def _ends(trusses: FiberTrusses, nodes: NDArray[np.int64]) -> list[tuple[int, int]]:
    """Both nodes of each truss: one thread has one node more than trusses."""
    first = np.arange(len(trusses.thread)) + trusses.thread
    return [(int(nodes[k]), int(nodes[k + 1])) for k in first]


def _tie(node: int, sides: Array, values: Array) -> list[str]:
    """Equations by which a node follows a side or a cell of a file."""
    if len(values) in FEWER:
        values = values @ tied(FEWER[len(values)])
    terms = [(int(n) + 1, float(v)) for n, v in zip(sides, values, strict=False) if abs(v) > NO_TERM]
    lines = []
    for axis in (1, 2, 3):
        words = [f"{node}, {axis}, 1.", *(f"{n}, {axis}, {-value:.12g}" for n, value in terms)]
        lines += ["*EQUATION", str(len(words)), *(", ".join(words[k : k + 4]) for k in range(0, len(words), 4))]
    return lines


def _trusses(context: Context, label: str, fibers: Fibers, ends: list[tuple[int, int]]) -> list[str]:
    """Trusses of Abaqus: a part that bears tension only, and one that bears both."""
    lines = list[str]()
    for kind, share in (("", fibers.compression), ("_slack", 1 - fibers.compression)):
        if not share:
            continue
        name = f"{label}{kind}"
        lines.append(f"*ELEMENT, TYPE=T3D2, ELSET={name}")
        lines += [f"{next(context.elements)}, {one}, {other}" for one, other in ends]
        lines += [*material_lines(name, fibers.material, context.program), *(["*NO COMPRESSION"] if kind else [])]
        area = share * pi * fibers.diameter**2 / 4
        lines += [f"*SOLID SECTION, ELSET={name}, MATERIAL={name}", f"{area / mm**2:.12g}"]
        lines += ["*EMBEDDED ELEMENT", name] if fibers.embedded else []
    return lines


def _springs(
    context: Context, label: str, fibers: Fibers, trusses: FiberTrusses, ends: list[tuple[int, int]]
) -> list[str]:
    """Springs of CalculiX between two nodes, whose force is a table of the elongation; alike where equally long."""
    places = trusses.ends(context.model.mesh.points)
    lengths = np.linalg.norm(places[:, 1] - places[:, 0], axis=1)
    alike: dict[str, list[int]] = {}
    for k, length in enumerate(lengths.tolist()):
        alike.setdefault(f"{length / mm:.9g}", []).append(k)
    lines = list[str]()
    for number, (length, group) in enumerate(alike.items(), start=1):
        name, force = f"{label}_{number}", fibers.stretching_stiffness / N
        lines.append(f"*ELEMENT, TYPE=SPRINGA, ELSET={name}")
        lines += [f"{next(context.elements)}, {ends[k][0]}, {ends[k][1]}" for k in group]
        lines += [f"*SPRING, ELSET={name}, NONLINEAR", ""]
        rows = ((0.0 - fibers.compression * force, -float(length)), (0.0, 0.0), (force, float(length)))
        lines += [f"{f:.9e}, {elongation:.9e}" for f, elongation in rows]  # a number without a point is a direction
    return lines


def _account(context: Context, fibers: Fibers, trusses: FiberTrusses) -> None:
    what = f"fibers.{fibers.name}"
    kind = "trusses T3D2" if context.for_abaqus else "springs SPRINGA"
    where = "cells around them" if fibers.embedded else "sides of cells"
    form = "" if fibers.form == DISCRETE else " one by one, which turgor spreads over the face"
    context.approximated(
        what, f"{trusses.count} threads{form}, {len(trusses.thread)} straight {kind} that follow the {where}"
    )
    if fibers.bending:
        context.left_out(what, "the stiffness of the threads against bending")
