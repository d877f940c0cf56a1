"""Names of the faces of a CAD part, and findings about its cavities."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from turgor.core.geometry.cad.cavities import Hollow, find_hollows
from turgor.core.geometry.cad.facets import Mirror, mirrored
from turgor.core.geometry.cad.part import Part
from turgor.core.geometry.cad.selectors import NearestTo, Selector
from turgor.core.geometry.cad.volumes import measured
from turgor.core.geometry.names import no_cavity
from turgor.core.geometry.shapes.tolerances import TOLERANCE
from turgor.foundation.errors import TurgorError
from turgor.foundation.finding import Finding, Severity
from turgor.units import mm

#: Names with a meaning in models and measures. A face with such a name in the file keeps it; others need ``ByName``.
STANDARD = ("fixed", "tip", "strain_limiting_layer", "symmetry_x", "symmetry_y", "symmetry_z")

#: A pocket smaller than this share of the largest cavity is a hole for a screw or a mark, and no cavity.
SMALL = 0.01


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Naming:
    """Names of the faces of a part.

    Parameters
    ----------
    names : tuple of str
        Name of each face.
    cavities : dict of str to Hollow
        Cavities of the modeled part by name, with exact volumes.
    findings : tuple of Finding
        Findings about them.
    """

    names: tuple[str, ...]
    cavities: dict[str, Hollow]
    findings: tuple[Finding, ...]


def name_faces(part: Part, selected: Mapping[str, Selector], interface: str | None) -> Naming:
    """Name every face of a part.

    A face gets the first of these names: that of a selector which picks it; its name in the file, if it is one of
    ``fixed``, ``tip``, ``cavity…``, ``symmetry_…`` and ``strain_limiting_layer``; that of the cavity of which it is a
    wall; between two bodies that of `_between`; ``outside``.
    Cavities are numbered along x; those side by side from +z counterclockwise, seen from the tip. A pocket with one
    opening is closed for measuring its volume and stays open in the mesh.

    Parameters
    ----------
    part : Part
        The part.
    selected : mapping of str to Selector
        Names that the user gives. If one of them is a cavity, no others are found.
    interface : str or None
        Name of the faces that a split made.

    Raises
    ------
    TurgorError
        If a selector finds nothing, or two selectors find the same face.
    """
    names = [item.name if _standard(item.name) else "" for item in part.items]
    picked = {name: pick(part, name, selector) for name, selector in selected.items()}
    mirrors, cuts = mirrors_of(part, names, picked)
    hollows, nested, passages = (_once(group) for group in find_hollows(mirrored(part.facets, mirrors, cuts)))
    for name, selector in selected.items():
        if name.startswith("cavity") and isinstance(selector, NearestTo):
            around = [h for h in (*hollows, *passages) if picked[name][0] in h.faces]
            picked[name] = list(around[0].faces) if around else picked[name]
    _check_apart(part, picked)
    for name, places in picked.items():
        for i in places:
            names[i] = name
    findings: list[Finding] = []
    flat = called_cavities(part, names, mirrors)[1]
    if not {name for name in names if name.startswith("cavity")} - set(flat):
        cavities, findings = _cavities_of_hollows(part, hollows, nested, passages, mirrors)
        for name, hollow in cavities.items():
            for i in hollow.faces:
                names[i] = names[i] or (f"{name}_inside" if name in flat else name)
    inner = _between(part, interface)
    names = [name or inner.get(i, "outside") for i, name in enumerate(names)]
    enclosed, flat = called_cavities(part, names, mirrors)
    findings = [*findings, *([no_cavity(flat)] if flat else []), *_missing(part, names, bool(enclosed))]
    return Naming(names=tuple(names), cavities=enclosed, findings=tuple(findings))


def called_cavities(part: Part, names: Sequence[str], mirrors: Sequence[Mirror]) -> tuple[dict[str, Hollow], list[str]]:
    """Return what the faces called cavity enclose, and the names of those that enclose nothing."""
    enclosed, flat = {}, []
    for name in sorted({name for name in names if name.startswith("cavity")}):
        faces = tuple(i for i, n in enumerate(names) if n == name and not part.between[i])
        if not faces:
            continue
        hollow = measured(Hollow(faces=faces, volume=0.0, openings=()), part.facets, part.faces, mirrors)
        if hollow.volume > TOLERANCE.round_off * sum(float(part.faces[i].mass) for i in faces) ** 1.5:
            enclosed[name] = hollow
        else:
            flat.append(name)
    return enclosed, flat


def _between(part: Part, interface: str | None) -> dict[int, str]:
    """Names of the faces between bodies.

    A split gives one. Those between ``body`` and ``base`` alone are the ``strain_limiting_layer``, those between two
    other regions ``interface``. Among more regions, each pair that touches has its own name, such as ``walls-lid``.
    """
    pairs = {i: tuple(sorted(set(each), key=part.regions.index)) for i, each in enumerate(part.owners) if len(each) > 1}
    known = interface or ("strain_limiting_layer" if set(part.regions) == {"body", "base"} else "interface")
    several = interface is None and len({pair for pair in pairs.values() if len(pair) > 1}) > 1
    return {i: "-".join(pair) if several and len(pair) > 1 else known for i, pair in pairs.items()}


def pick(part: Part, name: str, selector: Selector) -> list[int]:
    """Return the faces that a selector picks; its error messages begin with the name of the face."""
    try:
        return selector.pick(part.items)
    except TurgorError as error:
        raise TurgorError(f"face '{name}': {error}") from error


def in_order(hollows: Sequence[Hollow], part: Part) -> list[Hollow]:
    """Order cavities along x; those side by side from +z counterclockwise, seen from the tip."""
    points = {id(h): part.facets.corners(np.array(h.faces)).mean(axis=(0, 1)) for h in hollows}
    middle = part.facets.points.min(axis=0) / 2 + part.facets.points.max(axis=0) / 2
    step = 0.1 * float(np.ptp(part.facets.points, axis=0).max())

    def place(hollow: Hollow) -> tuple[int, float]:
        x, y, z = points[id(hollow)] - middle
        angle = float(np.arctan2(-y, z)) % (2 * np.pi)
        return round(float(x / step)), angle if angle < 2 * np.pi - 1e-3 else 0.0

    return sorted(hollows, key=place)


def _standard(name: str) -> bool:
    return name in STANDARD or name.startswith("cavity")


def _once(hollows: Sequence[Hollow]) -> list[Hollow]:
    """Drop duplicate hollows, which are mirror images."""
    return list({hollow.faces: hollow for hollow in hollows}.values())


def mirrors_of(part: Part, names: Sequence[str], picked: Mapping[str, Sequence[int]]) -> tuple[list[Mirror], list[int]]:
    """Return the mirror planes, and the faces on them."""
    places = [(name, i) for name, which in picked.items() for i in which]
    places += [(name, i) for i, name in enumerate(names) if name]
    mirrors, cuts = set(), []
    for name, i in places:
        if name.startswith("symmetry_"):
            item = part.items[i]
            if item.normal is None or max(map(abs, item.normal)) < 1 - 1e-6:
                raise TurgorError(f"face '{name}' is no plane across x, y or z, as a mirror plane must be.")
            axis = int(np.argmax(np.abs(item.normal)))
            mirrors.add((axis, round(item.center[axis] / mm, 6)))
            cuts.append(i)
    return sorted(mirrors), cuts


def _check_apart(part: Part, picked: Mapping[str, Sequence[int]]) -> None:
    owner: dict[int, str] = {}
    for name, places in picked.items():
        for i in places:
            if i in owner:
                x, y, z = (value / mm for value in part.items[i].center)
                raise TurgorError(
                    f"the face at ({x:.4g}, {y:.4g}, {z:.4g}) mm is both '{owner[i]}' and '{name}'; make one of the "
                    "selectors narrower."
                )
            owner[i] = name


def _cavities_of_hollows(
    part: Part,
    hollows: Sequence[Hollow],
    nested: Sequence[Hollow],
    passages: Sequence[Hollow],
    mirrors: Sequence[Mirror],
) -> tuple[dict[str, Hollow], list[Finding]]:
    """Names of the detected cavities, and findings about other hollows."""
    largest = max((hollow.volume for hollow in hollows), default=0.0)
    large = [hollow for hollow in hollows if hollow.volume >= SMALL * largest]
    ordered = in_order(large, part)
    named = {"cavity" if len(ordered) == 1 else f"cavity_{i + 1}": hollow for i, hollow in enumerate(ordered)}
    small = [hollow for hollow in hollows if hollow.volume < SMALL * largest]
    findings = [_nested(part, named, nested, mirrors)] if nested else []
    if small:
        findings.append(_pockets(small, largest))
    if passages:
        findings.append(_leaks(passages, bool(named)))
    return named, findings


def _nested(part: Part, named: Mapping[str, Hollow], nested: Sequence[Hollow], mirrors: Sequence[Mirror]) -> Finding:
    lines = []
    for name, hollow in named.items():
        inner = next((h for h in nested if set(h.faces) < set(hollow.faces)), None)
        if inner is not None:
            exact = measured(hollow, part.facets, part.faces, mirrors)
            lines.append(
                f"{name} ({exact.volume:.4g} mm³, open at {where(exact)}) could also end further in, at {where(inner)}"
            )
    return Finding(
        code="D02",
        severity=Severity.NOTE,
        message=f"Cavities can be closed at several places: {'; '.join(lines)}. The outermost is taken.",
        advice="Nothing needs to be done unless the inlet must stay without pressure: then name the walls of the "
        "cavity yourself, for example by a box around its wall.",
    )


def _pockets(small: Sequence[Hollow], largest: float) -> Finding:
    listed = ", ".join(f"{hollow.volume:.3g} mm³ at {where(hollow)}" for hollow in small[:3])
    return Finding(
        code="D04",
        severity=Severity.NOTE,
        message=f"Pockets below {SMALL:.0%} of the largest cavity ({largest:.4g} mm³) belong to the outside: "
        f"{len(small)} of them, {listed}.",
        advice="Name one cavity_1, … with NearestTo if it holds pressure.",
    )


def _leaks(passages: Sequence[Hollow], has_cavities: bool) -> Finding:
    listed = "; ".join(
        f"{p.volume:.4g} mm³, open at {' and at '.join(_place(o.center, o.area) for o in p.openings[:3])}"
        for p in passages[:3]
    )
    return Finding(
        code="D03",
        severity=Severity.NOTE if has_cavities else Severity.WARNING,
        message=f"{len(passages)} of the part's hollows ({listed}) lead from one opening to another: pressure would "
        "leak, so they are no cavities.",
        advice="Close all openings but one in the CAD program; or, if they are plugged in reality, name the hollow "
        "'cavity' by a point on its wall.",
    )


def where(hollow: Hollow) -> str:
    """Write the positions of the openings of a hollow."""
    return ", ".join(_place(opening.center, opening.area) for opening in hollow.openings) or "no place"


def _place(center: np.ndarray, area: float) -> str:
    x, y, z = (round(float(value), 2) + 0.0 for value in center)
    return f"({x:.4g}, {y:.4g}, {z:.4g}) mm with {area:.4g} mm²"


def _missing(part: Part, names: Sequence[str], cavity: bool) -> list[Finding]:
    lacking = [name for name in ("fixed", "tip") if name not in names] + ([] if cavity else ["cavity"])
    if not lacking:
        return []
    return [
        Finding(
            code="D05",
            severity=Severity.NOTE if cavity else Severity.WARNING,
            message=f"'{part.path.name}' has no face named {' or '.join(lacking)}.",
            advice="Supports and measures need these names: name each of them, such as fixed by the normal "
            "-x and tip by the normal +x.",
        )
    ]


def scaled(hollow: Hollow) -> Hollow:
    """Return a hollow in meters."""
    openings = tuple(replace(o, area=o.area * mm**2, center=o.center * mm) for o in hollow.openings)
    return replace(hollow, volume=hollow.volume * mm**3, openings=openings)
