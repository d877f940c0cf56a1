"""write_inp: a model as an .inp file of CalculiX or Abaqus."""

from collections.abc import Collection, Iterator, Sequence
from dataclasses import replace
from itertools import pairwise
from pathlib import Path

import numpy as np

from turgor.core.inp.directions import orientation_lines
from turgor.core.inp.equations import equation_lines
from turgor.core.inp.growth import expansion_lines, initial_lines
from turgor.core.inp.materials import material_lines
from turgor.core.inp.reference_points import InpDeck, fixed_lines, inp_points, point_lines
from turgor.core.materials.laws.laws import Hooke
from turgor.core.materials.material import Material
from turgor.core.meshing.cells import TETRAHEDRON
from turgor.core.meshing.exchange.formats.abaqus_sets import SIDES
from turgor.core.meshing.mesh import Mesh
from turgor.core.model.history import RAMP, points_of
from turgor.core.model.loads.load import DeckRows, Load
from turgor.core.model.model import Model
from turgor.core.model.sheets import Sheet, Shell
from turgor.core.model.supports import Support
from turgor.foundation.errors import TurgorError, unknown
from turgor.units import mm

PROGRAMS = ("calculix", "abaqus")

#: CalculiX accepts a step at a residual of 0.5 % by default; its result was then 0.5 % off in the comparison with
#: turgor.
CALCULIX_TOLERANCE = 1e-6

#: Numbers on a line of a set; the programs read up to 16.
PER_LINE = 12


def write_inp(
    model: Model,
    path: str | Path,
    *,
    program: str = "calculix",
    at: Sequence[float] = (1.0,),
    reduced: bool = True,
) -> None:
    """Write a model for CalculiX or Abaqus: nodes, cells, sets, surfaces, materials, supports, loads and steps.

    Lengths are in mm, forces in N, stresses in MPa, masses in tonnes; the file says so. Pressures follow the surface.
    Each requested load factor is the end of a step with large displacements, at which displacements and stresses are
    written. Hexahedra of 27 nodes become ones of 20. Contact of walls with each other is left out; the file says so.

    Parameters
    ----------
    model : Model
        What to write.
    path : str or Path
        The file.
    program : str
        ``"calculix"``, whose cells refuse incompressible materials, or ``"abaqus"``, with its hybrid cells.
    at : sequence of float [-]
        Load factors at which steps end, rising, more than 0 and up to 1.
    reduced : bool
        Whether hexahedra are integrated with 8 points instead of 27, which locks less.

    Raises
    ------
    TurgorError
        If something has no form in the file: a body force, a prescribed displacement of a face, a law without a
        counterpart, fibers, an obstacle, a bond, a load that follows its point.
    """
    if program not in PROGRAMS:
        raise unknown("program", program, PROGRAMS)
    _check_factors(at)
    _check_extras(model)
    points, plain = inp_points(model, program), {name: _plain(name) for name in model.mesh.faces}
    deck = InpDeck(model.mesh, points, plain, 1 / model.mesh.symmetry_factor)
    acting, foams = _acting(model, deck), [name for name, each in model.region_materials.items() if each.is_foam]
    lines = [
        f"** {_plain(model.mesh.name)}, written by turgor for {program}",
        "** units: mm, N, MPa, tonne, s; the time is the load factor",
        *_contact_note(model),
        *_mesh_lines(model.mesh, foams, program, reduced),
        *_membrane_lines(model),
        *_material_lines(model, program),
        *point_lines(model, points, plain),
        *_support_lines(model, deck),
        *initial_lines(model),
        *_amplitude_lines(acting),
        *_step_lines(model, at, program, acting),
    ]
    Path(path).write_text("\n".join(lines) + "\n", encoding="ascii", errors="replace")


def _check_extras(model: Model) -> None:
    bent = [name for name, membrane in model.membranes.items() if isinstance(membrane, Shell)]
    what = [f"winding of fibers on '{fibers.place}'" for fibers in model.reinforcements]
    what += [f"the sheet on '{name}', which wrinkles," for name, sheet in model.membranes.items() if sheet.wrinkles]
    what += [f"the woven sheet on '{name}'" for name, sheet in model.membranes.items() if sheet.warp is not None]
    what += [f"the obstacle '{obstacle.name}'" for obstacle in model.contact.obstacles]
    what += [f"the bond '{bond.name}'" for bond in model.bonds]
    if what:
        raise TurgorError(f"{what[0]} has no form in .inp files; leave it out to compare the rest.")
    if bent:
        raise TurgorError(
            f"the shell on '{bent[0]}' has no form in .inp files; make it a membrane, or leave it out, to compare the "
            "rest."
        )


def _contact_note(model: Model) -> list[str]:
    if model.contact.for_mesh(model.mesh) is None:
        return []
    return ["** without contact: walls that meet pass through each other"]


def compressible(model: Model, poisson: float) -> Model:
    """Give the incompressible materials of a model a Poisson's ratio at rest, for programs without cells for them.

    Parameters
    ----------
    model : Model
    poisson : float [-]
        From 0 to less than 0.5; cells with displacements only lock the more, the nearer it is to 0.5.

    Returns
    -------
    Model

    Examples
    --------
    >>> from turgor.core.geometry.actuators.fast_pneunet import FastPneuNet
    >>> from turgor.core.materials.laws.laws import NeoHooke
    >>> from turgor.core.materials.material import Material
    >>> from turgor.core.meshing.generate import mesh
    >>> from turgor.core.model.loads import Pressure
    >>> rubber = Material(name="rubber", law=NeoHooke(C10=0.5e5))
    >>> part = mesh(FastPneuNet(chambers=1, length=10e-3).build(), size=4e-3)
    >>> model = Model(part, {"body": rubber, "base": rubber}, "fixed", [Pressure("cavity", 1e3)])
    >>> round(compressible(model, 0.475).materials["body"].bulk_modulus)
    1966667
    """
    if not 0 <= poisson < 0.5:
        raise TurgorError(f"poisson is {poisson}; allowed is 0 to less than 0.5.")
    materials: dict[str, Material | Sheet] = dict(model.materials)
    for name, material in model.region_materials.items():
        law = material.law
        if material.incompressible and not isinstance(law, Hooke):
            bulk = law.shear_modulus * 2 * (1 + poisson) / (3 * (1 - 2 * poisson))
            materials[name] = replace(material, bulk_modulus=bulk)
    return replace(model, materials=materials)


def _check_factors(at: Sequence[float]) -> None:
    rising = [0.0, *at]
    if not at or any(not a < b <= 1 for a, b in pairwise(rising)):
        raise TurgorError(f"at is {tuple(at)}; load factors must rise, more than 0 and up to 1.")


def _plain(name: str) -> str:
    """A name as these programs take it: no blanks and commas."""
    return "".join(letter if (letter.isalnum() and letter.isascii()) or letter in "_-" else "_" for letter in name)


def _mesh_lines(mesh: Mesh, foams: Collection[str], program: str, reduced: bool) -> list[str]:
    """Nodes, cells and sets; regions of foam have no hybrid cells in Abaqus, since they need none."""
    tetrahedra = mesh.cell_type is TETRAHEDRON
    kind = "C3D10" if tetrahedra else ("C3D20R" if reduced else "C3D20")
    hybrid = "H" if program == "abaqus" else ""
    cells = mesh.cells[:, : 10 if tetrahedra else 20]
    used = np.unique(cells)
    lines = ["*NODE, NSET=Nall"]
    lines += [
        f"{node + 1}, {x:.12g}, {y:.12g}, {z:.12g}"
        for node, (x, y, z) in zip(used.tolist(), (mesh.points[used] / mm).tolist(), strict=True)
    ]
    for name, rows in mesh.regions.items():
        lines.append(f"*ELEMENT, TYPE={kind}{'' if name in foams else hybrid}, ELSET={_plain(name)}")
        for row in rows.tolist():
            lines += _row_of([row + 1, *(cells[row] + 1).tolist()], first=16)
    lines += ["*ELSET, ELSET=Eall", *(f"{_plain(name)}," for name in mesh.regions)]
    for name, sides in mesh.faces.items():
        nodes = np.unique(sides[:, : 6 if tetrahedra else 8])
        lines += [f"*NSET, NSET={_plain(name)}", *_row_of((nodes + 1).tolist(), first=PER_LINE)]
        lines.append(f"*SURFACE, NAME={_plain(name)}, TYPE=ELEMENT")
        lines += [f"{cell + 1}, S{side}" for cell, side in cell_faces(mesh, name)]
    return lines


def _row_of(numbers: Sequence[int], first: int) -> list[str]:
    """Numbers on as many lines as needed; all but the last end with a comma."""
    parts = [numbers[start : start + first] for start in range(0, len(numbers), first)]
    return [", ".join(map(str, part)) + ("," if i + 1 < len(parts) else "") for i, part in enumerate(parts)]


def cell_faces(mesh: Mesh, name: str) -> list[tuple[int, int]]:
    """Find the cell and the number of its face, as Abaqus counts them, of each side of a named face.

    Parameters
    ----------
    mesh : Mesh
    name : str
        Name of the face.

    Returns
    -------
    list of (int, int)
        Cell, counted from 0, and face, counted from 1.
    """
    corners = mesh.cell_type.corners
    width = mesh.cell_type.side.corners
    table = np.array(SIDES[corners])
    all_sides = np.sort(mesh.cells[:, table].reshape(-1, width), axis=1)
    of_face = np.sort(mesh.face(name)[:, :width], axis=1)
    _, number = np.unique(np.concatenate([all_sides, of_face]), axis=0, return_inverse=True)
    number = np.asarray(number).ravel()
    first = np.full(number.max() + 1, -1, dtype=np.int64)
    first[number[: len(all_sides)][::-1]] = np.arange(len(all_sides))[::-1]
    places = first[number[len(all_sides) :]]
    if (places < 0).any():
        raise TurgorError(f"face '{name}' has sides that belong to no cell.")
    return [(place // len(table), place % len(table) + 1) for place in places.tolist()]


def _membrane_lines(model: Model) -> list[str]:
    """Membranes as cells of their own on the nodes of the face."""
    lines = []
    number = len(model.mesh.cells)
    tetrahedra = model.mesh.cell_type is TETRAHEDRON
    for name in model.membranes:
        kind, width = ("M3D6", 6) if tetrahedra else ("M3D8R", 8)
        lines.append(f"*ELEMENT, TYPE={kind}, ELSET=membrane_{_plain(name)}")
        for side in model.mesh.face(name)[:, :width].tolist():
            number += 1
            lines.append(", ".join(str(value) for value in (number, *(node + 1 for node in side))))
    heavy = [f"membrane_{_plain(name)}," for name in model.sheet_masses]
    return [*lines, *(["*ELSET, ELSET=Eall", *heavy] if heavy else [])]  # what weight acts on


def _material_lines(model: Model, program: str) -> list[str]:
    lines = []
    for name, material in model.region_materials.items():
        lines += [f"** {_plain(material.name)}", *material_lines(_plain(name), material, program)]
        axes, directed = orientation_lines(_plain(name), material)
        section = f"*SOLID SECTION, ELSET={_plain(name)}, MATERIAL={_plain(name)}{directed}"
        lines += [*expansion_lines(model, name), *axes, section]
    for name, membrane in model.membranes.items():
        label = f"membrane_{_plain(name)}"
        lines += [f"** {_plain(membrane.material.name)}", *material_lines(label, membrane.material, program)]
        lines += [f"*MEMBRANE SECTION, ELSET={label}, MATERIAL={label}", f"{membrane.thickness / mm:.12g}"]
    return lines


def _support_lines(model: Model, deck: InpDeck) -> list[str]:
    faces = (support for support in model.supports if support.place not in deck.points)
    rows = [row for support in faces for row in support.boundary_rows(deck)]
    equations, along = equation_lines(model)
    return [*equations, "*BOUNDARY", *fixed_lines(model, deck.points), *rows, *along]


def _acting(model: Model, deck: InpDeck) -> list[DeckRows]:
    """Displacements and loads of the model, in the order of the numbers of the amplitudes."""
    acting: list[Load | Support] = [*model.loads, *(each for each in model.supports if each.place in deck.points)]
    every = [rows for each in acting for rows in each.deck_rows(deck) if rows.rows]
    return list(dict.fromkeys(every))  # the states of all bodies are one temperature


def _amplitude_lines(acting: Sequence[DeckRows]) -> list[str]:
    """Every load follows the time, which is the load factor, over all steps."""
    lines = ["*AMPLITUDE, NAME=ramp, TIME=TOTAL TIME", "0., 0., 1., 1."]
    for number, each in enumerate(acting, start=1):
        if each.history != RAMP:
            lines.append(f"*AMPLITUDE, NAME=history_{number}, TIME=TOTAL TIME")
            lines += [f"{factor:.12g}, {share:.12g}" for factor, share in points_of(each.history)]
    return lines


def _acting_lines(acting: Sequence[DeckRows]) -> Iterator[str]:
    """Loads of the first step."""
    for number, each in enumerate(acting, start=1):
        yield f"{each.keyword}, AMPLITUDE={'ramp' if each.history == RAMP else f'history_{number}'}"
        yield from each.rows


def _step_lines(model: Model, at: Sequence[float], program: str, acting: Sequence[DeckRows]) -> list[str]:
    lines = []
    for number, (start, end) in enumerate(zip([0.0, *at], at, strict=False)):
        length = end - start
        lines += ["*STEP, NLGEOM, INC=1000" if program == "calculix" else "*STEP, NLGEOM=YES, INC=1000"]
        if program == "calculix":
            lines += ["*CONTROLS, PARAMETERS=FIELD", f"{CALCULIX_TOLERANCE:g}, {CALCULIX_TOLERANCE:g}"]
        lines.append(_static(model, program))
        lines.append(f"{length / 20:.12g}, {length:.12g}, {length * 1e-5:.3g}, {length / 10:.12g}")
        if number == 0:
            lines += _acting_lines(acting)
        lines += ["*NODE FILE, FREQUENCY=1000", "U", "*EL FILE, FREQUENCY=1000", "S"]
        lines += ["*NODE PRINT, NSET=Nall, FREQUENCY=1000", "U", "*END STEP"]
    return lines


def _static(model: Model, program: str) -> str:
    """The kind of step: one so slow that everything has relaxed, as that of a path without time."""
    relaxes = any(material.viscoelasticity is not None for material in model.region_materials.values())
    return "*STATIC, LONG TERM" if relaxes and program == "abaqus" else "*STATIC"
