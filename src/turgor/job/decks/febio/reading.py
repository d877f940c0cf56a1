"""A .feb file as keywords of a deck, each with the element that it stands for."""

from collections.abc import Iterator
from pathlib import Path

from turgor.core.meshing.exchange.formats.abaqus import Keyword
from turgor.foundation.errors import near_match
from turgor.job.decks.febio.contact import contact_rows
from turgor.job.decks.febio.curves import curves_of
from turgor.job.decks.febio.elements import Element, read_elements
from turgor.job.decks.febio.materials import RIGID, material_rows
from turgor.job.decks.febio.meshes import CELLS, FebMesh, read_mesh
from turgor.job.decks.febio.prescribed import Prescribed, boundary_rows, load_rows
from turgor.job.decks.febio.rigid import name_obstacles, rigid_rows
from turgor.job.decks.febio.thick_shells import stated_thickness, thicken_shells

#: Units of FEBio as those of a deck.
UNITS = {"SI": "m, N, Pa", "mm-N-s": "mm, N, MPa", "mm-kg-s": "mm, mN, kPa"}

#: Sections that change no result.
_UNUSED = ("Module", "Globals", "Output", "LoadData", "Mesh", "Geometry", "MeshDomains", "Material", "Control", "Step")

#: What stands in sections of supports and loads.
_PRESCRIBED = ("Boundary", "Loads", "Rigid", "Contact", "Constraints", "Discrete", "Initial", "MeshData", "MeshAdaptor")


def stated_units(path: Path) -> str | None:
    """Return the units that a .feb file states, as an import takes them; None for other files and where it has none."""
    if path.suffix.lower() != ".feb":
        return None
    module = read_elements(path).first("Module")
    return None if module is None else UNITS.get(module.word("units"))


def keywords_of_febio(path: Path) -> list[Keyword]:
    """Read a .feb file of FEBio 3 or 4; simple files of FEBio 2.5 are read, too.

    Raises
    ------
    TurgorError
        If it is no such file, no model of solids, or damaged; the message names the element and its line.
    """
    root = read_elements(path)
    if root.tag != "febio_spec":
        root.fail("a .feb file begins with <febio_spec>.")
    for each in (root, *root.children, *(inner for section in root.children for inner in section.children)):
        if "from" in each.given or each.tag == "Include":
            each.fail("what stands in another file is not read; put it into this one.")
    module = root.first("Module")
    if module is not None and module.given.get("type", "solid") != "solid":
        module.fail("only models of solids are read.")
    mesh, rows = read_mesh(root)
    materials = [each for section in root.all("Material") for each in section.all("material")]
    of_parts = _materials_of(root, mesh, materials)
    rigid = [part for part, (_, material) in of_parts.items() if material.given.get("type") == RIGID]
    shells = {part: stated_thickness(root, of_parts[part][0], part) for part in mesh.parts if not mesh.solids[part]}
    thicken_shells(mesh, shells, rigid)
    name_obstacles(mesh, rigid)
    ends, steps = _steps(root)
    sides = mesh.sides(part for part in rigid if part not in mesh.obstacles)
    sheets = any(not solid for part, solid in mesh.solids.items() if part not in rigid)
    state = Prescribed(mesh, curves_of(root), ends[-1][0], ends[0][1], sides, sheets)
    rows += _mesh_rows(root, mesh, rigid)
    weighs = any(True for place in _places(root) for section in place.all("Loads") for _ in section.all("body_load"))
    weighs = weighs or any(step.name == "dynamic" for step in steps)
    rows += [row for each in materials if each.given.get("type") != RIGID for row in _material(each, weighs)]
    rows += _sections(root, mesh, of_parts)
    supports, loads = _prescribed(root, state, materials, rigid, alone=len(ends) == 1)
    rows += [row for row in supports if row.name != "boundary" or "amplitude" not in row.given]
    moved = [row for row in supports if row.name == "boundary" and "amplitude" in row.given]
    visco = any(row.name == "viscoelastic" for row in rows)
    for step in steps:
        rows += _step_rows(step, [*moved, *loads] if step is steps[0] else [], visco=visco)
    return [*rows, *_left(root)]


def _material(material: Element, weighs: bool) -> list[Keyword]:
    return material_rows(material, material.given.get("name") or material.given.get("id", ""), weighs=weighs)


def _materials_of(root: Element, mesh: FebMesh, materials: list[Element]) -> dict[str, tuple[Element, Element]]:
    """Domain and material of each part."""
    known: dict[str, Element] = {}
    for each in materials:
        for key in filter(None, {each.given.get("name"), each.given.get("id")}):
            known[each.first_of_its_name(known, key)] = each
    domains = {each.given.get("name", ""): each for section in root.all("MeshDomains") for each in section.children}
    owned = {}
    for part in mesh.parts:
        domain = domains.get(part, mesh.owners[f"part {part}"])
        word = domain.given.get("mat", "")
        if word not in known:
            domain.fail(f"there is no material '{word}'{near_match(word, known) or '.'}")
        owned[part] = domain, known[word]
    return owned


def _sections(root: Element, mesh: FebMesh, of_parts: dict[str, tuple[Element, Element]]) -> Iterator[Keyword]:
    """Sections of the deformable parts."""
    for part, (domain, material) in of_parts.items():
        name = material.given.get("name") or material.given.get("id", "")
        given = {"elset": _plain(part), "material": name}
        if material.given.get("type") == RIGID:
            continue
        if mesh.solids[part]:
            yield domain.keyword("solid section", [], given)
        else:
            thickness = stated_thickness(root, domain, part)
            yield domain.keyword("shell section", [repr(thickness)] if thickness else [], given)


def _mesh_rows(root: Element, mesh: FebMesh, rigid: list[str]) -> Iterator[Keyword]:
    section = root.first("Mesh", "Geometry") or root
    nodes = section.first("Nodes") or section
    yield nodes.keyword("node", [f"{i}, " + ", ".join(map(repr, xyz)) for i, xyz in mesh.points.items()])
    for part, cells in mesh.parts.items():
        owner = mesh.owners[f"part {part}"]
        if part in rigid and part not in mesh.obstacles:
            yield owner.unneeded("cells of a rigid body")
            continue
        kind = CELLS[owner.given["type"]][0]
        lines = [", ".join(map(str, [number, *nodes])) for number, nodes in cells.items()]
        yield owner.keyword("element", lines, {"type": kind, "elset": _plain(part)})
    solid = [part for part in mesh.parts if part not in rigid and mesh.solids[part]]
    yield section.keyword("elset", [_plain(part) for part in solid], {"elset": "FEBIO_ALL"})
    deformable = mesh.nodes_in(solid)
    for name, members in mesh.node_sets.items():
        inside = [str(node) for node in members if node in deformable]
        if inside and len(inside) < len(mesh.points) and not name.isdigit():
            yield section.keyword("nset", [", ".join(inside)], {"nset": _plain(name)})


def _plain(name: str) -> str:
    """A name that may stand between the commas of a deck."""
    return name.replace(",", "_").replace('"', "_")


def _places(root: Element) -> list[Element]:
    """The file and its steps."""
    return [root, *_step_elements(root)]


def _step_elements(root: Element) -> list[Element]:
    steps = [step for section in root.all("Step") for step in section.all("step")]
    return steps or [step for step in root.all("Step") if step.first("Control") is not None]  # of FEBio 2


def _steps(root: Element) -> tuple[list[tuple[float, float]], list[Keyword]]:
    """Duration and first increment of each step with its end, and the keywords that begin them."""
    ends, rows, end = [], [], 0.0
    for place in _step_elements(root) or [root]:
        control = place.first("Control")
        if control is None:
            place.fail("it has no <Control>.")
        size, count = control.number("step_size"), control.number("time_steps")
        if not size * count > 0:
            control.fail(f"step_size is {size:g} and time_steps is {count:g}; both must be positive.")
        end += size * count
        ends.append((end, size))
        rows.append(_begin(control, size, size * count))
    return [(end, ends[0][1]) for _ in ends], rows


def _begin(control: Element, size: float, period: float) -> Keyword:
    kind = control.word("analysis", "STATIC") or (control.first("analysis") or control).given.get("type", "STATIC")
    if kind.upper() in ("DYNAMIC", "1"):
        return control.keyword("dynamic", [f"{size!r}, {period!r}"])
    if kind.upper() not in ("STATIC", "STEADY-STATE", "0"):
        return control.missing(f"an analysis of the type {kind} has no form here; STATIC and DYNAMIC have one.")
    return control.keyword("static", [f"{size!r}, {period!r}"])


def _step_rows(begin: Keyword, loads: list[Keyword], *, visco: bool) -> Iterator[Keyword]:
    if begin.name == "missing":
        yield begin
        return
    yield Keyword("step", {"nlgeom": ""}, begin.path, begin.line, [], begin.label)
    relaxes = visco and begin.name == "static"
    yield Keyword("visco", {}, begin.path, begin.line, begin.lines, begin.label) if relaxes else begin
    yield from loads
    yield Keyword("end step", {}, begin.path, begin.line, [], begin.label)


def _prescribed(
    root: Element, state: Prescribed, materials: list[Element], rigid: list[str], *, alone: bool
) -> tuple[list[Keyword], list[Keyword]]:
    """Keywords of supports, contact and histories, and those of loads."""
    supports: list[Keyword] = []
    loads: list[Keyword] = []
    for place in _places(root):
        if place is not root and not alone:
            supports += [
                each.missing("supports and loads of one of several steps have no form here; state them for all.")
                for section in place.all(*_PRESCRIBED)
                for each in section.children
            ]
            continue
        for bc in (each for section in place.all("Boundary") for each in section.children):
            supports += boundary_rows(state, bc)
        for load in (each for section in place.all("Loads") for each in section.children):
            loads += load_rows(state, load)
        supports += (
            row for section in place.all("Contact") for each in section.children for row in contact_rows(state, each)
        )
        for section in place.all("Constraints", "Discrete", "Initial", "MeshAdaptor"):
            supports += [each.missing("it has no form here.") for each in section.children]
    supports += _rigid_rows(root, state, materials, rigid)
    curves = [row for row in loads if row.name in ("amplitude", "surface")]
    return [*curves, *supports], [row for row in loads if row.name not in ("amplitude", "surface")]


def _rigid_rows(root: Element, state: Prescribed, materials: list[Element], rigid: list[str]) -> Iterator[Keyword]:
    """Keywords of the rigid bodies."""
    mesh = state.mesh
    deformable = mesh.nodes_in(part for part in mesh.parts if part not in rigid)
    tied = [
        bc
        for place in _places(root)
        for s in place.all("Boundary")
        for bc in s.children
        if bc.given.get("type") == "rigid"
    ]
    rules = [rule for place in _places(root) for section in place.all("Rigid") for rule in section.children]
    domains = {each.given.get("name", ""): each for section in root.all("MeshDomains") for each in section.children}
    for body in (each for each in materials if each.given.get("type") == RIGID):
        names = {body.given.get("name"), body.given.get("id")} - {None}
        parts = [part for part in rigid if domains.get(part, mesh.owners[f"part {part}"]).given.get("mat") in names]
        nodes = mesh.nodes_in(parts)
        for bc in tied:
            if bc.word("rb") in names:
                nodes |= set(mesh.nodes_of(bc, bc.given.get("node_set", "")))
        nodes |= {mesh.backs[node] for node in nodes & set(mesh.backs)}
        own = [rule for rule in rules if rule.word("rb") in names]
        obstacles = [part for part in parts if part in mesh.obstacles]
        yield from rigid_rows(state, body, sorted(nodes & deformable), own, obstacles)
    known = {name for each in materials for name in (each.given.get("name"), each.given.get("id"))}
    yield from (rule.missing("it has no form here.") for rule in rules if rule.word("rb") not in known)


def _left(root: Element) -> Iterator[Keyword]:
    """Rows of sections that nothing else accounts for."""
    for section in root.children:
        if section.tag in _UNUSED or section.tag in _PRESCRIBED:
            continue
        yield section.missing("it has no form here.") if section.children else section.unneeded("it is empty")
    for data in (each for section in root.all("MeshData") for each in section.children):
        what = data.given.get("type") or data.given.get("var") or data.given.get("name", "")
        if what == "shell thickness":
            yield data.unneeded("thickness of the shells")
        elif what in ("mat_axis", "fiber"):
            yield data.unneeded("no law that is read has directions")
        else:
            yield data.missing("values that vary over place have no form here.")
