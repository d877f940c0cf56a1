"""Tables of materials in a job: from the library, or stated by a law whose fields are the keys."""

from dataclasses import Field as DataclassField
from dataclasses import fields
from math import inf
from typing import Annotated, Any, get_args, get_origin

from pydantic import AllowInfNan, BeforeValidator, Field, create_model

from turgor.core.materials.failure_tables import read_crack_growth, read_strength
from turgor.core.materials.laws.law_spec import is_dimensionless
from turgor.core.materials.laws.laws import Hooke
from turgor.core.materials.library.record_history import (
    read_permanent_set,
    read_stress_softening,
    read_viscoelasticity,
)
from turgor.core.materials.orientation import read_orientation
from turgor.job.text.quantities import BendingStiffness, Density, Expansion, Length, Pressure, Says, Table, default_of
from turgor.units import parse_quantity

#: Text for a bulk modulus without bound.
INCOMPRESSIBLE = "incompressible"

Viscoelasticity = Annotated[
    Any,
    BeforeValidator(read_viscoelasticity),
    Says(
        "table of a Prony series or of a network that flows",
        '{ g = [0.2, 0.1], tau = ["1 s", "10 s"], moduli = "long_term" }',
    ),
]
Strengths = Annotated[
    Any,
    BeforeValidator(read_strength),
    Says(
        "table of numbers with their source",
        '{ elongation_at_break = 8.35, tensile_strength = "2.4 MPa", source = "data sheet" }',
    ),
]
Growth = Annotated[
    Any,
    BeforeValidator(read_crack_growth),
    Says("name or table", '{ like = "non-crystallizing rubber", flaw = "0.1 mm" }'),
]
Softening = Annotated[
    Any, BeforeValidator(read_stress_softening), Says("table of constants", '{ r = 1.5, m = "20 kPa" }')
]
Setting = Annotated[
    Any,
    BeforeValidator(read_permanent_set),
    Says("table of constants", '{ stress = "10 MPa", exponent = 2 }'),
]
Directions = Annotated[
    Any,
    BeforeValidator(read_orientation),
    Says("table of directions", "{ along = [1, 0, 0], across = [0, 1, 0] }"),
]


def _bulk_modulus(text: object) -> float:
    return inf if text == INCOMPRESSIBLE else parse_quantity(text, "pressure")


BulkModulus = Annotated[
    float,
    AllowInfNan(True),
    BeforeValidator(_bulk_modulus),
    Says(f'pressure or "{INCOMPRESSIBLE}"', f'"{INCOMPRESSIBLE}"', "pressure"),
]


class LibraryTable(Table):
    """``[materials.NAME]`` from the library, for the region or face NAME.

    Keys
    ----
    library : str
        Material of the library, or a TOML file of records in the folder of the job.
    record : str, optional
        Record of the material; needed where it has several.
    thickness : float [m]
        Thickness of the sheet; for faces only, which need it.
    form : str
        How a strain-limiting layer is modeled: ``"shell"`` (the default), which bends too, ``"membrane"``, ``"solid"``
        or ``"combined"``. Some records of the library have another default.
    compression : float
        Share of the stiffness in the surface that works in compression: 1 (the default), or 0 for a sheet that wrinkles
        and bears tension only. It makes the sheet a membrane, unless ``form = "shell"`` lets it bend as well.
    warp : list of three floats
        Direction of the warp of a woven sheet at rest, as seen on the face; for the law ``woven``, which needs it.
    bending_stiffness : float [N m]
        Moment per width and curvature of a shell that bends more easily than a plate, such as a woven fabric; that of
        the record, or that of a plate of its thickness, by default.
    density : float [kg/m³]
        Density, for weight and dynamics; that of the record by default.
    expansion : float [1/K]
        Linear thermal expansion, which a temperature of a body takes; that of the record by default.
    viscoelasticity : table
        Prony series: shares ``g``, times ``tau``, and whether the constants are the ``"long_term"`` or
        ``"instantaneous"`` ones; or the network of Bergström and Boyce: ``stiffness``, ``rate``, ``stress``,
        ``exponent``, ``strain_exponent`` and ``offset``; that of the record by default.
    stress_softening : table
        Mullins effect after Ogden and Roxburgh: ``r``, ``m`` and ``beta``; that of the record by default.
    permanent_set : table
        Plastic strain ((q − ``onset``)/``stress``)^``exponent`` at a Mises stress q; that of the record by default.
    strength : table
        Elongation at break (9.0 for 900 %), tensile strength and tear strength with their source; that of the record by
        default.
    crack_growth : str or table
        How fast cracks grow from cycle to cycle: a typical rubber, or ``rate`` at 1 kJ/m², ``exponent``, ``flaw``,
        ``threshold`` and ``spread``.
    """

    library: str = Field(examples=['"ecoflex-00-30"'])
    record: str | None = Field(default=None, examples=['"yeoh-steck-2019"'])
    thickness: Length | None = None
    form: str | None = Field(default=None, examples=['"shell"'])
    compression: float | None = Field(default=None, examples=["0"])
    warp: list[float] | None = Field(default=None, examples=["[1, 0, 0]"])
    bending_stiffness: BendingStiffness | None = None
    density: Density | None = None
    expansion: Expansion | None = None
    viscoelasticity: Viscoelasticity | None = None
    stress_softening: Softening | None = None
    permanent_set: Setting | None = None
    strength: Strengths | None = None
    crack_growth: Growth | None = None


class SourceTable(Table):
    """``[materials.NAME.source]``: where the constants of a material come from.

    Keys
    ----
    text : str
        The source.
    detail : str
        Table, figure or page.
    doubts : list of str
        What is doubtful about them.
    """

    text: str = Field(examples=['"own tests of 2026"'])
    detail: str = ""
    doubts: list[str] = Field(default_factory=list)


class StatedTable(Table):
    """``[materials.NAME]`` stated by its law, whose coefficients are keys too.

    Keys
    ----
    law : str
        Law; its coefficients are further keys.
    name : str
        Name in reports; that of the region by default.
    thickness : float [m]
        Thickness of the sheet; for faces only, which need it.
    form : str
        How a strain-limiting layer is modeled: ``"shell"`` (the default), which bends too, ``"membrane"``, ``"solid"``
        or ``"combined"``.
    compression : float
        Share of the stiffness in the surface that works in compression: 1 (the default), or 0 for a sheet that wrinkles
        and bears tension only. It makes the sheet a membrane, unless ``form = "shell"`` lets it bend as well.
    warp : list of three floats
        Direction of the warp of a woven sheet at rest, as seen on the face; for the law ``woven``, which needs it.
    bending_stiffness : float [N m]
        Moment per width and curvature of a shell that bends more easily than a plate, such as a woven fabric; that of a
        plate of its thickness by default.
    density : float [kg/m³]
        Density, for weight and dynamics.
    expansion : float [1/K]
        Linear thermal expansion, which a temperature of a body takes.
    stretch_range : list of two floats
        Smallest and largest stretch for which the constants are valid; beyond it the report warns.
    source : table
        Where the constants come from.
    bulk_modulus : float [Pa]
        Bulk modulus, or ``"incompressible"``.
    viscoelasticity : table
        Prony series: shares ``g``, times ``tau``, and whether the constants are the ``"long_term"`` or
        ``"instantaneous"`` ones; or the network of Bergström and Boyce: ``stiffness``, ``rate``, ``stress``,
        ``exponent``, ``strain_exponent`` and ``offset``.
    stress_softening : table
        Mullins effect after Ogden and Roxburgh: ``r``, ``m`` and ``beta``.
    permanent_set : table
        Plastic strain ((q − ``onset``)/``stress``)^``exponent`` at a Mises stress q.
    strength : table
        Elongation at break (9.0 for 900 %), tensile strength and tear strength with their source.
    crack_growth : str or table
        How fast cracks grow from cycle to cycle: a typical rubber, or ``rate`` at 1 kJ/m², ``exponent``, ``flaw``,
        ``threshold`` and ``spread``.
    orientation : table
        Directions of a law with fibers or of a print: ``along``, the first direction; ``across``, the second one, or
        ``around``, a point on the axis of a tube; ``angle`` of two families of fibers to the first direction.
    """

    law: str = Field(examples=['"yeoh"'])
    name: str | None = Field(default=None, examples=['"my silicone"'])
    thickness: Length | None = None
    form: str | None = Field(default=None, examples=['"shell"'])
    compression: float | None = Field(default=None, examples=["0"])
    warp: list[float] | None = Field(default=None, examples=["[1, 0, 0]"])
    bending_stiffness: BendingStiffness | None = None
    density: Density | None = None
    expansion: Expansion | None = None
    stretch_range: list[float] | None = Field(default=None, examples=["[0.8, 2.5]"])
    source: SourceTable | None = Field(default=None, examples=['{ text = "own tests of 2026" }'])
    strength: Strengths | None = None


def law_table(law: type) -> type[Table]:
    """Make the table of a material stated by its law: the coefficients are the fields of the law."""
    keys: dict[str, Any] = {item.name: (_constant_type(item), default_of(item)) for item in fields(law)}
    if hasattr(law, "families"):
        keys |= {"bulk_modulus": (BulkModulus, inf), "orientation": (Directions, ...)}
    elif not issubclass(law, Hooke) and not hasattr(law, "bulk_modulus"):  # a foam has its own, and no history
        keys["bulk_modulus"] = (BulkModulus, inf)
        keys |= {"viscoelasticity": (Viscoelasticity | None, None), "stress_softening": (Softening | None, None)}
        keys["permanent_set"] = (Setting | None, None)
        keys["crack_growth"] = (Growth | None, None)
    return create_model(f"{law.__name__}Table", __base__=StatedTable, **keys)


def _constant_type(item: DataclassField[Any]) -> Any:
    """One constant, a list with one for each term, or a table of coefficients by name."""
    one = float if is_dimensionless(item) else Pressure
    if item.type is float:
        return one
    of_terms = get_origin(get_args(item.type)[0]) is tuple  # (i, j, coefficient): stated by names
    return dict[str, one] if of_terms else list[one]  # type: ignore[valid-type]
