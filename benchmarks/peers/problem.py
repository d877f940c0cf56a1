"""The reference bender on meshes of three sizes, as files that turgor and the peers read.

S is the stored mesh of the verification data. M and L are meshed from the geometry that `problem.json` states. The
edges are straight, because the peers read linear geometry. Lengths are in mm, stresses in MPa.
"""

import json
import math
import re
import sys
from pathlib import Path
from typing import Any

import numpy as np

ROOT = Path(__file__).parents[2]
DATA = ROOT / "tests" / "verification" / "data" / "reference_bender"
BUILD = ROOT / "build" / "peers"

#: Cell sizes [mm], and the steps of 5 kPa that are computed.
SIZES = {"M": 1.9, "L": 1.1}
STEPS = {"S": 20, "M": 20, "L": 1}

#: Corners of the edges that carry the nodes 4 to 9 of a cell, and 3 to 5 of a triangle.
CELL_EDGES = ((0, 1), (1, 2), (0, 2), (0, 3), (1, 3), (2, 3))
SIDE_EDGES = ((0, 1), (1, 2), (0, 2))


def peak_memory() -> float:
    """Largest memory of this process so far [MiB]; no number where the system does not tell, as on Windows.

    Linux counts it anew for each process here; `ru_maxrss` begins with that of the process that started this one.
    """
    status = Path("/proc/self/status")
    match = re.search(r"VmHWM:\s+(\d+) kB", status.read_text(encoding="utf-8")) if status.exists() else None
    if match:
        return int(match[1]) / 1024
    try:
        import resource
    except ImportError:
        return math.nan
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / (2**20 if sys.platform == "darwin" else 1024)


def stated() -> dict[str, Any]:
    """Geometry, materials and loads."""
    return json.loads((DATA / "problem.json").read_text(encoding="utf-8"))


def constants(name: str) -> tuple[float, float, float]:
    """C1, C2 and the bulk modulus [MPa] of the ``"soft"`` or the ``"stiff"`` material."""
    law = stated()["materials"][name]
    mu, nu = 2 * law["C1"], law["nu0"]
    return law["C1"], law.get("C2", 0.0), 2 * mu * (1 + nu) / (3 * (1 - 2 * nu))


def mesh_file(size: str) -> Path:
    """File of the mesh of a size, made where it is missing."""
    if size == "S":
        return DATA / "bender_S.npz"
    file = BUILD / f"bender_{size}.npz"
    if not file.exists():
        BUILD.mkdir(parents=True, exist_ok=True)
        np.savez_compressed(file, **meshed(SIZES[size]))
    return file


def meshed(size: float) -> dict[str, np.ndarray]:
    """Mesh the bender with cells of a size [mm]; arrays as in the stored file."""
    from netgen.occ import Box, Cylinder, Glue, OCCGeometry, Pnt, X

    g = stated()["geometry"]
    length, R, wall, bottom, cap = (g[k] for k in ("length", "outer_radius", "wall", "bottom", "end_cap"))
    far, layer = 10 * length, g["stiff_layer"]
    outer = Cylinder(Pnt(0, 0, 0), X, R, length)
    hollow = Cylinder(Pnt(cap, 0, 0), X, R - wall, length - 2 * cap)
    body = outer - hollow * Box(Pnt(-far, -far, bottom), Pnt(far, far, far))
    halves = [body * Box(Pnt(-far, y, -far), Pnt(far, y + far, far)) for y in (-far, 0.0)]  # the tip is a vertex
    slabs = [Box(Pnt(-far, -far, low), Pnt(far, far, high)) for low, high in ((0, layer), (layer, far))]
    parts = [half * slab for half in halves for slab in slabs]
    made = OCCGeometry(Glue(parts)).GenerateMesh(maxh=size)
    points = np.array([list(point.p) for point in made.Points()])
    corners = np.array([[vertex.nr - 1 for vertex in cell.vertices] for cell in made.Elements3D()])
    return arrays(points, corners, g)


def arrays(points: np.ndarray, corners: np.ndarray, g: dict[str, float]) -> dict[str, np.ndarray]:
    """Ten-node cells with straight edges, the stiff ones, the cavity, the clamp, and the tip."""
    turned = np.linalg.det(points[corners[:, 1:]] - points[corners[:, :1]]) < 0
    corners[turned] = corners[turned][:, [0, 2, 1, 3]]
    pairs = np.sort(corners[:, np.array(CELL_EDGES)], axis=2)
    unique, place = np.unique(pairs.reshape(-1, 2), axis=0, return_inverse=True)
    cells = np.hstack([corners, len(points) + place.reshape(len(corners), 6)])
    every = np.vstack([points, points[unique].mean(axis=1)])
    middle = {tuple(pair): len(points) + k for k, pair in enumerate(unique.tolist())}
    cavity = [row for row in skin(corners).tolist() if in_cavity(points[row].T, g).all()]
    sides = [[*row, *(middle[min(row[a], row[b]), max(row[a], row[b])] for a, b in SIDE_EDGES)] for row in cavity]
    ends = [nearest(points, (g["length"], 0, z)) for z in (0, g["outer_radius"])]
    return {
        "points_linear": every,
        "tets": cells.astype(np.int32),
        "stiff": (points[corners][:, :, 2].mean(axis=1) < g["stiff_layer"]).astype(np.int8),
        "cavity": np.array(sides, dtype=np.int32),
        "clamp": np.flatnonzero(every[:, 0] < 1e-9),
        "tip": np.array(ends),
        "nv": np.array(len(points)),
    }


def skin(corners: np.ndarray) -> np.ndarray:
    """Triangles (t, 3) of one cell only, looking out."""
    every = corners[:, [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]]].reshape(-1, 3)
    _, first, count = np.unique(np.sort(every, axis=1), axis=0, return_index=True, return_counts=True)
    return every[first[count == 1]]


def outward(known: dict[str, np.ndarray]) -> np.ndarray:
    """Six-node sides of the cavity, looking out of the body."""
    looking = {tuple(sorted(row)): row for row in skin(known["tets"][:, :4]).tolist()}
    out = []
    for side in known["cavity"].tolist():
        row = looking[tuple(sorted(side[:3]))]
        turn = row.index(side[0])
        straight = row[(turn + 1) % 3] == side[1]
        out.append(side if straight else [side[k] for k in (0, 2, 1, 5, 4, 3)])
    return np.array(out)


def in_cavity(x: np.ndarray, g: dict[str, float]) -> np.ndarray:
    """Whether points (3, n) of the surface are on that of the cavity."""
    cap, near = g["end_cap"], 1e-6
    inside = np.hypot(x[1], x[2]) < g["outer_radius"] - g["wall"] + near
    return inside & (x[2] > g["bottom"] - near) & (x[0] > cap - near) & (x[0] < g["length"] - cap + near)


def nearest(points: np.ndarray, place: tuple[float, float, float]) -> int:
    """The vertex at a place."""
    away = np.linalg.norm(points - place, axis=1)
    assert away.min() < 1e-6, "the tip is no vertex"
    return int(away.argmin())


if __name__ == "__main__":
    for name in sys.argv[1:] or SIZES:
        print(mesh_file(name))
