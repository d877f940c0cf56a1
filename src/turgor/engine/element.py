"""Element: how the cells of a mesh carry displacement and mean stress, and where they are integrated."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from turgor.engine.mean_stress_jumps import mean_stress_numbers
from turgor.engine.reference import CELL_QUADRATURE_DEGREE, ReferenceCell, reference_cell
from turgor.meshing.cells import HEXAHEDRON
from turgor.model.model import DISPLACEMENT, MIXED, Model

Ints = NDArray[np.int64]

#: Points of cells without mean stress, by nodes: those of the usual displacement elements, 4 in a
#: tetrahedron, 8 (reduced) in a 20-node hexahedron, 27 in a 27-node one.
DISPLACEMENT_DEGREE = {10: 2, 20: 3, 27: 4}

#: Stiffness of the volume term of 27-node hexahedra over the initial shear modulus, see `element_of`.
VOLUME_STABILIZATION = 5.0


@dataclass(frozen=True, slots=True, eq=False)
class Element:
    """The discretization of a model's cells.

    Parameters
    ----------
    tables : ReferenceCell
        Shape functions at the integration points.
    shape, modes : tuples of zeros
        As long as a cell has nodes and mean stresses; their types tell the compiler these numbers.
    mean : (c, m) int array
        Places of each cell's mean stresses among all.
    mean_count : int
        Mean stresses of the mesh.
    stabilization : float
        γ/μ of the term γ/2 (J − 1 − p/κ)² that is added to the energy; zero where cells are stable without it.
    """

    tables: ReferenceCell
    shape: tuple[int, ...]
    modes: tuple[int, ...]
    mean: Ints
    mean_count: int
    stabilization: float = 0.0


def tables_with(nodes: int, points: int) -> ReferenceCell:
    """Find the tables of a cell with that many nodes by the number of their integration points."""
    tables = reference_cell(nodes, CELL_QUADRATURE_DEGREE)
    return tables if len(tables.weights) == points else reference_cell(nodes, DISPLACEMENT_DEGREE[nodes])


def element_of(model: Model) -> Element:
    """Choose the discretization of a model.

    Cells share a continuous mean stress with one value at each vertex, linear in tetrahedra and trilinear in hexahedra
    (Taylor and Hood), which jumps where stiffness or traction jumps (`turgor.engine.mean_stress_jumps`). A linear mean
    stress of each hexahedron's own, discontinuous between all of them, passes the same tests; but it lacks the products
    of coordinates that bending makes in a wall of one cell: the cavity of a fast PneuNet with such walls grew 13 % too
    much, 1 % with values at vertices. The formulation ``"displacement"`` has none.

    The trilinear mean stress leaves 27-node hexahedra volumetric modes that it does not see. They buckle falsely where
    the rubber is compressed to 0.85 of its length. The term γ/2 (J − 1 − p/κ)² in the energy resists them. It vanishes
    with the exact solution, so that the order of convergence stays. Tetrahedra have no such modes.
    """
    mesh = model.mesh
    nodes = mesh.cell_type.nodes
    if model.formulation == DISPLACEMENT:
        none = np.zeros((len(mesh.cells), 0), dtype=np.int64)
        return Element(reference_cell(nodes, DISPLACEMENT_DEGREE[nodes]), (0,) * nodes, (), none, 0)
    mean, count = mean_stress_numbers(model)
    tables = reference_cell(nodes, CELL_QUADRATURE_DEGREE)
    stabilized = mesh.cell_type is HEXAHEDRON and model.formulation == MIXED
    share = VOLUME_STABILIZATION if stabilized else 0.0
    return Element(tables, (0,) * nodes, (0,) * mean.shape[1], mean, count, share)


def volume_stiffness(
    model: Model, element: Element, compliance: NDArray[np.float64], stress: float
) -> NDArray[np.float64]:
    """γ (c,) of the volume term of each cell, scaled by ``stress``; below κ, however compressible the rubber.

    ``compliance`` (c,) is 1/κ, scaled.
    """
    out = np.zeros(len(compliance))
    if element.stabilization:
        for name, material in model.region_materials.items():
            out[model.mesh.regions[name]] = element.stabilization * material.law.shear_modulus / stress
    return np.asarray(out / (1 + out * compliance))
