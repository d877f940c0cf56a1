"""Names of regions and faces of an imported mesh: from the file, from the user, and from the shape of the boundary."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from turgor.core.meshing.exchange.boundary import Sides, components, enclosed_volume, find_sides, is_cavity
from turgor.core.meshing.exchange.cavities import sides_on_stl
from turgor.core.meshing.exchange.file_sets import sets_of_file
from turgor.core.meshing.exchange.formats.raw import Ints, RawMesh
from turgor.core.meshing.exchange.frame import Frame
from turgor.core.meshing.exchange.node_selectors import ByNodes, BySides, numbered_sides
from turgor.core.meshing.exchange.selectors import Choice, parts_of, picked_cells, picked_sides
from turgor.core.meshing.exchange.solids import Solids
from turgor.foundation.errors import TurgorError, unknown
from turgor.foundation.finding import Finding, Severity
from turgor.units import mm


@dataclass(frozen=True, slots=True, kw_only=True)
class Wishes:
    """Requests of the user.

    Parameters
    ----------
    regions, faces : mapping of str to Choice
        Names with what they mean.
    cavities : mapping of str to str or Path
        Names of cavities with the STL files of their surfaces.
    frame : Frame
        Unit and axes of all files.
    merge : bool
        Whether nodes at the same place become one.
    """

    regions: Mapping[str, Choice] = field(default_factory=dict)
    faces: Mapping[str, Choice] = field(default_factory=dict)
    cavities: Mapping[str, str | Path] = field(default_factory=dict)
    frame: Frame = field(default_factory=Frame)
    merge: bool = True


def name_regions(raw: RawMesh, solids: Solids, wishes: Wishes) -> tuple[dict[str, Ints], list[Finding]]:
    """Assign one region to every cell.

    Parameters
    ----------
    raw : RawMesh
    solids : Solids
    wishes : Wishes

    Returns
    -------
    regions : dict of str to (k,) int array
    findings : list of Finding
        G22 where groups of the file could not become regions.

    Raises
    ------
    TurgorError
        If a wish names an unknown group or picks no cell.
    """
    given, findings = _regions_of_file(raw, solids)
    owner = np.full(len(solids.cells), -1, dtype=np.int64)
    names = list(given)
    for place, rows in enumerate(given.values()):
        owner[rows] = place
    centers = solids.points[solids.cells[:, : solids.kind.corners]].mean(axis=1)
    for name, choice in wishes.regions.items():
        group, selectors = parts_of(choice)
        rows = _group(solids.groups, group, "region in the file") if group else picked_cells(selectors, centers)
        if not len(rows):
            raise TurgorError(f"region '{name}' picks no cell of '{raw.path}'; {_bounds(solids)}.")
        if name not in names:
            names.append(name)
        owner[rows] = names.index(name)
    rest = np.flatnonzero(owner < 0)
    if len(rest):
        if "body" not in names:
            names.append("body")
        owner[rest] = names.index("body")
    regions = {name: np.flatnonzero(owner == place) for place, name in enumerate(names)}
    return {name: rows for name, rows in regions.items() if len(rows)}, findings


def _regions_of_file(raw: RawMesh, solids: Solids) -> tuple[dict[str, Ints], list[Finding]]:
    """Groups of cells that do not overlap: those with a material, otherwise all except groups of all cells."""
    if not raw.named or not solids.groups:
        return {}, []
    named = {name: solids.groups[name] for name in raw.sections if name in solids.groups}
    if not named:
        parts = {name: rows for name, rows in solids.groups.items() if len(rows) < len(solids.cells)}
        named = parts or dict(list(solids.groups.items())[:1])
    count = np.zeros(len(solids.cells), dtype=np.int64)
    for rows in named.values():
        count[rows] += 1
    if count.max(initial=0) <= 1:
        return named, []
    return {}, [
        _note(
            f"The groups {_listed(named)} of '{raw.path.name}' overlap, so they are not regions; all cells are 'body'.",
            "Say which ones are regions, for example regions={'base': 'NAME'}.",
        )
    ]


def name_faces(raw: RawMesh, solids: Solids, sides: Sides, wishes: Wishes) -> tuple[dict[str, Ints], list[Finding]]:
    """Name the boundary: faces of the file, wishes, cavities, and ``outside`` for the rest.

    Parameters
    ----------
    raw : RawMesh
    solids : Solids
    sides : Sides
    wishes : Wishes

    Returns
    -------
    faces : dict of str to (f,) int array
        Rows of ``sides.nodes``.
    findings : list of Finding
        G22 about guessed names, G23 about surfaces of cavities, G25 about names without a side.

    Raises
    ------
    TurgorError
        If a wish names an unknown face or picks no side.
    """
    given = faces_of_file(raw, solids, sides)
    renamed = {parts_of(choice)[0] for choice in wishes.faces.values()}
    faces = {name: rows for name, rows in given.items() if raw.named and name not in renamed}
    outer = np.flatnonzero(sides.outer)
    for name, choice in wishes.faces.items():
        group, selectors = parts_of(choice)
        by_number = [each for each in selectors if isinstance(each, ByNodes | BySides)]
        by_place = [each for each in selectors if not isinstance(each, ByNodes | BySides)]
        numbered = numbered_sides(by_number, raw, solids, sides, outer)
        rows = _group(given, group, "face in the file") if group else picked_sides(by_place, sides, numbered)
        if not len(rows):
            raise TurgorError(f"face '{name}' picks no side of '{raw.path}'; {_bounds(solids)}.")
        faces[name] = rows
    mirrors = [rows for name, rows in faces.items() if name.startswith("symmetry_")]
    findings = []
    for name, path in wishes.cavities.items():
        faces[name], finding = sides_on_stl(sides, name, path, wishes.frame, mirrors)
        findings.append(finding)
    findings += [*_name_voids(sides, faces, mirrors), *_without_sides(raw, solids, given)]
    free = np.setdiff1d(outer, np.concatenate([outer[:0], *faces.values()]))
    if len(free):
        faces["outside"] = np.union1d(faces.get("outside", free[:0]), free)
    return dict(sorted(faces.items())), findings


def faces_of_file(raw: RawMesh, solids: Solids, sides: Sides) -> dict[str, Ints]:
    """Sides of each named surface, group of flat cells, and set of nodes that holds a whole side.

    Parameters
    ----------
    raw : RawMesh
    solids : Solids
    sides : Sides

    Returns
    -------
    dict of str to (f,) int array
        Rows of ``sides.nodes``.
    """
    count = sides.kind.side.corners
    renumbered = np.append(solids.renumbered, -1)
    faces: dict[str, Ints] = {}
    surfaces = {name: corners[(corners[:, 3] < 0) == (count == 3), :count] for name, corners in raw.surfaces.items()}
    for block in raw.blocks:
        if block.kind.dimension == 2 and block.kind.corners == count:
            for name, rows in block.groups.items():
                surfaces[name] = np.concatenate(
                    [surfaces.get(name, block.nodes[:0, :count]), block.nodes[rows, :count]]
                )
    for name, corners in surfaces.items():
        rows = find_sides(sides, renumbered[corners])
        faces[name] = np.unique(rows[rows >= 0])
    outer = np.flatnonzero(sides.outer)
    for name, nodes in raw.node_sets.items():
        members = solids.renumbered[nodes]
        whole = np.isin(sides.corners[outer], members[members >= 0]).all(axis=1)
        if name not in faces and not whole.all():  # a set of all nodes is no face
            faces[name] = outer[whole]
    return {name: rows for name, rows in faces.items() if len(rows)}


def _without_sides(raw: RawMesh, solids: Solids, given: Mapping[str, Ints]) -> list[Finding]:
    """G25: sets and groups that a person named and that hold no whole side: those with nodes are node sets."""
    flat = {name for block in raw.blocks if block.kind.dimension < 3 for name in block.groups}
    solid = {name for block in raw.solids() for name in block.groups}
    some = {name for name, nodes in raw.node_sets.items() if len(nodes) < len(raw.points)}
    lost = sorted((flat | some | set(raw.surfaces)) - solid - set(given)) if raw.named else []
    sets = [name for name in lost if name in sets_of_file(raw, solids, given)]
    lost = [name for name in lost if name not in sets]
    omitted = [*raw.omitted, *([f"{_first(lost)}, which hold no whole side"] if lost else [])]
    parts = [f"Left out of '{raw.path.name}': {'; '.join(omitted)}."] if omitted else []
    parts += [f"Sets of nodes of '{raw.path.name}' without a whole side: {_first(sets)}."] if sets else []
    if not parts:
        return []
    return [
        Finding(
            code="G25",
            severity=Severity.NOTE,
            message=" ".join(parts),
            advice="Nothing is to be done unless a face is missing, which needs a set of all nodes of its sides; "
            "supports and forces take the names of sets of nodes.",
        )
    ]


def _first(names: Sequence[str], count: int = 6) -> str:
    """The first names, and how many more there are."""
    return _listed(names[:count]) + (f" and {len(names) - count} more" if len(names) > count else "")


def _name_voids(sides: Sides, faces: dict[str, Ints], mirrors: list[Ints]) -> list[Finding]:
    """Make every closed inner surface a cavity, with the name of the face on it that is called so, or a new one."""
    walls = np.setdiff1d(np.flatnonzero(sides.outer), np.concatenate([np.zeros(0, dtype=np.int64), *mirrors]))
    voids = [rows for rows in components(sides, walls) if is_cavity(sides, rows, mirrors)]
    voids.sort(key=lambda rows: tuple(np.round(sides.positions[rows].mean(axis=(0, 1)), 9)))
    new, sentences = [], []
    for rows in voids:
        on = {name: np.isin(rows, own) for name, own in faces.items() if np.isin(rows, own).any()}
        called = [name for name in on if name.startswith("cavity")]
        if any(on[name].all() for name in called):
            continue
        share = ", ".join(f"'{name}' ({int(on[name].sum())} of {len(rows)} sides)" for name in called)
        if len(called) == 1:
            faces[called[0]] = np.union1d(faces[called[0]], rows)
            sentences.append(f"{share} is now all of the closed inner surface on which it lies")
            continue
        for name in called:
            del faces[name]
        whole = _listed([name for name in on if on[name].all()])
        new.append((rows, f", walls {share}, which are no cavities" if called else f", also {whole}" if whole else ""))
    taken = [name for name in faces if name.startswith("cavity")]
    numbered = [name for name in (f"cavity_{i}" for i in range(1, len(new) + len(taken) + 1)) if name not in taken]
    alone = len(new) == len(voids) == 1 and "cavity" not in taken
    names = ["cavity"] if alone else numbered[: len(new)]
    faces.update(zip(names, (rows for rows, _ in new), strict=True))
    if names:
        volumes = [-enclosed_volume(sides, rows, sides.points.mean(axis=0)) / mm**3 for rows, _ in new]
        shown = ["" if mirrors else f" ({volume:.5g} mm³)" for volume in volumes]
        cavities = [f"'{name}'{size}{rest}" for name, size, (_, rest) in zip(names, shown, new, strict=True)]
        sentences.append(f"closed inner surfaces without the name of a cavity became {'; '.join(cavities)}")
    return [
        _note(f"{each[0].upper()}{each[1:]}.", "Name them yourself if they are not cavities.") for each in sentences
    ]


def _group(groups: Mapping[str, Ints], name: str, what: str) -> Ints:
    if name not in groups:
        raise unknown(what, name, groups)
    return groups[name]


def _listed(names: Mapping[str, Ints] | Sequence[str]) -> str:
    return ", ".join(f"'{name}'" for name in names)


def _bounds(solids: Solids) -> str:
    low, high = solids.points.min(axis=0) / mm, solids.points.max(axis=0) / mm
    spans = (f"{axis} {a:.4g} to {b:.4g}" for axis, a, b in zip("xyz", low, high, strict=True))
    return f"the mesh lies at {', '.join(spans)} mm"


def _note(message: str, advice: str) -> Finding:
    return Finding(code="G22", severity=Severity.NOTE, message=message, advice=advice)
