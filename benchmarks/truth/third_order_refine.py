"""Smaller cells for the independent code where its own stress is far from a smooth one.

Corners make stresses without bound; on cells of one size they limit the order of convergence, whatever the order of the
elements: on such cells the slow PneuNet and the joint stood still 0.8 % and 1.2 % below their values. Cells there are
bisected. The indicator is a recovery (Zienkiewicz and Zhu 1987): a stress against its projection onto continuous
functions, region by region, over the stiffness of the region.

Bisected cells are short along an edge as well, where nothing varies. Cells that are cut in layers along re-entrant
edges, each layer an eighth as thick as the next one, stay long there: prisms, pyramids and hexahedra of NGSolve.
"""

from collections.abc import Iterable
from typing import Any

import netgen.occ as occ
import ngsolve as ng
import numpy as np

import turgor as tg

#: Half the length [mm] of the box that shows how much of the space around an edge is solid. Balls were cut wrongly at
#: edges where an arc meets a plane.
NEAR = 0.05
#: Share of it from which on an edge is re-entrant; a plane face has a half, a re-entrant right angle three quarters.
REENTRANT = 0.55


def mark_edges(case: Any, shape: Any) -> None:
    """Mark the edges of a CAD shape where stresses have no bound, for layers of cells along them.

    These are re-entrant edges and, if the case asks for it, the rims of held faces and of borders between regions.
    """
    on_planes = edges_of(face for face in shape.faces if (face.name or "").startswith("symmetry_"))
    held = edges_of(face for face in shape.faces if face.name in {support.face for support in case.supports})
    first, *others = [edges_of([solid]) for solid in shape.solids]
    borders = {place for other in others for place in first & other}
    rims = (held | borders) - on_planes if case.layered_rims else set()
    reach = occ.Vec(NEAR, NEAR, NEAR)
    for edge in shape.edges:
        middle = edge.Value(sum(edge.parameter_interval) / 2)
        share = (occ.Box(middle - reach, middle + reach) * shape).mass / (2 * NEAR) ** 3
        if REENTRANT < share < 0.99 or (share < 0.99 and place_of(edge) in rims):  # inside the body it is 1
            edge.hpref = 1


def edges_of(parts: Iterable[Any]) -> set[tuple[float, ...]]:
    """Where the edges of faces or solids lie."""
    return {place_of(edge) for part in parts for edge in part.edges}


def place_of(edge: Any) -> tuple[float, ...]:
    """Center and length of an edge [mm], which tell it from the others."""
    return tuple(round(value, 4) + 0.0 for value in (edge.center.x, edge.center.y, edge.center.z, edge.mass))


def stiffness(material: tg.Material) -> float:
    """Second derivative of a law's energy along a stretch at rest, up to a factor: what weighs one region's strain."""
    step = 1e-3
    stretched = 1 + step
    first = stretched**2 + 2 / stretched
    second = 2 * stretched + 1 / stretched**2
    return float(material.law.energy(first, second) - material.law.energy(3.0, 3.0)) / step**2 / 1e6


def indicator(case: Any, mesh: ng.Mesh, solution: ng.GridFunction) -> np.ndarray:
    """Squared error of every cell: of a stress, the strain's part and the mean one, over the stiffness."""
    shares = np.zeros(mesh.ne)
    u, *means = solution.components
    for name, mean in zip(sorted(set(mesh.GetMaterials())), means, strict=True):
        region, weight = mesh.Materials(name), stiffness(case.materials[name])
        space = ng.Compress(ng.MatrixValued(ng.H1(mesh, order=1, definedon=region), 3))
        smooth, stress = ng.GridFunction(space), weight / 3 * ng.Grad(u) + mean * ng.Id(3)
        smooth.Set(stress, definedon=region)
        apart = stress - smooth
        squared = ng.Integrate(ng.InnerProduct(apart, apart), mesh, definedon=region, element_wise=True)
        shares += np.array(squared) / weight
    return shares


def bisected(case: Any, mesh: ng.Mesh, solution: ng.GridFunction, share: float, order: int) -> ng.Mesh:
    """A copy of a mesh with a share of its cells bisected, those of most of the error; the old one is left as it is."""
    worst = set(np.argsort(-indicator(case, mesh, solution))[: int(np.ceil(share * mesh.ne))].tolist())
    finer = ng.Mesh(mesh.ngmesh.Copy())
    for number, element in enumerate(finer.Elements(ng.VOL)):
        finer.SetRefinementFlag(element, number in worst)
    finer.Refine()
    finer.Curve(order)
    return finer
