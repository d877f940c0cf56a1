"""Runs of a study: what each computes, and what was computed, as files that a later call reads again."""

import hashlib
import json
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, fields, is_dataclass, replace
from pathlib import Path
from types import MappingProxyType
from typing import Any

from turgor.errors import TurgorError, unknown
from turgor.response import Response
from turgor.results.files.response_csv import read_response
from turgor.source import Source
from turgor.store.codec import Encoder
from turgor.store.whole import whole
from turgor.study.running.code import code_digest

#: Letters of the hash in a file's name.
KEY_LETTERS = 10

#: Key of the notes of a run that failed.
PROBLEM = "problem"


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Computed:
    """What one run found.

    Parameters
    ----------
    response : Response
        The measured columns.
    picture : bytes
        Picture as PNG; empty where none was drawn.
    seconds : float [s]
        CPU time; `run_all` sets it, unless the function has timed a part of itself.
    notes : tuple of str
        What is worth saying of it, such as what was left out; its end stands in the message of the response.
    """

    response: Response
    picture: bytes = b""
    seconds: float = 0.0
    notes: tuple[str, ...] = ()


class Place(str):
    """Path of a file whose content another value states by a hash: a run is the same wherever the file lies."""

    __slots__ = ()


@dataclass(frozen=True, slots=True, kw_only=True)
class Run:
    """One computation of a study: a function, and the values that it is called with.

    Parameters
    ----------
    name : str
        Short name, unique in the study, such as ``"8 chambers"``.
    function : callable
        Function of a module, which another process can import. It returns a `Response`, or a `Computed`.
    values : mapping of str to number, str, bool, None or a list of these
        Its keyword arguments; where there is a design, the fields of the design that have other values.
    design : object
        A dataclass, such as an actuator: the function is called with a copy of it that has the values. A key with
        points goes into a dataclass within it: ``"law.C10"``.

    Raises
    ------
    TurgorError
        If the function is not one of a module, or a value or the design cannot be written as JSON.

    Attributes
    ----------
    code : str
        `code_digest` of the function as the run was made.

    Examples
    --------
    >>> from turgor.study.runs import Computed, Run
    >>> Run(name="two", function=Computed, values={"seconds": 2.0}).key
    'c21755ea1c'
    """

    name: str
    function: Callable[..., Computed | Response]
    values: Mapping[str, Any] = field(default_factory=lambda: MappingProxyType({}))
    design: Any = None
    code: str = field(init=False, default="")

    def __post_init__(self) -> None:
        if "<" in self.function.__qualname__:
            raise TurgorError(
                f"run '{self.name}' calls {self.function.__qualname__}, which no other process can import; "
                "define the function at the top of a module."
            )
        try:
            json.dumps(dict(self.values))
        except TypeError as error:
            raise TurgorError(f"run '{self.name}' has a value that cannot be kept: {error}.") from None
        encoder = Encoder()
        encoder.encode(self.design, f"the design of run '{self.name}'")
        if encoder.arrays:
            raise TurgorError(f"run '{self.name}' has a design with an array; give a tuple of numbers instead.")
        object.__setattr__(self, "code", code_digest(self.function))

    @property
    def key(self) -> str:
        """Hash of the function, its code, and the values: equal runs have equal keys, whatever they are called."""
        # a worker knows the script that called it under another name
        module = self.function.__module__.replace("__mp_main__", "__main__")
        values = {name: value for name, value in self.values.items() if not isinstance(value, Place)}
        asked: list[Any] = [module, self.function.__qualname__, values]
        if self.code:
            asked.append(self.code)
        if self.design is not None:
            asked.append(self.written_design)
        return hashlib.sha256(json.dumps(asked, sort_keys=True).encode()).hexdigest()[:KEY_LETTERS]

    @property
    def written_design(self) -> Any:
        """The design as JSON, with the names of its classes; None where there is none."""
        return json.loads(json.dumps(Encoder().encode(self.design)).replace("__mp_main__:", "__main__:"))

    def call(self) -> Computed | Response:
        """Call the function."""
        if self.design is None:
            return self.function(**self.values)
        return self.function(with_values(self.design, self.values))


def with_values(design: Any, values: Mapping[str, Any]) -> Any:
    """Return a copy of a dataclass whose fields have other values.

    Parameters
    ----------
    design : dataclass
    values : mapping
        By name of the field; with points for fields of a dataclass within it.

    Returns
    -------
    dataclass

    Raises
    ------
    TurgorError
        If there is no such field, with the near match, or the class refuses a value.

    Examples
    --------
    >>> from turgor.formulas import HollowSphere
    >>> with_values(HollowSphere(inner_radius=0.01, wall=0.002), {"wall": 0.003}).wall
    0.003
    """
    if not is_dataclass(design) or isinstance(design, type):
        raise TurgorError(f"a design is a dataclass or a dictionary of numbers, not {design!r}.")
    known = [item.name for item in fields(design) if item.init]
    changed: dict[str, Any] = {}
    for name, value in values.items():
        first, _, rest = name.partition(".")
        if first not in known:
            raise unknown(f"field of {type(design).__name__}", first, known)
        before = changed.get(first, getattr(design, first))
        changed[first] = with_values(before, {rest: value}) if rest else value
    return replace(design, **changed)


def kept(run: Run, folder: Path) -> Computed | None:
    """Read what a run found, if it has ended before.

    Parameters
    ----------
    run : Run
    folder : Path
        Where `keep` wrote it.

    Returns
    -------
    Computed or None
    """
    return kept_as(run.key, folder)


def kept_as(key: str, folder: Path) -> Computed | None:
    """Read what the run with a key found, if it has ended.

    Parameters
    ----------
    key : str
    folder : Path

    Returns
    -------
    Computed or None
    """
    notes, table, picture = _files(key, folder)
    if not (notes.is_file() and table.is_file()):
        return None
    told = json.loads(notes.read_text(encoding="utf-8"))
    if PROBLEM in told:
        return None
    read = read_response(table)
    source, status = Source(text=told["source"]), told.get("status", "")
    response = Response(columns=read.columns, source=source, status=status, message=told["message"])
    return Computed(
        response=response,
        picture=picture.read_bytes() if picture.is_file() else b"",
        seconds=float(told["cpu_seconds"]),
        notes=tuple(told.get("notes", ())),
    )


def keep(run: Run, found: Computed, folder: Path) -> None:
    """Write what a run found: its table, its picture, and at last its notes, without which it has not ended.

    Parameters
    ----------
    run : Run
    found : Computed
    folder : Path
        Made if there is none.
    """
    folder.mkdir(parents=True, exist_ok=True)
    notes, table, picture = _files(run.key, folder)
    found.response.to_csv(table)
    if found.picture:
        with whole(picture) as part:
            part.write_bytes(found.picture)
    told = {
        **_asked(run),
        "source": str(found.response.source),
        "status": found.response.status,
        "message": found.response.message,
        "cpu_seconds": round(found.seconds, 3),
        **({"notes": list(found.notes)} if found.notes else {}),
    }
    _write(notes, told)


def keep_problem(run: Run, problem: str, folder: Path) -> None:
    """Write why a run failed.

    Parameters
    ----------
    run : Run
    problem : str
    folder : Path
        Made if there is none.
    """
    folder.mkdir(parents=True, exist_ok=True)
    _write(_files(run.key, folder)[0], {**_asked(run), PROBLEM: problem})


def kept_problem(run: Run, folder: Path) -> str:
    """Read why a run failed before.

    Parameters
    ----------
    run : Run
    folder : Path
        Where `keep_problem` wrote it.

    Returns
    -------
    str
        Empty where it has not failed.
    """
    notes = _files(run.key, folder)[0]
    return str(json.loads(notes.read_text(encoding="utf-8")).get(PROBLEM, "")) if notes.is_file() else ""


def forget(run: Run, folder: Path) -> None:
    """Remove what was kept of a run, its notes first, so that it is computed again.

    Parameters
    ----------
    run : Run
    folder : Path
    """
    for file in _files(run.key, folder):
        file.unlink(missing_ok=True)


def _asked(run: Run) -> dict[str, Any]:
    return {
        "name": run.name,
        "function": f"{run.function.__module__}.{run.function.__qualname__}",
        "values": dict(run.values),
        **({} if run.design is None else {"design": run.written_design}),
    }


def _write(notes: Path, told: Mapping[str, Any]) -> None:
    with whole(notes) as part:
        part.write_text(json.dumps(told, indent=1) + "\n", encoding="utf-8")


def _files(key: str, folder: Path) -> tuple[Path, Path, Path]:
    return folder / f"{key}.json", folder / f"{key}.csv", folder / f"{key}.png"
