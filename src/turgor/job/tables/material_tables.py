"""Tables of materials in a job: from the library, or stated by a law whose fields are the keys."""

from dataclasses import Field, fields
from functools import cache
from math import inf
from typing import Annotated, Any, get_args, get_origin

import pydantic
from pydantic import AllowInfNan, BeforeValidator, create_model

from turgor.job.text.quantities import Density, Length, Pressure, Table, default_of
from turgor.materials.laws.law_spec import is_dimensionless
from turgor.materials.laws.laws import Hooke
from turgor.materials.library.record_history import read_stress_softening, read_viscoelasticity
from turgor.units import parse_quantity

Viscoelasticity = Annotated[Any, BeforeValidator(read_viscoelasticity)]
Softening = Annotated[Any, BeforeValidator(read_stress_softening)]


class LibraryTable(Table):
    """A material of the library."""

    library: str
    record: str | None = None
    thickness: Length | None = None
    form: str | None = None
    density: Density | None = None
    viscoelasticity: Viscoelasticity | None = None
    stress_softening: Softening | None = None


class SourceTable(Table):
    """Source of the constants of a material."""

    text: str
    detail: str = ""
    doubts: list[str] = pydantic.Field(default_factory=list)


class StatedTable(Table):
    """A material stated by its law; the coefficients of the law are added by `law_table`."""

    law: str
    name: str | None = None
    thickness: Length | None = None
    form: str | None = None
    density: Density | None = None
    stretch_range: list[float] | None = None
    source: SourceTable | None = None


@cache
def law_table(law: type) -> type[Table]:
    """Make the table of a material stated by its law: the coefficients are the fields of the law."""
    keys: dict[str, Any] = {item.name: (_constant_type(item), default_of(item)) for item in fields(law)}
    if law is not Hooke:
        keys["bulk_modulus"] = (Annotated[float, AllowInfNan(True), BeforeValidator(_bulk_modulus)], inf)
        keys |= {"viscoelasticity": (Viscoelasticity | None, None), "stress_softening": (Softening | None, None)}
    return create_model(f"{law.__name__}Table", __base__=StatedTable, **keys)


def _constant_type(item: Field[Any]) -> Any:
    """One constant, a list with one for each term, or a table of coefficients by name."""
    one = float if is_dimensionless(item) else Pressure
    if item.type is float:
        return one
    of_terms = get_origin(get_args(item.type)[0]) is tuple  # (i, j, coefficient): stated by names
    return dict[str, one] if of_terms else list[one]  # type: ignore[valid-type]


def _bulk_modulus(text: object) -> float:
    return inf if text == "incompressible" else parse_quantity(text, "pressure")
