"""Materials: the library with its curves, tests of a user with laws fitted to them, and both as entries of a job."""

import tomllib
from collections.abc import Mapping, Sequence
from dataclasses import fields
from pathlib import Path
from typing import Any

import numpy as np

from turgor.core.materials.experiments.columns import role_of, split_unit
from turgor.core.materials.experiments.cycles import select_cycle
from turgor.core.materials.experiments.material_test import MaterialTest
from turgor.core.materials.experiments.read_tests import read_tests
from turgor.core.materials.experiments.specimen import Specimen
from turgor.core.materials.experiments.table_text import read_table
from turgor.core.materials.experiments.test_edits import crop, remove_tail, thin
from turgor.core.materials.fitting.ranking import rank
from turgor.core.materials.fitting.result import Fit
from turgor.core.materials.laws.law_spec import is_dimensionless
from turgor.core.materials.laws.laws import LAWS
from turgor.core.materials.library.doubts import find_doubts
from turgor.core.materials.library.record import Record
from turgor.core.materials.library.record_files import all_records
from turgor.core.materials.library.records import find_record
from turgor.foundation.errors import TurgorError
from turgor.foundation.registry import name_in
from turgor.studio.settings import FITTING
from turgor.units import MPa, format_quantity, parse_quantity
from turgor.views.plots.materials import curve

#: Modes of curves of the library.
MODES = ("uniaxial", "planar", "equibiaxial")

#: Modes whose points are chosen by a range of stretch.
CROPPED = ("uniaxial", "equibiaxial", "planar")

#: Keys of a sheet, which stay when its material changes.
OF_SHEET = ("thickness", "form", "compression", "warp", "bending_stiffness")


def library_table() -> list[dict[str, Any]]:
    """Return every record of the library: name, kind, hardness, law, constants, range, doubts, sources."""
    return [_row(record) for record in all_records()]


def _row(record: Record) -> dict[str, Any]:
    doubts = [{"code": each.code, "severity": str(each.severity), "text": each.message} for each in find_doubts(record)]
    return {
        "library": record.library, "record": record.name, "name": record.material_name, "kind": record.kind,
        "hardness": record.shore_hardness, "law": record.law, "printed": record.printed, "density": record.density,
        "range": record.stretch_range, "source": record.source, "cited_by": list(record.cited_by), "doubts": doubts,
    }  # fmt: skip


def curves(chosen: Sequence[Sequence[str]], mode: str, most: float) -> list[dict[str, Any]]:
    """Return stress-stretch curves of records.

    Parameters
    ----------
    chosen : sequence of (str, str)
        Library material and record.
    mode : str
        One of `MODES`.
    most : float [-]
        Largest stretch.

    Returns
    -------
    list of dict
        ``stretch``, nominal ``stress`` [MPa], None where no law can have the constants, and the ``range`` of the tests.
    """
    if mode not in MODES:
        raise TurgorError(f"'{mode[:40]}' is no mode of a curve; allowed are {', '.join(MODES)}.")
    stretch = np.linspace(1.0, float(np.clip(most, 1.05, FITTING.most)), FITTING.points)
    out = []
    for library, name in chosen[: FITTING.curves]:
        record = find_record(library, name)
        stress = curve(record, stretch, mode)
        shown = None if stress is None or np.isnan(stress).any() else stress.tolist()
        out.append({
            "label": f"{library} {name}", "stretch": stretch.tolist(), "stress": shown, "range": record.stretch_range,
        })  # fmt: skip
    return out


def read_own(file: Path, how: Mapping[str, str]) -> dict[str, Any]:
    """Read a file of tests: its columns as they were understood, and its points.

    Parameters
    ----------
    file : Path
    how : mapping
        See `fitted`.

    Returns
    -------
    dict
        ``columns`` with their roles; ``tests``, or the sentence why there is none as ``refused``.

    Raises
    ------
    TurgorError
        If it is no table with numbers.
    """
    table, columns = read_table(file), []
    for name in table.names:
        role, _ = split_unit(name)
        columns.append({"name": name, "role": role_of(role).replace("_", " ")})
    try:
        tests = _tests(file, how)
    except TurgorError as error:
        return {"file": file.name, "columns": columns, "tests": [], "refused": error.on_command_line}
    return {"file": file.name, "columns": columns, "tests": [_points(test) for test in tests], "refused": ""}


def _points(test: MaterialTest) -> dict[str, Any]:
    shown = thin(test, FITTING.points) if test.mode in CROPPED else test
    return {
        "name": test.name, "mode": test.mode.replace("_", " "), "count": len(test.stretch),
        "stretch": shown.deformation.tolist() if test.mode == "simple_shear" else shown.stretch.tolist(),
        "stress": (shown.nominal_stress / MPa).tolist(), "edits": [each.text for each in test.edits],
    }  # fmt: skip


def fitted(
    files: Sequence[Path], how: Mapping[str, str], ends: Sequence[float] | None, laws: Sequence[str]
) -> dict[str, Any]:
    """Fit laws to tests, all files together.

    Parameters
    ----------
    files : sequence of Path
    how : mapping
        ``mode``, ``stress`` and ``specimen`` where the files do not say; ``cycle`` for tests that turn round.
    ends : (float, float) or None [-]
        Smallest and largest stretch of the points that are used.
    laws : sequence of str

    Returns
    -------
    dict
        ``fits``, the best first, each with its curves, findings and entry of a job; ``words`` that compare them.
    """
    tests = [_used(test, ends) for file in files for test in _tests(file, how)]
    ranking = rank(list(laws), tests, stretch=None if ends is None else (min(ends[0], 1.0), ends[1]))
    return {
        "fits": [_fit(each) for each in ranking.fits],
        "failed": list(ranking.failed),
        "words": list(ranking.words),
        "edits": [edit.text for test in tests for edit in test.edits],
    }


def _tests(file: Path, how: Mapping[str, str]) -> tuple[MaterialTest, ...]:
    """Tests of a file; of one that turns round its loading curve of the first or last cycle is used."""
    sizes = [parse_quantity(part.strip(), "length") for part in how.get("specimen", "").split(",") if part.strip()]
    if sizes and len(sizes) != 3:
        raise TurgorError("the specimen has length, width and thickness, for example '33 mm, 6 mm, 3 mm'.")
    specimen = Specimen(length=sizes[0], width=sizes[1], thickness=sizes[2]) if sizes else None
    mode, stress = how.get("mode") or None, how.get("stress") or None
    tests = read_tests(file, mode=mode, stress_measure=stress, specimen=specimen, cyclic=True)
    cycle = -1 if how.get("cycle") == "last" else 1
    return tuple(test if test.first_turn() is None else select_cycle(test, cycle) for test in tests)


def _used(test: MaterialTest, ends: Sequence[float] | None) -> MaterialTest:
    if test.mode not in CROPPED:
        return test
    whole = remove_tail(test)
    return thin(whole if ends is None else crop(whole, ends[0], ends[1]), FITTING.points)


def _fit(fit: Fit) -> dict[str, Any]:
    return {
        "law": fit.spec.name,
        "parameters": [fit.parameter(name) for name in fit.spec.names],
        "relative": fit.relative,
        "tests": [{"name": each.name, "relative": each.relative, "r2": each.r2 if each.r2 == each.r2 else None}
                  for each in fit.quality],
        "aic": fit.aic,
        "stable": not fit.instability,
        "instability": {mode.replace("_", " "): float(value) for mode, value in fit.instability.items()},
        "findings": [str(each) for each in fit.findings],
        "curves": [_curve(fit, test) for test in fit.tests if test.mode in CROPPED],
        "entry": stated(fit),
    }  # fmt: skip


def _curve(fit: Fit, test: MaterialTest) -> dict[str, Any]:
    order = np.argsort(test.stretch)
    stress = test.predicted(fit.law)[order] / MPa
    return {"name": test.name, "stretch": test.stretch[order].tolist(), "stress": stress.tolist()}


def stated(fit: Fit) -> dict[str, Any] | None:
    """Return a fit as an entry of ``[materials]``, with its source; None where a job has no form for its law."""
    name = name_in(LAWS, fit.law)
    if name is None:
        return None
    material = fit.material
    entry: dict[str, Any] = {"law": name}
    for item in fields(fit.law):
        plain = is_dimensionless(item)
        entry[item.name] = _constant(getattr(fit.law, item.name), plain)
    entry["stretch_range"] = [round(edge, 6) for edge in fit.stretch_range]
    source = {"text": material.source.text, "detail": material.source.detail, "doubts": list(material.source.doubts)}
    entry["source"] = {key: value for key, value in source.items() if value}
    return entry


def _constant(value: Any, plain: bool) -> Any:
    """A constant as a job states it: a quantity, a list of them, or a table by their names."""
    if isinstance(value, tuple) and value and isinstance(value[0], tuple):
        return {f"C{i}{j}": _constant(number, plain) for i, j, number in value}
    if isinstance(value, tuple):
        return [_constant(each, plain) for each in value]
    return float(value) if plain else format_quantity(float(value), "kPa")


def regions(text: str) -> dict[str, dict[str, Any]]:
    """Return the entries of ``[materials]`` of a job by their regions and faces.

    Raises
    ------
    TurgorError
        If the text is no TOML.
    """
    try:
        content = tomllib.loads(text)
    except (tomllib.TOMLDecodeError, RecursionError) as error:
        raise TurgorError(f"the job file is no TOML: {error}. Mend its text first.") from error
    given = content.get("materials")
    entries = given if isinstance(given, dict) else {}
    return {name: entry for name, entry in entries.items() if isinstance(entry, dict)}


def entry_for(text: str, region: str, choice: Mapping[str, Any]) -> dict[str, Any]:
    """Return the new entry of a region: what was chosen, with the thickness and form of a sheet that it has now."""
    now = regions(text).get(region, {})
    return {**choice, **{key: now[key] for key in OF_SHEET if key in now}}
