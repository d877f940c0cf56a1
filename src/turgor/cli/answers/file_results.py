"""Results of commands on files and lists, for programs: CAD files, fits, library materials, actuator families."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from turgor.core.geometry.cad.inspection import Inspection
    from turgor.core.materials.experiments.material_test import MaterialTest
    from turgor.core.materials.fitting.fit_directions import DirectionsFit
    from turgor.core.materials.fitting.fit_woven import WovenFit
    from turgor.core.materials.fitting.histories.history_fit import HistoryFit
    from turgor.core.materials.fitting.ranking import Ranking
    from turgor.core.materials.fitting.result import Fit
    from turgor.core.materials.library.choose import MaterialRow
    from turgor.job.decks.account import DeckRow


@dataclass(frozen=True, slots=True, kw_only=True)
class InspectResult:
    """``turgor inspect``: bodies, faces and cavities of a CAD file, in SI units.

    Parameters
    ----------
    name, unit : str
        File, and unit of its numbers.
    size_m : list of three floats
        Sides of the box around the part [m].
    smallest_wall_m : float
        Thinnest wall [m].
    bodies : list of tables
        ``region``, ``color``, ``volume`` [m³], and the corners ``low`` and ``high`` [m].
    faces : list of tables
        ``name``, ``name_in_file``, ``color``, ``area`` [m²], ``center`` [m], and ``normal`` of a plane face.
    cavities : list of tables
        ``name``, ``closed``, ``volume`` [m³], and ``openings``: area [m²] and center [m] of each.
    symmetry : str
        What maps the part onto itself, in words.
    """

    name: str
    unit: str
    size_m: Sequence[float]
    smallest_wall_m: float
    bodies: Sequence[Any]
    faces: Sequence[Any]
    cavities: Sequence[Any]
    symmetry: str = ""


@dataclass(frozen=True, slots=True, kw_only=True)
class ImportResult:
    """``turgor import``: the job of a deck, and what became of its keywords.

    Parameters
    ----------
    job : str
        The job file.
    rows : list of tables
        ``file``, ``line``, ``keyword``, ``verdict`` (``"taken"``, ``"not needed"`` or ``"missing"``) and ``text``.
    """

    job: Path
    rows: "Sequence[DeckRow]"


@dataclass(frozen=True, slots=True, kw_only=True)
class FitResult:
    """``turgor fit``: laws fitted to tests.

    Parameters
    ----------
    tests : list of tables
        ``name``, ``mode``, ``points``, ``stretch`` (smallest and largest) and ``edits`` of each file.
    materials : list of tables
        ``name``, ``fits`` from the best to the worst, ``words`` about them, and laws that ``failed``. Each fit has
        ``law``, ``parameters`` and their standard ``errors`` in SI units, ``aic``, ``relative_error`` and
        ``stretch_range``.
    history : table or null
        Relaxation and softening, if they were requested: ``parameters`` and ``errors``.
    folder : str or null
        Folder of plots and constants.
    directions : list of tables
        Laws with directions, if they were requested: ``law``, ``parameters``, ``errors`` and ``relative_error``.
    """

    tests: Sequence[dict[str, Any]]
    materials: Sequence[dict[str, Any]]
    history: dict[str, Any] | None
    folder: Path | None
    directions: Sequence[dict[str, Any]] = ()


@dataclass(frozen=True, slots=True, kw_only=True)
class MaterialsResult:
    """``turgor materials list`` and ``turgor materials show``.

    Parameters
    ----------
    materials : table
        Records of each material: ``record``, ``law``, constants as ``printed``, ``source``, why it is ``recommended``,
        ``stretch_range``, ``ultimate_stretch``, and ``doubts``, each with ``code``, ``severity``, ``message`` and
        ``advice``.
    """

    materials: Mapping[str, Sequence[dict[str, Any]]]


@dataclass(frozen=True, slots=True, kw_only=True)
class ChoiceResult:
    """``turgor materials choose``.

    Parameters
    ----------
    stretch : float
        Stretch of the moduli.
    rubbers : list of tables
        The nearest first: ``material``, ``hardness``, ``modulus`` [Pa] at that stretch, ``record`` and ``why`` it is
        the one to take, ``stretch_range`` and ``ultimate_stretch``.
    """

    stretch: float
    rubbers: Sequence[dict[str, Any]]


@dataclass(frozen=True, slots=True, kw_only=True)
class FamiliesResult:
    """``turgor actuators``: the families, or the keys of one.

    Parameters
    ----------
    families : table
        What each family is, by its name.
    keys : list of tables
        Keys of the family that was named: ``name``, ``kind``, ``units``, ``default`` in TOML, ``allowed`` and
        ``meaning``; empty without a name.
    """

    families: Mapping[str, str]
    keys: Sequence[Any] = ()


def inspect_result(inspection: "Inspection") -> InspectResult:
    """Make the result on a CAD file, without the triangles of its pictures."""
    faces = [
        {name: getattr(face, name) for name in ("name", "name_in_file", "color", "area", "center", "normal")}
        for face in inspection.faces
    ]
    return InspectResult(
        name=inspection.name,
        unit=inspection.unit,
        size_m=inspection.size,
        smallest_wall_m=inspection.smallest_wall,
        bodies=inspection.bodies,
        faces=faces,
        cavities=inspection.cavities,
        symmetry=inspection.symmetry,
    )


def fit_result(
    tests: "Iterable[MaterialTest]",
    rankings: "Iterable[tuple[str, Ranking]]",
    history: "HistoryFit | None" = None,
    folder: Path | None = None,
    directions: "Iterable[DirectionsFit | WovenFit]" = (),
) -> FitResult:
    """Make the result of a fit."""
    return FitResult(
        tests=[
            {
                "name": test.name,
                "mode": test.mode,
                "points": len(test.stretch),
                "stretch": test.range,
                "edits": [edit.text for edit in test.edits],
            }
            for test in tests
        ],
        materials=[
            {"name": name, "fits": list(map(_fit, each.fits)), "words": each.words, "failed": each.failed}
            for name, each in rankings
        ],
        history=None if history is None else {"parameters": history.values, "errors": history.errors},
        folder=folder,
        directions=[
            {
                "law": type(each.law).__name__,
                "parameters": each.values,
                "errors": each.errors,
                "relative_error": each.relative,
            }
            for each in directions
        ],
    )


def _fit(fit: "Fit") -> dict[str, Any]:
    return {
        "law": fit.spec.name,
        "parameters": fit.values,
        "errors": fit.errors,
        "aic": fit.aic,
        "relative_error": fit.relative,
        "stretch_range": fit.stretch_range,
    }


def materials_result(names: Iterable[str], record: str | None = None) -> MaterialsResult:
    """Make the result on library materials, or on one record of them."""
    from turgor.core.materials.library.doubts import find_doubts
    from turgor.core.materials.library.record_files import records
    from turgor.core.materials.library.records import find_record

    def listed(name: str) -> list[dict[str, Any]]:
        chosen = records(name) if record is None else (find_record(name, record),)
        return [
            {
                "record": each.name,
                "law": each.law,
                "printed": each.printed,
                "source": str(each.source),
                "recommended": each.recommended,
                "stretch_range": each.stretch_range,
                "ultimate_stretch": None if each.strength is None else each.strength.ultimate_stretch,
                "doubts": list(find_doubts(each)),
            }
            for each in chosen
        ]

    return MaterialsResult(materials={name: listed(name) for name in names})


def choice_result(near: "Sequence[tuple[MaterialRow, float]]", stretch: float) -> ChoiceResult:
    """Make the result on rubbers that were chosen."""
    rubbers = [
        {
            "material": row.name,
            "hardness": row.hardness,
            "modulus": value,
            "record": row.record,
            "why": row.why,
            "stretch_range": row.stretch_range,
            "ultimate_stretch": row.ultimate,
        }
        for row, value in near
    ]
    return ChoiceResult(stretch=stretch, rubbers=rubbers)


def families_result(name: str | None = None) -> FamiliesResult:
    """Make the result on the actuator families, with the keys of one of them."""
    from turgor.job.job import ACTUATORS
    from turgor.job.reference.sections import file_tables
    from turgor.job.reference.tables import family_table

    tables = {each: family_table(each) for each in ACTUATORS} | dict(file_tables())
    families = {each: table.words for each, table in tables.items()}
    return FamiliesResult(families=families, keys=() if name is None else tables[name].keys)
