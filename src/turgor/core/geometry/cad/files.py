"""Reading of STEP, BREP and STL files as named CAD bodies in millimeters."""

import re
from dataclasses import dataclass
from math import prod
from pathlib import Path
from shutil import copyfile
from tempfile import TemporaryDirectory
from typing import Any

from turgor.core.geometry import occ
from turgor.core.geometry.cad.step_declarations import check_complete
from turgor.core.geometry.cad.stl import stl_bodies
from turgor.core.geometry.cad.surface.shape import SurfaceShape
from turgor.core.geometry.cad_unit import LARGEST_EXTENT, SMALLEST_EXTENT, unit_in_doubt
from turgor.core.geometry.child_process import Work
from turgor.core.geometry.silenced_output import captured_output
from turgor.foundation.errors import TurgorError, near_file
from turgor.foundation.finding import Finding
from turgor.units import UNITS, length_unit, mm

#: Kind of file by its suffix.
SUFFIXES = {".step": "STEP", ".stp": "STEP", ".brep": "BREP", ".brp": "BREP", ".stl": "STL"}

#: Time after which reading is stopped: seconds, seconds for each megabyte, and most seconds. The kernel never ends with
#: some damaged files. An STL file of 20,000 triangles, a megabyte, takes a few minutes.
LONGEST_READING = {"STEP": (50.0, 80.0, 120.0), "BREP": (50.0, 80.0, 120.0), "STL": (50.0, 500.0, 600.0)}

#: Default names of bodies, which count as no name.
_NO_NAMES = re.compile(r"(?i)|none|solid\d*|body|compound|shell|part|unnamed|open cascade.*|manifold_solid_brep.*")

#: Meters of the prefixes and names of lengths in STEP.
_PREFIXES = {"$": 1.0, ".MILLI.": 1e-3, ".CENTI.": 1e-2, ".MICRO.": 1e-6, ".DECI.": 0.1, ".KILO.": 1e3}
_NAMED = {"INCH": 25.4e-3, "FOOT": 0.3048, "FEET": 0.3048, "MIL": 25.4e-6}


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class FileContents:
    """Bodies of a file.

    Parameters
    ----------
    kind : str
        STEP, BREP or STL.
    bodies : list of CAD solids, or one SurfaceShape
        In millimeters, not yet glued.
    names : list of str
        Name of each body, empty where the file has none.
    unit : str
        Unit and where it is stated, for the report.
    findings : tuple of Finding
        What was repaired on the way.
    """

    kind: str
    bodies: list[Any]
    names: list[str]
    unit: str
    findings: tuple[Finding, ...] = ()


def load_file(path: str | Path, unit: str | float | None = None) -> FileContents:
    """Read the bodies of a CAD file.

    Parameters
    ----------
    path : str or Path
        A file that ends in .step, .stp, .brep, .brp or .stl.
    unit : str or float, optional
        Unit of the numbers in the file, such as ``"mm"``, or its length in meters, instead of the stated one. The
        default is the unit that a STEP file states, and millimeters for other files.

    Raises
    ------
    TurgorError
        If the file is missing, of an unknown kind, damaged, without a solid, or of an impossible size.
    """
    path = Path(path)
    kind = check_file(path, unit)
    if kind == "STL":
        read = stl_bodies(path)
        bodies, names, findings = read.bodies, [""] * len(read.bodies), read.findings
    else:
        bodies, names = _read(path, kind)
        findings = ()
    stated = _stated_unit(path) if kind == "STEP" else None
    factor = 1.0 if unit is None else length_unit(unit) / (stated or mm)
    if factor != 1.0:
        bodies = [_scaled(body, factor) for body in bodies]
    _check_size(path, bodies, stated if unit is None else None, unit)
    if unit is None and stated is None:
        findings = (*findings, *unit_in_doubt(path.name, max(_sides(bodies))))
    if unit is not None:
        how = f"{_given_name(unit)}, as given"
    else:
        how = f"{_unit_name(stated)}, from the file" if stated else "mm, assumed"
    return FileContents(kind=kind, bodies=bodies, names=names, unit=how, findings=findings)


def _scaled(body: Any, factor: float) -> Any:
    return body.scaled(factor) if isinstance(body, SurfaceShape) else body.Scale(occ.Pnt(0, 0, 0), factor)


def reading(path: str | Path) -> Work:
    """Return the reading of a CAD file in words, for the child process that does it."""
    least, more, most = LONGEST_READING[_kind(Path(path))]
    return Work(
        who="the CAD kernel",
        doing=f"reading '{path}'",
        advice="The file seems damaged; export it again from the CAD program, as STEP (AP214) or BREP.",
        limit=min(most, least + more * 1e-6 * Path(path).stat().st_size),
    )


def check_file(path: str | Path, unit: str | float | None = None) -> str:
    """Return the kind of a CAD file, STEP, BREP or STL, after a look at its name, its first bytes and the unit.

    Raises
    ------
    TurgorError
        If it is missing or no such file, or the unit is unknown.
    """
    kind = _kind(Path(path))
    if unit is not None:
        length_unit(unit)  # refuses what is none
    return kind


def _kind(path: Path) -> str:
    kind = SUFFIXES.get(path.suffix.lower())
    if kind is None:
        raise TurgorError(f"'{path}' is no CAD file that can be read; allowed are {', '.join(SUFFIXES)}.")
    if path.is_dir():
        raise TurgorError(f"'{path}' is a folder; name a CAD file.")
    if not path.exists():
        there = [entry.name for entry in path.parent.glob("*") if entry.suffix.lower() in SUFFIXES]
        hint = near_file(path, there)
        listed = f" CAD files there: {', '.join(sorted(there))}." if there else ""
        raise TurgorError(f"there is no file '{path}'{hint}{listed}")
    start = path.read_bytes()[:200].lstrip()
    expected = {"STEP": b"ISO-10303-21", "BREP": b"DBRep_DrawableShape"}.get(kind)
    if expected is not None and not start.startswith((expected, b"CASCADE Topology")):
        begins = start[:20].decode(errors="replace").splitlines()
        raise TurgorError(
            f"'{path}' is no {kind} file: it begins with {begins[0] if begins else ''!r} instead of "
            f"'{expected.decode()}'; export it again as {kind}."
        )
    return kind


def _read(path: Path, kind: str) -> tuple[list[Any], list[str]]:
    """Bodies and their names, which the bodies or the assembly state."""
    given = path
    with captured_output() as text, TemporaryDirectory() as folder:
        try:
            if path.suffix not in (".step", ".stp", ".brep"):  # the kernel accepts only these suffixes, in lower case
                path = Path(copyfile(path, Path(folder) / f"part.{kind.lower()}"))
            geometry = occ.OCCGeometry(str(path))
            shape = geometry.shape
            bodies = list(shape.solids)
            names = _assembly_names(geometry, bodies) if kind == "STEP" else [""] * len(bodies)
        except Exception as error:  # the kernel raises exceptions of its own for damaged files
            errors = [line for line in text().splitlines() if "ERR" in line or "Error" in line]
            cause = re.sub(r"\x1b\[[\d;]*m|\*+", "", errors[-1]).strip() if errors else str(error)
            raise TurgorError(
                f"'{given}' cannot be read, the file seems damaged ({cause}); export it again as {kind}."
            ) from error
    if kind == "STEP":
        check_complete(given, shape)
    if not bodies:
        what = f"{len(list(shape.faces))} faces" if shape is not None and list(shape.faces) else "nothing"
        raise TurgorError(
            f"'{given}' holds no solid, only {what}: its surfaces do not enclose a volume; close the body in the CAD "
            "program (sew or stitch the surfaces, make a solid) and export solids."
        )
    return bodies, names


def _assembly_names(geometry: Any, bodies: list[Any]) -> list[str]:
    """Names of solids, else of products with one solid each; default names of programs are left out."""
    products: dict[Any, str] = {}

    def walk(node: Any) -> None:
        shape = node.shape
        solids = list(shape.solids) if shape is not None and not node.is_assembly else []
        if len(solids) == 1:
            products[solids[0]] = node.name or ""
        for child in node.children:
            walk(child)

    walk(geometry.GetAssemblyTree())
    names = [body.name or products.get(body, "") for body in bodies]
    return ["" if _NO_NAMES.fullmatch(name.strip()) else name.strip() for name in names]


def _stated_unit(path: Path) -> float | None:
    """Meters of the unit of length that a STEP file states."""
    text = re.sub(r"\s+", "", path.read_bytes().decode("latin-1"))
    named = re.search(r"CONVERSION_BASED_UNIT\('(\w+)',#\d+\)LENGTH_UNIT\(\)", text)
    if named is not None and named[1].upper() in _NAMED:
        return _NAMED[named[1].upper()]
    used = re.search(r"LENGTH_UNIT\(\)NAMED_UNIT\(\*\)SI_UNIT\((\$|\.\w+\.),\.METRE\.\)", text)
    return _PREFIXES.get(used[1]) if used is not None else None


def _unit_name(unit: float | None) -> str:
    known = {value: name for name, value in reversed(list(UNITS["length"].items()))}
    return known.get(unit or mm, f"{unit} m")


def _given_name(unit: str | float) -> str:
    return str(unit) if unit in UNITS["length"] else f"{length_unit(unit):g} m"


def _sides(bodies: list[Any]) -> list[float]:
    """Sides of the box around all bodies [m]."""
    lows, highs = zip(*(body.bounding_box for body in bodies), strict=True)
    low, high = ([pick(box[i] for box in boxes) for i in range(3)] for pick, boxes in ((min, lows), (max, highs)))
    return [(b - a) * mm for a, b in zip(low, high, strict=True)]


def _check_size(path: Path, bodies: list[Any], stated: float | None, unit: str | float | None) -> None:
    """Raise an error for a part of impossible size, with a unit that would make it possible."""
    sides = _sides(bodies)
    longest = max(sides)
    if prod(sides) > 0 and SMALLEST_EXTENT <= longest <= LARGEST_EXTENT:
        return
    used = length_unit(unit) if unit is not None else stated or mm
    sizes = {name: longest / used * UNITS["length"][name] for name in ("mm", "m", "in", "um")}
    fits = [name for name, size in sizes.items() if SMALLEST_EXTENT <= size <= LARGEST_EXTENT]
    shown = " x ".join(f"{side / mm:.4g}" for side in sides)
    advice = (
        f"; with unit='{fits[0]}' it would be {longest / used * UNITS['length'][fits[0]] / mm:.4g} mm long."
        if fits
        else "."
    )
    raise TurgorError(
        f"'{path}' is a part of {shown} mm, if its numbers are in {_unit_name(used)}; allowed is a longest side of "
        f"{SMALLEST_EXTENT / mm:g} mm to {LARGEST_EXTENT / mm:g} mm; is the unit right?{advice.replace('; w', ' W')}"
    )
