"""Sheets on faces in .inp files: shells that bend, membranes, and sheets that wrinkle."""

from math import sqrt

from turgor.core.inp.context import CALCULIX, Context, plain
from turgor.core.inp.materials import material_lines
from turgor.core.materials.laws.laws import Hooke
from turgor.core.materials.material import Material
from turgor.core.meshing.cells import TETRAHEDRON
from turgor.core.model.sheets import Sheet, Shell
from turgor.foundation.errors import TurgorError
from turgor.units import mm

#: Cells of a shell on triangles and quadrilaterals; Abaqus has no S6.
SHELLS = {("calculix", True): "S6", ("calculix", False): "S8R", ("abaqus", True): "STRI65", ("abaqus", False): "S8R"}


def sheet_lines(context: Context) -> list[str]:
    """Write sheets as cells of their own on the nodes of their faces.

    Raises
    ------
    TurgorError
        If a sheet is woven, or wrinkles in a way that the program does not have.
    """
    model, lines = context.model, list[str]()
    tetrahedra = model.mesh.cell_type is TETRAHEDRON
    for name, sheet in model.membranes.items():
        _check(name, sheet, context.program)
        bends = _bends(sheet)
        kind = SHELLS[context.program, tetrahedra] if bends else "M3D6" if tetrahedra else "M3D8R"
        lines.append(f"*ELEMENT, TYPE={kind}, ELSET={label_of(name, sheet)}")
        for side in model.mesh.face(name)[:, : 6 if tetrahedra else 8].tolist():
            lines.append(", ".join(map(str, (next(context.elements), *(node + 1 for node in side)))))
        _account(context, name, sheet, kind)
    heavy = [f"{label_of(name, model.membranes[name])}," for name in model.sheet_masses]
    return [*lines, *(["*ELSET, ELSET=Eall", *heavy] if heavy else [])]  # what weight acts on


def sheet_sections(context: Context) -> list[str]:
    """Write materials and sections of the sheets."""
    lines = []
    for name, sheet in context.model.membranes.items():
        label = label_of(name, sheet)
        material, thickness = _plate(sheet)
        lines += [f"** {plain(material.name)}", *material_lines(label, material, context.program)]
        if sheet.wrinkles:
            lines.append("*NO COMPRESSION")
        kind = "SHELL" if _bends(sheet) else "MEMBRANE"
        lines += [f"*{kind} SECTION, ELSET={label}, MATERIAL={label}", f"{thickness / mm:.12g}"]
    return lines


def label_of(name: str, sheet: Sheet) -> str:
    """Return the name of the cells of a sheet."""
    return f"{'shell' if _bends(sheet) else 'membrane'}_{plain(name)}"


def _bends(sheet: Sheet) -> bool:
    """Whether the file has a shell: Abaqus has sheets without compression as membranes only."""
    return isinstance(sheet, Shell) and not sheet.wrinkles


def _check(name: str, sheet: Sheet, program: str) -> None:
    if sheet.warp is not None:
        raise TurgorError(f"the woven sheet on '{name}' has no form in .inp files; leave it out to compare the rest.")
    if not sheet.wrinkles:
        return
    if program == CALCULIX:
        raise TurgorError(
            f"the sheet on '{name}' wrinkles, and CalculiX has no sheets that bear tension only; write for Abaqus, or "
            "leave it out to compare the rest."
        )
    if sheet.compression:
        raise TurgorError(
            f"the sheet on '{name}' bears {sheet.compression:g} of its stiffness in compression, which has no form in "
            ".inp files; 0 (*NO COMPRESSION) and 1 have one."
        )


def _plate(sheet: Sheet) -> tuple[Material, float]:
    """Material and thickness [m] of a plate that stretches, bends and weighs as the sheet does."""
    material = sheet.material
    if not isinstance(sheet, Shell) or material.bending_stiffness is None:
        return material, sheet.thickness
    from dataclasses import replace

    thickness = sqrt(12 * sheet.second_moment / sheet.thickness)
    share = sheet.thickness / thickness
    law = material.law
    assert isinstance(law, Hooke)
    density = None if material.density is None else material.density * share
    return replace(material, law=replace(law, E=law.E * share), density=density, bending_stiffness=None), thickness


def _account(context: Context, name: str, sheet: Sheet, kind: str) -> None:
    what = f"materials.{name}"
    if sheet.wrinkles:
        rest = ", without the stiffness against bending of the shell" if isinstance(sheet, Shell) else ""
        context.approximated(what, f"{kind} with *NO COMPRESSION{rest}; Abaqus may converge slowly")
    elif not _bends(sheet) and not context.for_abaqus:
        context.approximated(what, f"{kind}, of which CalculiX makes thin solids, which bend")
    elif _plate(sheet)[1] != sheet.thickness:
        text = f"{kind} of {_plate(sheet)[1] / mm:.4g} mm, which stretches, bends and weighs as the sheet does"
        context.written(what, text)
    elif not context.for_abaqus:
        context.approximated(what, f"{kind}, of which CalculiX makes thin solids")
    else:
        context.written(what, kind)
