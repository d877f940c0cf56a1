"""Plane meshes of files in a job: keys, names, cavities that are found, and what is refused."""

from pathlib import Path
from typing import Any

import exchange_cases as cases
import numpy as np
import pytest

import turgor as tg
from refused import refused
from turgor.core.engine.chamber_volumes import cavity_volume
from turgor.core.meshing.exchange.formats.raw import KINDS, Block
from turgor.core.meshing.exchange.formats.write_stl import closed_surface
from turgor.core.meshing.revolved.plane_cells import plane_cells
from turgor.job.output.lock import lock_text
from turgor.units import mm
from turgor.views.report import describe

JOB = """
[mesh]
file = "frame.inp"
{key}

[materials]
SOFT = {{ law = "neo_hooke", C10 = "80 kPa" }}
{stiff}

[loads]
pressure = "2 kPa"
"""
STIFF = 'STIFF = { law = "neo_hooke", C10 = "240 kPa" }'


def frame_file(folder: Path, low: float = 0.0, hole: tuple[int, int] = (2, 4)) -> Path:
    """A rectangle of 40 × 12 mm around a hole of 32 × 4 mm, in squares and two triangles, with a named end."""
    x, y = np.meshgrid(np.arange(0, 41, 2.0), np.arange(0, 13, 2.0), indexing="ij")
    points = np.stack([x.ravel() + low, y.ravel(), 0 * x.ravel()], axis=1)
    node = np.arange(x.size).reshape(x.shape) + 1
    quads, triangles = [], []
    for i in range(20):
        for j in range(6):
            a, b, c, d = node[i, j], node[i + 1, j], node[i + 1, j + 1], node[i, j + 1]
            if i == j == 0:
                triangles = [[a, b, c], [a, c, d]]
            elif not (2 <= i < 18 and hole[0] <= j < hole[1]):
                quads.append([a, b, c, d])
    lines = [*cases.inp_nodes(points), "*ELEMENT, TYPE=CPE4, ELSET=SOFT"]
    lines += [f"{n}, {', '.join(map(str, cell))}" for n, cell in enumerate(quads, 1)]
    lines += ["*ELEMENT, TYPE=CPE3, ELSET=STIFF"]
    lines += [f"{n}, {', '.join(map(str, cell))}" for n, cell in enumerate(triangles, 900)]
    lines += ["*SURFACE, NAME=fixed", *(f"{n}, S4" for n in range(1, 6)), "901, S3"]
    lines += ["*NSET, NSET=tip", *map(str, node[-1].tolist())]
    file = folder / "frame.inp"
    file.write_text("\n".join(lines) + "\n", encoding="utf-8")
    return file


def job_of(folder: Path, key: str, **frame: Any) -> tg.jobs.Job:
    frame_file(folder, **frame)
    (folder / "frame.toml").write_text(JOB.format(key=key, stiff=STIFF), encoding="utf-8")
    return tg.jobs.read_job(folder / "frame.toml")


def test_plane_strain_finds_the_cavity_and_the_named_edges(tmp_path: Path) -> None:
    job = job_of(tmp_path, 'plane_strain = "10 mm"\naxes = ["x", "-z", "y"]')
    geometry = job.actuator.build()
    assert geometry.cavity_volumes["cavity"] * 4 == pytest.approx(32 * 4 * 10 * mm**3)
    assert geometry.solid_volume * 4 == pytest.approx((40 * 12 - 32 * 4) * 10 * mm**3)
    mesh = job.actuator.read()
    assert set(mesh.regions) == {"SOFT", "STIFF"} and mesh.symmetry_faces == ("symmetry_back", "symmetry_front")
    for face, x in (("fixed", 0.0), ("tip", 40 * mm)):
        nodes = mesh.points[mesh.face_nodes(face)]
        assert np.allclose(nodes[:, 0], x) and np.ptp(nodes[:, 2]) == pytest.approx(12 * mm)
    assert mesh.findings[0].code == "G20"
    assert "slice between two mirror planes" in dict(describe.mesh(mesh, None))["cells"]
    (tmp_path / "again.toml").write_text(lock_text(job, {}), encoding="utf-8")
    assert tg.jobs.read_job(tmp_path / "again.toml").actuator == job.actuator


def test_an_axisymmetric_mesh_is_turned_about_the_axis_of_its_file(tmp_path: Path) -> None:
    job = job_of(tmp_path, 'axisymmetric = "x"')
    mesh = job.actuator.read()
    assert "body of revolution about x" in dict(describe.mesh(mesh, None))["cells"]
    assert mesh.revolved == "x" and set(mesh.symmetry_faces) == {"symmetry_y", "symmetry_z"}
    exact = np.pi * (40 * 12**2 - 32 * (8**2 - 4**2)) * mm**3  # Pappus
    geometry = job.actuator.build()
    assert tg.files.read_plane_mesh(job.actuator.file, job.actuator.plane).symmetry_factor == 4
    assert cavity_volume(mesh, "cavity") == pytest.approx(np.pi * 32 * (8**2 - 4**2) * mm**3, rel=1e-6)
    assert geometry.solid_volume * 4 == pytest.approx(exact, rel=1e-3)
    # what lies on the axis is a thin hole there, and no surface
    assert not mesh.on_axis[np.concatenate([mesh.faces["outside"], mesh.faces["fixed"]])].all(axis=1).any()
    (tmp_path / "again.toml").write_text(lock_text(job, {}), encoding="utf-8")
    assert tg.jobs.read_job(tmp_path / "again.toml").actuator == job.actuator


def test_a_cavity_may_end_at_the_axis(tmp_path: Path) -> None:
    mesh = job_of(tmp_path, 'axisymmetric = "x"', hole=(0, 4)).actuator.read()
    assert mesh.cavities == ("cavity",) and {"tip", "outside"} <= set(mesh.faces)
    exact = np.pi * 32 * 8**2 * mm**3
    assert cavity_volume(mesh, "cavity") == pytest.approx(exact, rel=1e-6)
    assert closed_surface(mesh, "cavity").volume == pytest.approx(exact, rel=0.03)  # flat triangles around the axis
    assert closed_surface(mesh).open_edges == 0


def test_the_middle_of_a_nine_node_cell_stays() -> None:
    s, t = np.array([(0, 0), (2, 0), (2, 2), (0, 2), (1, 0), (2, 1), (1, 2), (0, 1), (1, 1)]).T
    points = np.concatenate([np.stack([s + 0.1 * t**2, t + 0.05 * s * t**2], axis=1), [[3.0, 0.0]]])
    nine = Block(kind=KINDS["quadrilateral9"], nodes=np.arange(9)[None])
    cells = plane_cells(points, [nine, Block(kind=KINDS["triangle3"], nodes=np.array([[1, 9, 2]]))])
    assert (cells.quads[:4] == 8).sum() == 4  # a corner of all four parts
    on = cells.points[cells.quads[0, 4:]]
    u, v = np.array([(0.5, 0), (1, 0.5), (0.5, 1), (0, 0.5), (0.5, 0.5)]).T
    assert np.allclose(on, np.stack([u + 0.1 * v**2, v + 0.05 * u * v**2], axis=1))


def test_curved_cells_are_cut_on_their_curves() -> None:
    corners = np.array([[1.0, 0.0], [2.0, 0.0], [0.0, 2.0], [0.0, 1.0]])
    middles = np.array([[1.5, 0.0], [2**0.5, 2**0.5], [0.0, 1.5], [0.5**0.5, 0.5**0.5]])
    points = np.concatenate([corners, middles])
    whole = Block(kind=KINDS["quadrilateral8"], nodes=np.arange(8)[None], groups={"a": np.array([0])})
    far = np.concatenate([points, [[3.0, 0.0], [2.5, 0.5], [2.5, 0.0]]])
    triangle = Block(kind=KINDS["triangle3"], nodes=np.array([[1, 8, 9]]), groups={"b": np.array([0])})
    one, cut = plane_cells(points, [whole]), plane_cells(far, [whole, triangle])
    assert (len(one.quads), len(cut.quads)) == (1, 7)
    assert cut.groups["a"].tolist() == [0, 1, 2, 3] and cut.groups["b"].tolist() == [4, 5, 6]
    inner = cut.points[cut.quads[:4]].reshape(-1, 2)
    on = inner[np.abs(inner[:, 0] ** 2 + inner[:, 1] ** 2 - 1) < 0.03]
    assert len(np.unique(on.round(9), axis=0)) == 5  # two ends, the middle of the file, and one between each
    assert cut.edges[0, 3] == ((0, 7), (7, 3))


@pytest.mark.parametrize(
    ("key", "facts"),
    [
        ('axisymmetric = "z"', ("frame.inp", "across z")),
        ('axisymmetric = "r"', ("'r'", "x, y, z")),
        ('plane_strain = "0 mm"', ("thickness", "0 mm", "positive")),
        ('plane_strain = "1 mm"\naxisymmetric = "x"', ("plane_strain", "axisymmetric")),
        ('plane_strain = "1 mm"\nmirror = ["y"]', ("actuator.mirror", "volume meshes")),
        ("", ("2 triangle3", "plane strain", "axisymmetric")),
    ],
)
def test_what_is_refused(tmp_path: Path, key: str, facts: tuple[str, ...]) -> None:
    with refused(*facts):
        job_of(tmp_path, key).actuator.read()


def test_a_mesh_on_both_sides_of_its_axis_is_refused(tmp_path: Path) -> None:
    with refused("axis y", "x = -20"):
        job_of(tmp_path, 'axisymmetric = "y"', low=-20.0).actuator.read()
