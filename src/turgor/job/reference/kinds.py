"""Kinds of values: what a key takes, in words, from the annotation of its field."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from functools import partial
from types import NoneType
from typing import Annotated, Any, get_args, get_origin

from pydantic import BaseModel, BeforeValidator
from pydantic.fields import FieldInfo

from turgor.job.text.quantities import Says, coordinate
from turgor.units import EXAMPLES, UNITS

#: Kinds of plain values, with an example in TOML.
_PLAIN: Mapping[Any, tuple[str, str]] = {
    float: ("number", "0.5"),
    int: ("whole number", "2"),
    bool: ("true or false", "true"),
    str: ("text", '"..."'),
}


@dataclass(frozen=True, slots=True, kw_only=True)
class Kind:
    """Kind of value of a key.

    Parameters
    ----------
    words : str
        In words, such as ``"length"``.
    dimension : str
        Key of `UNITS` for a quantity; empty otherwise.
    example : str
        A value in TOML.
    """

    words: str
    dimension: str = ""
    example: str = ""

    @property
    def units(self) -> tuple[str, ...]:
        """Units that a quantity may have."""
        return tuple(UNITS[self.dimension]) if self.dimension else ()


def kind_of(field: FieldInfo) -> Kind:
    """Describe what a field takes.

    Examples
    --------
    >>> from turgor.job.text.quantities import MeshTable
    >>> kind_of(MeshTable.model_fields["size"])
    Kind(words='length', dimension='length', example='"1.5 mm"')
    """
    return _of_metadata(field.metadata) or _of(field.annotation)


def _of(annotation: Any) -> Kind:
    if get_origin(annotation) is Annotated:
        inner, *metadata = get_args(annotation)
        return _of_metadata(metadata) or _of(inner)
    parts = [each for each in get_args(annotation) if each is not NoneType]
    origin = get_origin(annotation)
    if origin is list or origin is tuple:
        part = _of(parts[0])
        return Kind(words=f"list of {_several(part.words)}", dimension=part.dimension, example=f"[{part.example}]")
    if origin is dict or origin is Mapping:
        part = _of(parts[1])
        return Kind(words=f"{part.words} by name", dimension=part.dimension, example=f"{{ name = {part.example} }}")
    if parts:
        kinds = [_of(part) for part in parts]
        words = " or ".join(dict.fromkeys(kind.words for kind in kinds))
        return Kind(words=words, dimension=kinds[0].dimension, example=kinds[0].example)
    if isinstance(annotation, type) and issubclass(annotation, BaseModel):
        return Kind(words="table", example="{ ... }")
    words, example = _PLAIN.get(annotation, ("value", ""))
    return Kind(words=words, example=example)


def _of_metadata(metadata: Iterable[Any]) -> Kind | None:
    """Kind that is stated in addition to the type: in words, or by the function that reads the value."""
    for each in metadata:
        if isinstance(each, Says):
            return Kind(words=each.words, dimension=each.dimension, example=each.example)
    for each in metadata:
        if isinstance(each, BeforeValidator):
            if each.func is coordinate:
                return Kind(words="length or 0", dimension="length", example=_example("length"))
            if isinstance(each.func, partial) and "dimension" in each.func.keywords:
                return _of_dimension(each.func.keywords["dimension"])
    return None


def _of_dimension(dimension: str) -> Kind:
    if dimension in UNITS:
        return Kind(words=dimension, dimension=dimension, example=_example(dimension))
    if dimension == "names":
        return Kind(words="text or list of texts", example='"cavity_1"')
    return Kind(words="number", example="0.5")


def _example(dimension: str) -> str:
    return f'"{EXAMPLES[dimension]}"'


def _several(words: str) -> str:
    first, *rest = words.split(" or ")
    head, of, tail = first.partition(" of ")
    plural = "true" if head == "true" else f"{head}s"
    return " or ".join([f"{plural}{of}{tail}", *rest])
