"""import_deck: a deck of Abaqus, CalculiX or FEBio as a job file, with an account of what was understood."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import tomlkit

from turgor.core.meshing.exchange.formats.abaqus import Keyword
from turgor.foundation.errors import TurgorError
from turgor.job.decks.account import MISSING, Account, DeckRow
from turgor.job.decks.contact import contact_of
from turgor.job.decks.deck import Deck, read_deck
from turgor.job.decks.directions import axes_of
from turgor.job.decks.febio.reading import stated_units
from turgor.job.decks.loads import loads_of
from turgor.job.decks.materials import materials_of
from turgor.job.decks.mirrors import take_mirrors
from turgor.job.decks.motions.equations import equations_of
from turgor.job.decks.motions.inertia import damping_of
from turgor.job.decks.motions.loose import has_loose_body
from turgor.job.decks.motions.obstacles import obstacles_of
from turgor.job.decks.motions.rigid import points_of
from turgor.job.decks.motions.temperatures import initial_of, is_heated, temperatures_of
from turgor.job.decks.motions.threads import threads_of
from turgor.job.decks.names import MeshNames
from turgor.job.decks.parts import entries_of, plane_table, stays_apart, ties_of
from turgor.job.decks.steps import Path as DeckPath
from turgor.job.decks.steps import path_of
from turgor.job.decks.supports import supports_of
from turgor.job.decks.units import USUAL, DeckUnits
from turgor.job.output.lock import material_table
from turgor.job.tables.fibers import fibers_tables
from turgor.job.tables.loads import loads_table
from turgor.job.tables.supports import supports_table
from turgor.units import format_quantity

#: Keywords that change no result.
_UNUSED = frozenset(
    ("heading", "node print", "el print", "node file", "el file", "node output", "element output", "output",
     "contact print", "contact file", "contact output", "section print", "preprint", "restart", "controls", "monitor",
     "part", "end part", "assembly", "end assembly", "instance", "end instance", "include", "step", "static", "visco",
     "dynamic", "time points", "print", "energy print", "energy output", "energy file", "no analysis",
     "section controls", "orientation", "filter", "history output", "physical constants")
)  # fmt: skip


@dataclass(frozen=True, slots=True, kw_only=True)
class DeckImport:
    """A deck as a job, and what became of each of its keywords.

    Parameters
    ----------
    name : str
        Name of the job: that of the deck.
    job : str
        Text of the job file.
    mesh : str
        Text of the mesh file that the job names, ``NAME-mesh.inp``.
    surfaces : mapping of str to str
        Names and texts of the STL files of obstacles.
    rows : tuple of DeckRow
        In the order of the deck.
    """

    name: str
    job: str
    mesh: str
    surfaces: Mapping[str, str]
    rows: tuple[DeckRow, ...]

    @property
    def missing(self) -> tuple[DeckRow, ...]:
        """Rows without which the job is another model than the deck."""
        return tuple(row for row in self.rows if row.verdict == MISSING)

    def write(self, folder: str | Path, *, force: bool = False) -> Path:
        """Write the job and its mesh into a folder.

        Parameters
        ----------
        folder : str or Path
        force : bool
            Whether existing files are replaced.

        Returns
        -------
        Path
            The job file.
        """
        place = Path(folder)
        files = {place / f"{self.name}.toml": self.job, place / f"{self.name}-mesh.inp": self.mesh}
        files |= {place / name: text for name, text in self.surfaces.items()}
        taken = [file for file in files if file.exists()]
        if taken and not force:
            raise TurgorError(
                f"'{taken[0]}' is there already.",
                python="Choose another folder, or replace it with force=True.",
                command="Choose another folder with --output, or replace it with --force.",
            )
        place.mkdir(parents=True, exist_ok=True)
        for file, text in files.items():
            file.write_text(text, encoding="utf-8")
        return place / f"{self.name}.toml"


def import_deck(path: str | Path, *, units: str | None = None, partial: bool = False) -> DeckImport:
    """Read a deck of Abaqus, CalculiX or FEBio as a job: mesh, materials, supports, loads, contact and steps.

    Parameters
    ----------
    path : str or Path
        The .inp or .feb file.
    units : str, optional
        Units of length, force and stress of its numbers, such as ``"m, N, Pa"``; those that a .feb file states by
        default, else ``"mm, N, MPa"``.
    partial : bool
        Whether a deck with keywords that have no form here becomes a job without them, which is another model. By
        default such a deck is refused.

    Returns
    -------
    DeckImport

    Raises
    ------
    TurgorError
        If the deck cannot be read, or is not understood as a whole and ``partial`` is False; the message names the
        keywords with their lines.
    """
    file, account = Path(path), Account()
    deck = read_deck(file)
    units = units or stated_units(file) or USUAL
    scale = DeckUnits.of(units)
    if not deck.solids:
        raise TurgorError(
            f"'{file}' has no solid or plane cells; bodies are solids here, and sheets lie on their faces."
        )
    names = MeshNames(deck)
    moves = any(each.name == "dynamic" for step in deck.steps for each in step)
    needed = [word for word, is_needed in (("expansion", is_heated(deck)), ("damping", moves)) if is_needed]
    materials = materials_of(deck.model, scale, account, needed)
    threads = threads_of(names, materials, scale, account)
    entries = entries_of(deck, materials, names, scale, account)
    way = path_of(deck, initial_of(deck, account), account)
    axes, (contact, rigid) = axes_of(deck, deck.model, account), contact_of(deck, scale, account)
    if contact["self_contact"] and has_loose_body(way, axes):
        _stabilize(way, account)
    images = take_mirrors(way, names)
    supports = (
        *supports_of(way, names, axes, scale, account),
        *equations_of(way, names, axes, account),
        *ties_of(deck, names, account),
    )
    loads = (
        *loads_of(way, names, axes, scale, account, images),
        *temperatures_of(way, names, entries, account),
    )
    points = points_of(way, names, scale, account)
    obstacles, surfaces = obstacles_of(way, names, scale, rigid, account)
    damping = damping_of(way, account)
    names.add_others()
    _account_rest(deck, account)
    apart = {"merge": False} if stays_apart(deck) else {}
    content = {
        "name": file.stem,
        "mesh": {"file": f"{file.stem}-mesh.inp", "unit": scale.word, **apart, **plane_table(deck, scale, account)},
        "materials": {name: material_table(entry) for name, entry in entries.items()},
        "fibers": fibers_tables(threads),
        "supports": supports_table(supports),
        "points": points,
        "loads": loads_table(loads),
        "contact": contact,
        "obstacles": obstacles,
        "procedure": _procedure(way) | damping,
    }
    rows = account.sorted()
    job = _head(file, units, rows) + _toml(content)
    result = DeckImport(name=file.stem, job=job, mesh=names.text(), surfaces=surfaces, rows=rows)
    if result.missing and not partial:
        listed = "\n".join(f"  {row}" for row in result.missing)
        raise TurgorError(
            f"'{file}' has what a job cannot express; leaving it out, with",
            python=f"partial=True, makes another model:\n{listed}",
            command=f"--partial, makes another model:\n{listed}",
        )
    return result


def _toml(content: Mapping[str, Any]) -> str:
    return tomlkit.dumps({key: value for key, value in content.items() if value})


def _head(file: Path, units: str, rows: Iterable[DeckRow]) -> str:
    lines = [f"# From the deck {file.name}, whose numbers are taken to be in {units} and seconds."]
    lost = [row for row in rows if row.verdict == MISSING]
    if lost:
        lines += ["# It is another model than the deck, because this is missing:", *(f"#   {row}" for row in lost)]
    return "\n".join(line.replace("\n", " ") for line in lines) + "\n\n"


def _stabilize(way: DeckPath, account: Account) -> None:
    """Let a body that contact alone stops come to rest."""
    keyword = next((each for step in way.deck.steps for each in step if each.name == "static"), None)
    if keyword is not None and not way.relaxes and not way.arc_length:
        way.stabilized = True
        account.taken(keyword, "procedure 'stabilized', because contact alone stops a body")


def _procedure(way: DeckPath) -> dict[str, Any]:
    """Load control to the end of the last step, which hits the end of each."""
    total = way.ends[-1] if way.ends else 1.0
    at = [round(end / total, 12) for end in way.ends[:-1]]
    marked = {"dynamic": way.moves, "arc_length": way.arc_length, "stabilized": way.stabilized, "static": True}
    kind = next(name for name, is_so in marked.items() if is_so)
    values: dict[str, Any] = {"type": kind}
    if at and not way.arc_length:
        values["at"] = at
    if way.relaxes or way.moves:
        values["duration"] = format_quantity(total, "s")
    return values


def _account_rest(deck: Deck, account: Account) -> None:
    """Rows of all keywords that nothing else accounts for."""
    for keyword in (*deck.model, *(each for step in deck.steps for each in step)):
        if keyword.name in _COUNTED:
            account.taken(keyword, _counted(keyword))
        elif keyword.name in _UNUSED:
            if keyword.name not in ("step", "static", "visco", "dynamic"):
                account.not_needed(keyword, "it changes no result")
        elif keyword.name == "not needed":  # of a .feb file
            account.not_needed(keyword, keyword.lines[0])
        elif keyword.name == "missing":
            account.missing(keyword, keyword.lines[0])
        elif not account.has(keyword):
            account.missing(keyword, "it has no form here, or none in this place.")


_COUNTED = {"node": "nodes", "nset": "nodes or sets", "elset": "cells or sets", "surface": "sides"}


def _counted(keyword: Keyword) -> str:
    count = len(keyword.lines)
    return f"{count} line{'' if count == 1 else 's'} of {_COUNTED[keyword.name]}"
