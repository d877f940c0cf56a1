"""Runs of a study: what each computes, and its key."""

import hashlib
import json
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, fields, is_dataclass, replace
from types import MappingProxyType
from typing import Any

from turgor.foundation.errors import TurgorError, unknown
from turgor.foundation.response import Response
from turgor.foundation.store.codec import Encoder
from turgor.studies.runs.executors.code import code_digest
from turgor.studies.runs.settings import RUNS


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Computed:
    """Result of one run.

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
        `code_digest` of the function when the run was created.

    Examples
    --------
    >>> from turgor.studies.runs.run import Computed, Run
    >>> Run(name="two", function=Computed, values={"seconds": 2.0}).key
    '81a6252a78'
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
            raise TurgorError(f"run '{self.name}' has a value that cannot be saved: {error}.") from None
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
        parts: list[Any] = [module, self.function.__qualname__, values]
        if self.code:
            parts.append(self.code)
        if self.design is not None:
            parts.append(self.written_design)
        return hashlib.sha256(json.dumps(parts, sort_keys=True).encode()).hexdigest()[: RUNS.letters]

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
    >>> from turgor.fast_models.formulas import HollowSphere
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
