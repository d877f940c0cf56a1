"""Swept meshes: hexahedra of a section moved along a line or turned about an axis."""

from collections.abc import Sequence
from dataclasses import replace
from math import pi

from turgor.core.geometry.extrusion import Sweep, Turned
from turgor.core.geometry.geometry import Geometry
from turgor.core.geometry.shapes.film_shape import FilmShape
from turgor.core.geometry.shapes.sections import Outline
from turgor.core.meshing.mesh import Mesh
from turgor.core.meshing.sizing.settings import SIZING
from turgor.core.meshing.sizing.sizes import has_both_sides, is_block, is_row, is_slanted_row, is_tube
from turgor.core.meshing.sweeping.axis import core_outline, core_radius, reaches_axis, with_core, without_core
from turgor.core.meshing.sweeping.grid import grid_section
from turgor.core.meshing.sweeping.hexahedra import fill
from turgor.core.meshing.sweeping.naming import assemble
from turgor.core.meshing.sweeping.polar import polar_section
from turgor.core.meshing.sweeping.section import Fineness, SectionMesh
from turgor.foundation.errors import TurgorError, unknown

QUARTER = pi / 2

#: Kinds of cells that a mesh can be made of.
KINDS = ("tetrahedra", "hexahedra", "axisymmetric")


def swept_mesh(geometry: Geometry, fine: Fineness) -> Mesh:
    """Generate hexahedra that fill a geometry which is a swept section, and carry its names.

    All nodes lie on the true shape. In a large mesh the middles of sides and cells follow the other nodes; where that
    is not enough, it has no short cells next to feature lines, unless their length is stated. In a grid of chambers in
    a row, short cells stand next to its outer walls alone before that. Few chambers in a block, on both sides of a
    layer or slanted have shorter cells than stated, and middles that follow. Where the section is a grid or rings,
    walls get one cell unless more are requested; sections of other outlines get two.

    Parameters
    ----------
    geometry : Geometry
        What to mesh; its family tells how it is swept.
    fine : Fineness
        How fine the cells are.

    Returns
    -------
    Mesh

    Raises
    ------
    TurgorError
        If the geometry is no sweep, or its section cannot be meshed.

    Examples
    --------
    >>> from turgor.core.geometry.actuators.fast_pneunet import FastPneuNet
    >>> made = swept_mesh(FastPneuNet(chambers=2, length=20e-3).build(), Fineness(size=4e-3))
    >>> len(made.cells), made.cell_type.name, sorted(made.faces)[0]
    (373, '27-node hexahedron', 'cavity')
    """
    fine = short_at_edges(geometry, fine)
    shorter = _shorter(geometry, fine)
    if shorter != fine:
        mesh = replace(_all_nodes(geometry, shorter), serendipity=True)
        if mesh.unknown_count <= SIZING.short_cells:
            return mesh
    mesh = _all_nodes(geometry, fine)
    if is_grid_row(geometry, fine):
        free_middles, short_cells, first = fine.row, fine.row, "outer"
    else:
        free_middles, short_cells, first = SIZING.free_middles, SIZING.short_cells, "all"
    for lines in (first, "none"):
        if mesh.unknown_count <= (short_cells if mesh.serendipity else free_middles):
            break
        mesh = replace(_all_nodes(geometry, replace(fine, lines=lines)), serendipity=True)
    return mesh


def _shorter(geometry: Geometry, fine: Fineness) -> Fineness:
    """How fine chambers in a block, slanted ones in a row, and those on both sides of a layer are if they are few."""
    if fine.edge is not None or fine.lines != "all":
        return fine
    if is_block(geometry):
        return replace(fine, edge=SIZING.block_edge * fine.size)
    if is_slanted_row(geometry) or (is_grid_row(geometry, fine) and has_both_sides(geometry)):
        return replace(fine, size=SIZING.short_row * fine.size, lines="outer")
    return fine


def _all_nodes(geometry: Geometry, fine: Fineness) -> Mesh:
    """A mesh whose nodes all have unknowns of their own."""
    sweep = _sweep_of(geometry)
    section = section_of(sweep, sweep.outlines, fine)
    if not reaches_axis(sweep, section):
        return assemble(fill(sweep, section, fine), geometry, sweep)
    radius = core_radius(sweep)
    section = without_core(section_of(sweep, (*sweep.outlines, core_outline(sweep)), fine), radius)
    quarters = round((sweep.layers[-1].end - sweep.layers[0].start) / QUARTER)
    filling = with_core(fill(sweep, section, fine, multiple=2 * quarters), sweep, section, radius, fine)
    return assemble(filling, geometry, sweep)


def short_at_edges(geometry: Geometry, fine: Fineness) -> Fineness:
    """Cells of a size, shorter where stresses have no bound: at corners about which walls fold, and within a long box.

    Parameters
    ----------
    geometry : Geometry
        A sweep.
    fine : Fineness
        A length of the shortest cells and along the path stays as stated.

    Examples
    --------
    >>> from turgor.core.geometry.actuators.rectangular_bender import RectangularBender
    >>> fine = short_at_edges(RectangularBender().build(), Fineness(size=4.5e-3))
    >>> round(fine.edge * 1e3, 3), fine.along
    (0.5, 0.009)
    """
    sweep = _sweep_of(geometry)
    if sweep.hinges and not fine.corners:
        return replace(fine, corners=sweep.hinges, edge=fine.edge or SIZING.hinge * fine.size)
    if fine.edge is None and is_tube(geometry) and grid_section(sweep.outlines, fine) is not None:
        along = max(fine.along or 0.0, SIZING.tube_along * fine.size)
        cells = max(fine.wall_cells, SIZING.tube_cells if has_both_sides(geometry) else 1)
        return replace(fine, edge=SIZING.tube_edge * fine.size, along=along, wall_cells=cells)
    return fine


def check_cells(geometry: Geometry, cells: object) -> str:
    """Return a kind of cells, refusing what is none and hexahedra where these cannot be made.

    Parameters
    ----------
    geometry : Geometry
    cells : str
        As `turgor.mesh` takes it.

    Raises
    ------
    TurgorError
        If the kind is unknown, or the geometry is no sweep.

    Examples
    --------
    >>> from turgor.core.geometry.actuators.fast_pneunet import FastPneuNet
    >>> check_cells(FastPneuNet().build(), "hexahedrons")
    Traceback (most recent call last):
    turgor.TurgorError: unknown kind of cells 'hexahedrons'; did you mean 'hexahedra'? Known: ...
    """
    if cells not in KINDS:
        raise unknown("kind of cells", str(cells), KINDS)
    if cells == "hexahedra" and not isinstance(geometry.shape, FilmShape):
        _sweep_of(geometry)
    return str(cells)


def _sweep_of(geometry: Geometry) -> Sweep:
    if geometry._sweep is None:
        raise TurgorError(
            f"'{geometry.name}' cannot be filled with hexahedra: it is not built as a section moved along a line or "
            'turned about an axis. Use cells = "tetrahedra"; hexahedra fill PneuNets, tubes, benders, omnidirectional '
            "actuators and bellows of revolution, in most of their forms."
        )
    sweep: Sweep = geometry._sweep
    return sweep


def is_grid_row(geometry: Geometry, fine: Fineness) -> bool:
    """Whether chambers stand in a row and their section is a grid.

    Examples
    --------
    >>> from turgor.core.geometry.actuators.fast_pneunet import FastPneuNet
    >>> from turgor.core.geometry.actuators.rectangular_bender import RectangularBender
    >>> [is_grid_row(kind().build(), Fineness(size=3e-3)) for kind in (FastPneuNet, RectangularBender)]
    [True, False]
    """
    return is_row(geometry) and grid_section(_sweep_of(geometry).outlines, fine) is not None


def is_lattice(geometry: Geometry, fine: Fineness) -> bool:
    """Whether the section of a swept geometry is cut along its own lines or circles, not into paired triangles.

    Examples
    --------
    >>> from turgor.core.geometry.actuators.fast_pneunet import FastPneuNet
    >>> from turgor.core.geometry.actuators.semicircular_bender import SemicircularBender
    >>> [is_lattice(kind().build(), Fineness(size=3e-3)) for kind in (FastPneuNet, SemicircularBender)]
    [True, False]
    """
    sweep = _sweep_of(geometry)
    return _lattice(sweep, sweep.outlines, fine) is not None


def _lattice(sweep: Sweep, outlines: Sequence[Outline], fine: Fineness) -> SectionMesh | None:
    section = grid_section(outlines, fine)
    if section is None and not isinstance(sweep.path, Turned) and not fine.corners:  # rays have no short cells
        section = polar_section(sweep.layers, outlines, fine)
    return section


def section_of(sweep: Sweep, outlines: Sequence[Outline], fine: Fineness) -> SectionMesh:
    """Mesh a section: along its own lines or circles where it has such, else with paired triangles."""
    section = _lattice(sweep, outlines, fine)
    if section is not None:
        return section
    from turgor.core.meshing.sweeping.general import general_section  # here: most sections have lines or circles

    return general_section(outlines, fine)
