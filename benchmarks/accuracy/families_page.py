"""The page of `families.py`: a table of default meshes, one of references, and what is missed."""

from collections.abc import Mapping, Sequence
from typing import Any

from benchmarks.shared.tables import table

#: What default meshes are meant to reach: relative errors of changes of shape and of stress, and CPU seconds.
SHAPE, STRESS, SECONDS = 0.01, 0.03, 30.0
HEAD = ("family", "cells", "number", "unknowns", "steps", "iterations", "rejected", "mesh and solve [CPU s]",
        "estimate [CPU s]", "wall [s]", "first measure", "error", "estimate", "tip", "volume",
        "stress, 99 %")  # fmt: skip
REFERENCE = ("family", "cells", "number", "unknowns", "size [mm]", "edge [mm]", "CPU s", "first measure",
             "tip displacement [mm]", "cavity volume [mL]", "stress, 99 % [kPa]")  # fmt: skip
#: The first measure of a family is the first of these that its job has.
FIRST = ("bending_angle", "twist_angle", "tip_displacement_z", "tip_displacement_x")
#: Unit and factor from SI of the first measures.
SHOWN = {"angle": ("°", 57.29577951308232), "displacement": ("mm", 1e3)}

TEXT = """\
# Default meshes of the actuator families

Every family as `turgor init` writes it, on its default mesh, with one thread. Written by
`python benchmarks/accuracy/families.py`, which says how to renew a part of it.

*Error*, *tip*, *volume* and *stress* are errors against a finer mesh (the second table): of the first measure of the
family, of the tip's displacement, of the volume of the cavity, and of the 99th percentile of the equivalent
stress. *Estimate* is the mesh error that turgor reports for the first measure. *CPU* has meshing and solving; the
estimate takes the time stated next to it. *Wall* is the time of meshing and solving on a machine on which other work
ran. **Bold** is missed: 1 % of shape, 3 % of stress, {seconds:g} CPU s.

{rows}

{missed}

## References

Each is one mesh with shorter cells next to sharp edges (*edge*: length of these), on cavities (parallel bellows,
0.8 mm; with 1 mm they bend 0.1 % less) or everywhere, of the stated size; the tube of two materials has four cells
through its wall, twelve around a quarter of a turn, and cells of 12 mm along. A reference is one mesh, not a limit:
where stresses have no bound at an edge, a further refinement would move it by a part of the difference that the first
table shows. Where a stress varies through a wall, its 99th percentile also rises with the number of cells through it:
it is that of quadrature points, and with one cell the outer ones stand for 28 % of the wall.

The fin bends by 1.459° on its reference, and its tip moves by 0.7207 mm. Hexahedra with edges of 0.75 mm and middles
that follow (74,612 unknowns, 46 CPU s) give 1.461° and 0.7223 mm. Tetrahedra scatter about that: those of 3.5 mm with
1.2 mm at the chambers (80,443 unknowns) give 1.455° and 0.7204 mm, of 3 mm with 1.35 and 1.2 mm there 1.477° and
1.488°, 0.733 and 0.735 mm, of 1.6 mm everywhere 1.496° and 0.727 mm. So the reference is known to 0.3 % by hexahedra,
and to 2 % by both kinds. Within 30 CPU s only the first of these tetrahedra (26) come within 1 % of it, by chance as
the second show: hexahedra with edges of 1 mm give 1.450° and 0.705 mm in 35 CPU s, with two cells through the top alone
1.425° and 0.719 mm in 26, or 1.438° and 0.729 mm with middles that follow in 16.

Films have no cells, and their stress is that of 99 % of the nodes. Sides that are short next to folds do not help.
The default mesh of the pouch was refined twice (*size*: its sides then), each time from the interpolated state: its
tip moves by 15.23, 15.33 and 15.36 mm with 1,170, 4,416 and 17,148 unknowns. The path on sides of 5 mm ends at its
first step. A Kresling tube is near the vacuum at which it snaps, where each percent of stiffness is about three of
its way: it shortens by 1.637, 1.867 and 1.899 mm with sides of 10, 4 and 3 mm, and the estimate says 0.12 mm more
than with 4 mm. That falls with the size, not with its square, so that it has no reference. Stresses of the Yoshimura
bellows peak at corners of folds: 447 kPa with sides of 3.6 and of 3 mm, 411 with 2 mm. The buckling muscle with cells
of 3 mm and middles that follow (24,791 unknowns, 50 CPU s) is 1.1 % off.

{references}

{machine}
"""


def page(stored: Mapping[str, Any], families: Sequence[str], machine: Mapping[str, str]) -> str:
    """Write the page from what is stored."""
    rows, references = stored.get("rows", {}), stored.get("references", {})
    names = [name for name in families if "values" in rows.get(name, {})]
    return TEXT.format(
        seconds=SECONDS,
        rows=table(HEAD, [line(name, rows[name], references.get(name, {})) for name in names]),
        missed=misses(names, rows, references),
        references=table(REFERENCE, [truth(name, references[name]) for name in names if solved(references, name)]),
        machine="\n".join(f"- {key}: {value}" for key, value in machine.items()),
    )


def solved(stored: Mapping[str, Any], name: str) -> bool:
    """Whether a run reached its whole load."""
    row = stored.get(name, {})
    return "values" in row and bool(row["load"] >= 1.0 - 1e-9)


def errors(row: Mapping[str, Any], reference: Mapping[str, Any]) -> dict[str, float]:
    """Relative errors by measure."""
    truth = reference.get("values", {})
    return {each: value / truth[each] - 1 for each, value in row["values"].items() if truth.get(each)}


def allowed(measure: str) -> float:
    """Largest relative error of a measure."""
    return STRESS if measure == "von_mises_p99" else SHAPE


def seconds(row: Mapping[str, Any]) -> float:
    """CPU time of meshing and solving."""
    return float(row["meshing"] + row["solving"])


def line(name: str, row: Mapping[str, Any], reference: Mapping[str, Any]) -> tuple[str, ...]:
    """A row of the first table."""
    first, off = first_of(row), errors(row, reference)
    shown = [percent(each, off) for each in (first, "tip_displacement", "cavity_volume", "von_mises_p99")]
    estimate = row["estimates"].get(first, float("nan")) / abs(row["values"][first])
    return (
        name.replace("_", " "), row["kind"] if row["cells"] else "film", f"{row['cells']:,}", f"{row['unknowns']:,}",
        f"{row['steps']}",
        f"{row['iterations']}", f"{row['rejected']}", bold(f"{seconds(row):.1f}", seconds(row) > SECONDS),
        f"{row['estimating']:.1f}", f"{row['wall']:.1f}", value(first, row), shown[0], f"{estimate:.2%}", *shown[1:],
    )  # fmt: skip


def first_of(row: Mapping[str, Any]) -> str:
    """The measure that a family is made for."""
    return next(each for each in FIRST if each in row["values"])


def percent(measure: str, off: Mapping[str, float]) -> str:
    """An error, in bold where it is missed."""
    return bold(f"{off[measure]:+.2%}", abs(off[measure]) > allowed(measure)) if measure in off else "–"


def bold(text: str, missed: bool) -> str:
    """A text, in bold where something is missed."""
    return f"**{text}**" if missed else text


def value(measure: str, row: Mapping[str, Any]) -> str:
    """A first measure with its name and unit."""
    unit, factor = next(pair for key, pair in SHOWN.items() if key in measure)
    return f"{measure.replace('_', ' ')} {row['values'][measure] * factor:.4g} {unit}"


def truth(name: str, row: Mapping[str, Any]) -> tuple[str, ...]:
    """A row of the second table."""
    values, mesh = row["values"], row["mesh"]
    return (
        name.replace("_", " "), mesh.get("cells", row["kind"]), f"{row['cells']:,}", f"{row['unknowns']:,}",
        f"{mesh['size']:g}",
        f"{mesh['edge']:g}" if "edge" in mesh else "–", f"{seconds(row):.0f}", value(first_of(row), row),
        f"{values['tip_displacement'] * 1e3:.4g}", f"{values['cavity_volume'] * 1e6:.5g}",
        f"{values['von_mises_p99'] / 1e3:.4g}",
    )  # fmt: skip


def misses(names: Sequence[str], rows: Mapping[str, Any], references: Mapping[str, Any]) -> str:
    """Say what is missed, and by which families."""
    known = [name for name in names if solved(references, name)]
    off = {name: errors(rows[name], references[name]) for name in known}
    inexact = {
        "1 % of shape": [n for n in known if any(abs(e) > SHAPE for m, e in off[n].items() if "_p99" not in m)],
        "3 % of stress": [n for n in known if abs(off[n]["von_mises_p99"]) > STRESS],
        f"{SECONDS:g} CPU s": [n for n in names if seconds(rows[n]) > SECONDS],
        "the whole load": [n for n in names if not solved(rows, n)],
        "a reference": [n for n in names if n not in known],
    }
    said = [f"{what}: {', '.join(n.replace('_', ' ') for n in who)}" for what, who in inexact.items() if who]
    return f"{len(names)} families. Missed are " + "; ".join(said) + "." if said else "Nothing is missed."
