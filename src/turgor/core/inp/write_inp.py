"""write_inp: a model as an .inp file of CalculiX or Abaqus."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from pathlib import Path

import numpy as np

from turgor.core.engine.mass import refuse_turning
from turgor.core.inp.account import InpNote, by_verdict
from turgor.core.inp.cells import mesh_lines
from turgor.core.inp.contact import RigidNode, contact_lines, rigid_rows
from turgor.core.inp.context import ABAQUS, CALCULIX, Context, plain
from turgor.core.inp.directions import orientation_lines
from turgor.core.inp.equations import equation_lines
from turgor.core.inp.growth import expansion_lines, initial_lines
from turgor.core.inp.materials import material_lines
from turgor.core.inp.reference_points import InpDeck, fixed_lines, inp_points, point_lines
from turgor.core.inp.sheets import sheet_lines, sheet_sections
from turgor.core.inp.steps import acting_rows, damping_lines, history_lines, velocity_lines
from turgor.core.inp.threads import thread_lines
from turgor.core.materials.laws.laws import Hooke
from turgor.core.materials.material import Material
from turgor.core.model.loads.load import DeckRows
from turgor.core.model.model import Model
from turgor.core.model.places import NodesAt
from turgor.core.model.sheets import Sheet
from turgor.core.solvers.procedures.procedure import Procedure
from turgor.core.solvers.procedures.static import Static
from turgor.core.solvers.stage_sequence import questions
from turgor.foundation.errors import TurgorError, unknown

PROGRAMS = (CALCULIX, ABAQUS)


def write_inp(
    model: Model,
    path: str | Path,
    *,
    program: str = CALCULIX,
    at: Sequence[float] = (),
    reduced: bool = True,
    procedure: Procedure | None = None,
) -> tuple[InpNote, ...]:
    """Write a model for CalculiX or Abaqus: nodes, cells, sheets, threads, contact, supports, loads and steps.

    Lengths are in mm, forces in N, stresses in MPa, masses in tonnes; the file says so. Pressures follow the surface.
    Each requested load factor is the end of a step with large displacements, at which displacements and stresses are
    written. The head of the file lists what is left out, approximated and written.

    Parameters
    ----------
    model : Model
        What to write.
    path : str or Path
        The file.
    program : str
        ``"calculix"``, whose cells refuse incompressible materials, or ``"abaqus"``, with its hybrid cells.
    at : sequence of float [-]
        Load factors at which steps end, rising, more than 0 and up to 1; those of the procedure by default.
    reduced : bool
        Whether hexahedra are integrated with 8 points instead of 27, which locks less.
    procedure : Procedure, optional
        How the path is followed, stages included; `Static` by default.

    Returns
    -------
    tuple of InpNote
        What became of each part of the model.

    Raises
    ------
    TurgorError
        If something has no form in the file: a body force, a law without a counterpart, a bond, a load that follows
        its point, a procedure that seeks pressures.
    """
    file = inp_file(model, procedure or Static(), program=program, at=at, reduced=reduced)
    file.write(path)
    return file.notes


@dataclass(frozen=True, slots=True)
class InpFile:
    """An .inp file before it is written.

    Parameters
    ----------
    title : str
    notes : tuple of InpNote
        Its account.
    lines : tuple of str
        What follows the account.
    """

    title: str
    notes: tuple[InpNote, ...]
    lines: tuple[str, ...]

    def write(self, path: str | Path) -> None:
        """Write the file, with its account at the head."""
        units = "** units: mm, N, MPa, tonne, s; the time is the load factor where nothing has a duration"
        text = "\n".join([f"** {self.title}", units, *(f"** {note}" for note in by_verdict(self.notes)), *self.lines])
        Path(path).write_text(text + "\n", encoding="ascii", errors="replace")


def inp_file(
    model: Model, procedure: Procedure, *, program: str, at: Sequence[float] = (), reduced: bool = True
) -> InpFile:
    """Make an .inp file; arguments and errors as of `write_inp`."""
    if program not in PROGRAMS:
        raise unknown("program", program, PROGRAMS)
    way = _procedure(procedure, at)
    _check_extras(model, way)
    context, models = Context.of(model, program), questions(model, way)
    initial, grown = initial_lines(models)
    points, names = inp_points(model, program), {name: plain(name) for name in model.mesh.faces}
    deck = InpDeck(model.mesh, points, names, 1 / model.mesh.symmetry_factor)
    cells = [*mesh_lines(context, reduced), *sheet_lines(context)]
    sections = _material_lines(context, way, grown)
    parts = [*thread_lines(context), *point_lines(context, points, names)]
    contact, rigid = contact_lines(context, models)
    acting = [[*acting_rows(each, deck), *_rigid_rows(each, rigid)] for each in models]
    amplitudes, steps = history_lines(context, way, acting)
    lines = [
        *(cells + sections + parts + contact),
        *_support_lines(models[0], deck),
        *initial,
        *velocity_lines(way, program),
        *(amplitudes + steps),
    ]
    title = f"{plain(model.mesh.name)}, written by turgor for {program}"
    return InpFile(title, tuple(context.notes), tuple(lines))


def _procedure(procedure: Procedure, at: Sequence[float]) -> Procedure:
    """The procedure with the requested load factors."""
    if at:
        rising = [0.0, *at]
        if any(not a < b <= 1 for a, b in pairwise(rising)):
            raise TurgorError(f"at is {tuple(at)}; load factors must rise, more than 0 and up to 1.")
        if procedure.stages:
            raise TurgorError(f"at is {tuple(at)}, but stages state load factors of their own; leave it out.")
        return replace(procedure, at=tuple(at))  # type: ignore[type-var]
    return procedure


def _check_extras(model: Model, procedure: Procedure) -> None:
    what = [f"the bond '{bond.name}'" for bond in model.bonds]
    what += ["a film without a solid"] if not len(model.mesh.cells) else []
    what += ["a sector of a whole, whose cuts follow each other,"] if model.mesh.wedge is not None else []
    faces = [getattr(each, "face", "") for each in (*model.supports, *model.loads)]
    places = [(each.name, each.nodes(model.mesh)) for each in faces if isinstance(each, NodesAt)]
    inside = [name for name, nodes in places if not np.isin(nodes, model.mesh.cells[:, :20]).any()]
    what += [f"'{name}', a middle of a side or cell, which hexahedra of 20 nodes lack," for name in inside]
    if any(part.has_inertia for part in procedure.parts()):
        refuse_turning(model)
        heavy = [each.name for each in model.points.values() if each.mass or any(each.inertia)]
        heavy += [load.place for load in model.loads if load.attached_mass]
        what += [f"the mass at reference point '{name}' in a motion" for name in heavy]
    if what:
        raise TurgorError(f"{what[0]} has no form in .inp files; leave it out to compare the rest.")


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


def _material_lines(context: Context, procedure: Procedure, grown: Model) -> list[str]:
    lines = []
    for name, material in context.model.region_materials.items():
        lines += [f"** {plain(material.name)}", *material_lines(plain(name), material, context.program)]
        lines += damping_lines(procedure, context.program)
        axes, directed = orientation_lines(plain(name), material)
        section = f"*SOLID SECTION, ELSET={plain(name)}, MATERIAL={plain(name)}{directed}"
        lines += [*expansion_lines(grown, name), *axes, section]
        context.written(f"materials.{name}", type(material.law).__name__)
    return [*lines, *sheet_sections(context)]


def _support_lines(model: Model, deck: InpDeck) -> list[str]:
    faces = (support for support in model.supports if support.place not in deck.points)
    rows = [row for support in faces for row in support.boundary_rows(deck)]
    equations, along = equation_lines(model)
    return [*equations, "*BOUNDARY", *fixed_lines(model, deck.points), *rows, *along]


def _rigid_rows(model: Model, nodes: Iterable[RigidNode]) -> list[DeckRows]:
    """How obstacles move in a stage."""
    out = []
    for place, values in rigid_rows(model, tuple(nodes)):
        peak = max((value for _, value in values), key=abs) or 1.0
        history = tuple((s, value / peak) for s, value in values)
        out.append(DeckRows("*BOUNDARY", history, (f"{place}, {peak:.12g}",)))
    return out
