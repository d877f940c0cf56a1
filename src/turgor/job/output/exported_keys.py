"""Keys of a job in the account of its .inp file: each is in the file, or named as left out."""

import tomllib
from collections.abc import Iterable, Mapping, Sequence

from turgor.core.inp.account import APPROXIMATED, LEFT_OUT, WRITTEN, InpNote
from turgor.foundation.errors import TurgorError
from turgor.job.job import Job
from turgor.job.output.lock import lock_text

#: What becomes of tables that the writer of the model does not account for by itself.
_TABLES: Mapping[str, tuple[str, str]] = {
    "name": (WRITTEN, "name of the file"),
    "actuator": (WRITTEN, "as the cells of its mesh"),
    "bodies": (WRITTEN, "as the cells of their mesh"),
    "supports": (WRITTEN, "*BOUNDARY and *EQUATION"),
    "loads": (WRITTEN, "in the steps"),
    "equations": (WRITTEN, "*EQUATION"),
    "points": (WRITTEN, "a node that is tied to its face, with what acts on it"),
    "output": (LEFT_OUT, "measures, pictures and reports are turgor's; the file prints displacements and stresses"),
    "engine": (LEFT_OUT, "threads are for the command of the program"),
}

#: What becomes of single keys.
_KEYS: Mapping[str, tuple[str, str]] = {
    "mesh.target": (LEFT_OUT, "the file has the mesh before any refinement"),
    "mesh.target_measure": (LEFT_OUT, "see mesh.target"),
    "mesh.most_unknowns": (LEFT_OUT, "see mesh.target"),
    "mesh.imperfection": (WRITTEN, "nodes of the imperfect shape"),
    "contact.tolerance": (LEFT_OUT, "other programs do not raise a penalty until walls are that close"),
    "contact.friction": (WRITTEN, "*FRICTION of the pairs of self-contact"),
    "contact.stiffness": (WRITTEN, "*SURFACE BEHAVIOR of the pairs of self-contact"),
    "contact.elastic_slip": (APPROXIMATED, "*FRICTION; CalculiX has a stiffness along the wall instead"),
    "contact.self_contact": (WRITTEN, "no pair: no walls face each other, or it is switched off"),
}

#: Tables whose keys the writer of the model accounts for, one table each or as a whole.
_BY_NAME = ("materials", "fibers", "bonds", "obstacles", "stages")
_AS_A_WHOLE = ("mesh", "procedure")

#: What a material states for findings, which is no part of a model.
_FAILURE = ("strength", "crack_growth")

#: Keys of tables by name that the writer knows; a new one is refused until it is written.
_KNOWN: Mapping[str, frozenset[str]] = {
    "obstacles": frozenset(
        ("shape", "file", "unit", "point", "normal", "center", "radius", "axis", "length", "size", "rounding",
         "friction", "path", "rotation", "about", "spring", "face", "stiffness", "elastic_slip", "sha256")
    ),
    "stages": frozenset(("name", "procedure", "loads", "displacements", "moves")),
}  # fmt: skip


def key_notes(job: Job, of_model: Sequence[InpNote]) -> tuple[InpNote, ...]:
    """Return the notes on what a job states, of which the model has its own.

    Parameters
    ----------
    job : Job
    of_model : sequence of InpNote
        Those of the model.

    Raises
    ------
    TurgorError
        If a key has no place in the account, so that the file would silently lack it.
    """
    tables = tomllib.loads(lock_text(job, {}))
    known = {note.what for note in of_model}
    notes = list[InpNote]()
    for table, content in tables.items():
        if table in _TABLES:
            if content:
                notes.append(InpNote(table, *_TABLES[table]))
        elif table in _BY_NAME:
            notes += _by_name(table, _named(content), known)
        elif table != "written_by":
            notes += _single(table, content, known)
    return tuple(notes)


def _named(content: object) -> dict[str, dict[str, object]]:
    """Tables of a key by their names; stages are a list."""
    if isinstance(content, list):
        return {each["name"]: each for each in content}
    return content if isinstance(content, dict) else {}


def _by_name(table: str, content: Mapping[str, Mapping[str, object]], known: Iterable[str]) -> Iterable[InpNote]:
    for name, values in content.items():
        new = set(values) - _KNOWN.get(table, frozenset(values))
        if f"{table}.{name}" not in known or new:
            what = f"{table}.{name}" + "".join(f".{key}" for key in sorted(new))
            raise TurgorError(f"{what} has no form in .inp files; leave it out to compare the rest.")
    failing = [name for name, values in content.items() if any(key in values for key in _FAILURE)]
    if failing:
        yield InpNote(table, LEFT_OUT, f"strength and crack growth of {', '.join(failing)}, which turgor judges")


def _single(table: str, content: Mapping[str, object], known: Iterable[str]) -> Iterable[InpNote]:
    whole = table in _AS_A_WHOLE and (table in known or table == "procedure")
    for key in content:
        what = f"{table}.{key}"
        if what in known:
            continue
        if what in _KEYS:
            yield InpNote(what, *_KEYS[what])
        elif not whole:
            raise TurgorError(f"{what} has no form in .inp files; leave it out to compare the rest.")
