"""Findings from the estimated mesh errors of a response."""

from collections.abc import Sequence
from math import isfinite

from turgor.accuracy.adaptivity.settings import MESH_ERROR
from turgor.core.meshing.sizing.settings import QUALITIES
from turgor.core.results.error_text import last_with_error
from turgor.foundation.finding import Finding, Severity
from turgor.foundation.response import Column, Response

#: Measures that do not converge, or whose value may be nearly zero.
UNJUDGED = ("maximum_", "deepest_penetration", "smallest_gap", "reaction", "contact_area", "bearing_distance")

#: Advice where a mesh has none.
HEXAHEDRA = 'hexahedra where the family has them (cells = "hexahedra"; the default where no size is given), or '

#: Finding that is reported only where the mesh error is.
ONLY_WITH_ERROR = "G01"


def mesh_error_findings(
    response: Response, before: Sequence[Finding], quality: str = "normal", hexahedra: bool = False
) -> tuple[Finding, ...]:
    """Report measures that miss the requested quality (N02), and keep the findings about the mesh that matter.

    Parameters
    ----------
    response : Response
        With mesh errors, as far as they are known.
    before : sequence of Finding
        Findings about the mesh, before the solve.
    quality : str
        The one of the mesh settings.
    hexahedra : bool
        Whether the mesh has them already.

    Returns
    -------
    tuple of Finding
        ``before``, without G01 (walls that are one cell thick) where the estimated errors are small, and N02 where a
        measure has an error above that of the quality.
    """
    requested = QUALITIES[quality].error
    errors = {column.name: _relative(response, column) for column in response.quantities}
    known = {name: error for name, error in errors.items() if error is not None}
    large = {name: error for name, error in known.items() if error > requested and not _is_unjudged(name)}
    relevant = tuple(finding for finding in before if finding.code != ONLY_WITH_ERROR or large or not known)
    if not large:
        return relevant
    worst = sorted(large, key=lambda name: -large[name])
    listed = ", ".join(
        f"{response.find(name).label.split(' [')[0]} {last_with_error(response, response.find(name))} "
        f"({100 * large[name]:.2g} %)"
        for name in worst
    )
    doubted = large[worst[0]] > MESH_ERROR.doubted * requested
    return (
        *relevant,
        Finding(
            code="N02",
            severity=Severity.WARNING if doubted else Severity.NOTE,
            message=f"The estimated mesh error at the last state is above {100 * requested:g} %: {listed}.",
            advice=f"Use {'' if hexahedra else HEXAHEDRA}a {_finer(quality)}smaller mesh size, or let the mesh be "
            f'refined where the error comes from: target = "{100 * requested:g} %" in [mesh], or mesh_to in Python.',
        ),
    )


def _finer(quality: str) -> str:
    """The advice to request the next quality, for all but the finest."""
    names = [*QUALITIES, ""]
    better = names[names.index(quality) + 1]
    return f'better quality without a size (quality = "{better}" in [mesh]), or a ' if better else ""


def matter(findings: Sequence[Finding], mesh_error: bool) -> tuple[Finding, ...]:
    """Return the findings that a person should see before a solve: errors and warnings.

    Parameters
    ----------
    findings : sequence of Finding
    mesh_error : bool
        Whether the mesh error will be estimated; G01 waits for it then.
    """
    return tuple(
        finding
        for finding in findings
        if finding.severity is not Severity.NOTE and not (mesh_error and finding.code == ONLY_WITH_ERROR)
    )


def _relative(response: Response, column: Column) -> float | None:
    errors = response.mesh_error(column.name)
    if errors is None or not isfinite(errors[-1]):
        return None
    last, largest = abs(float(column.values[-1])), float(abs(column.values).max())
    return float(errors[-1]) / last if last > MESH_ERROR.negligible * largest else None


def _is_unjudged(name: str) -> bool:
    return name.startswith(UNJUDGED) or name.endswith(UNJUDGED)
