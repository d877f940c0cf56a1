"""V05: a thick tube whose section or meridian is a plane mesh of a file follows the exact curve.

Problem: inner radius 5 mm, outer 7 mm, neo-Hookean (C10 = 0.12 MPa), frictionless walls keep the length; inflated to
1.5 times the inner radius. Exact pressure: `exact.tube_pressure`, after Green and Zerna.
Section: a quarter of a ring in plane strain, with 6 curved quadrilaterals or triangles around, and 18 linear ones: the
miss of straight edges falls with their square, 0.45, 0.13 and 0.06 % with 6, 12 and 18. Meridian: a strip, turned about
the axis of the file.
Tolerance: 0.1 % of the inner radius with two cells through the wall.
"""

from pathlib import Path

import numpy as np
import pytest

import exact
import problems
import turgor as tg
from turgor.units import mm

INNER, OUTER, LENGTH = 5 * mm, 7 * mm, 4 * mm
STRETCH = 1.5
PRESSURE = exact.tube_pressure(problems.NEO_HOOKE, STRETCH, INNER, OUTER)
ACROSS = 2


def plane_file(file: Path, kind: str, place, around: int = 6) -> Path:
    """Write cells of a kind between the inner wall (u = 0), the outer one (u = 1) and two ends (v = 0, 1)."""
    count = 2 if kind.endswith(("6", "8")) else 1
    rows, columns = count * ACROSS + 1, count * around + 1
    node = np.arange(rows * columns).reshape(rows, columns) + 1
    points = [place(i / (rows - 1), j / (columns - 1)) for i in range(rows) for j in range(columns)]
    cells = []
    for i in range(0, rows - 1, count):
        for j in range(0, columns - 1, count):
            at = node[i : i + count + 1, j : j + count + 1]
            a, b, c, d = at[0, 0], at[-1, 0], at[-1, -1], at[0, -1]
            if kind == "CPE4" or kind == "CAX4":
                cells.append([a, b, c, d])
            elif kind.endswith("8"):
                cells.append([a, b, c, d, at[1, 0], at[2, 1], at[1, 2], at[0, 1]])
            elif kind.endswith("3"):
                cells += [[a, b, c], [a, c, d]]
            else:
                m = at[1, 1]
                cells += [[a, b, c, at[1, 0], at[2, 1], m], [a, c, d, m, at[1, 2], at[0, 1]]]
    sets = {"cavity": node[0], "outer": node[-1], "start": node[:, 0], "end": node[:, -1]}
    lines = ["*NODE", *(f"{n}, {x:.12g}, {y:.12g}" for n, (x, y) in enumerate(points, 1)), f"*ELEMENT, TYPE={kind}"]
    lines += [f"{n}, " + ", ".join(map(str, cell)) for n, cell in enumerate(cells, 1)]
    lines += [line for name, own in sets.items() for line in (f"*NSET, NSET={name}", *map(str, own))]
    file.write_text("\n".join(lines) + "\n", encoding="utf-8")
    return file


def ring(u: float, v: float) -> tuple[float, float]:
    radius = (INNER + u * (OUTER - INNER)) / mm
    return radius * np.cos(v * np.pi / 2), radius * np.sin(v * np.pi / 2)


def strip(u: float, v: float) -> tuple[float, float]:
    return (INNER + u * (OUTER - INNER)) / mm, v * LENGTH / mm


def inner_stretch(mesh: tg.Mesh, mirrors: dict[str, str], across: tuple[int, int]) -> float:
    supports = [tg.Fixed(face, directions) for face, directions in mirrors.items()]
    model = tg.Model(
        mesh, tg.Material(name="rubber", law=problems.NEO_HOOKE), supports, [tg.Pressure("cavity", PRESSURE)]
    )
    state = tg.solve(model).states[-1]
    return problems.mean_radius(state, "cavity", across) / INNER


@pytest.mark.parametrize(("kind", "around"), [("CPE8", 6), ("CPE6", 6), ("CPE3", 18)])
def test_a_section_in_plane_strain(tmp_path: Path, kind, around, record_verification) -> None:
    mesh = tg.files.read_plane_mesh(
        plane_file(tmp_path / "ring.inp", kind, ring, around), tg.files.PlaneStrain(thickness=8 * mm)
    )
    assert np.ptp(mesh.points[:, 2]) == pytest.approx(2 * mm) and mesh.symmetry_factor == 4
    stretch = inner_stretch(mesh, {"start": "y", "end": "x"}, (0, 1))
    record_verification(
        claim=f"thick tube, plane strain from a file of {kind}: inner stretch",
        source="V05, exact",
        expected=STRETCH,
        got=stretch,
        tolerance="1e-3",
    )
    assert stretch == pytest.approx(STRETCH, rel=1e-3)


@pytest.mark.parametrize("kind", ["CAX8", "CAX4", "CAX6"])
def test_a_meridian_about_its_axis(tmp_path: Path, kind, record_verification) -> None:
    state = tg.files.Axisymmetric(axis="y")
    mesh = tg.files.read_plane_mesh(plane_file(tmp_path / "tube.inp", kind, strip), state, axes=("y", "z", "x"))
    assert mesh.revolved == "x"
    stretch = inner_stretch(mesh, {"start": "x", "end": "x"}, (1, 2))
    record_verification(
        claim=f"thick tube, axisymmetric from a file of {kind}: inner stretch",
        source="V05, exact",
        expected=STRETCH,
        got=stretch,
        tolerance="1e-3",
    )
    assert stretch == pytest.approx(STRETCH, rel=1e-3)
