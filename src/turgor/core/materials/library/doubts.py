"""Doubts about published constants, found by computation: M04 to M07, a section each in ``docs/findings.md``.

A doubt never changes a number. It travels with the material in ``source.doubts``, and `doubts_of` turns it into
findings.
"""

import re
from collections.abc import Sequence

from turgor.core.materials.laws.laws import Law
from turgor.core.materials.library.doubt_checks import LOOKS, Case, Doubt, unstable_law
from turgor.core.materials.library.record import Record
from turgor.core.materials.material import Material
from turgor.foundation.finding import Finding, Severity

_ADVICE = {
    "M04": "Prefer another record, or fit constants to tests of your own.",
    "M05": "Check the form of the law in the source before you copy the constants elsewhere.",
    "M06": "Do not use it beyond the stated stretch; fit constants to tests of your own with a stability constraint.",
    "M07": "Use a hyperelastic record of this rubber.",
}


#: A doubt as `Doubt` and `Finding` write themselves.
_CODED = re.compile(r"(M\d\d) ([^:]{1,40}): (.+)", re.DOTALL)

#: Kinds of doubt that only inform: the library has settled the question, or it hardly matters.
_NOTES = ("wrong convention negative", "convention settled", "density")


def find_doubts(record: Record, others: Sequence[Record] | None = None) -> tuple[Doubt, ...]:
    """Find what is doubtful about a record.

    Parameters
    ----------
    record : Record
        As from `turgor.core.materials.library.records.find_record`.
    others : sequence of Record, optional
        Records to compare it with; by default those of the library.

    Returns
    -------
    tuple of Doubt

    Examples
    --------
    >>> from turgor.core.materials.library.record_files import records
    >>> doubts = find_doubts(next(r for r in records("ecoflex-00-30") if r.name == "yeoh-yan-2016"))
    >>> [(doubt.code, doubt.kind) for doubt in doubts]
    [('M04', 'borrowed'), ('M04', 'far from the supplier')]
    """
    case = Case(record, others)
    doubts = [doubt for look in LOOKS for doubt in look(case)]
    stated = [_stated(text) for text in record.stated_doubts]
    density = [
        Doubt(code="M04", kind="density", message=text, severity=Severity.NOTE) for text in record.density_doubts
    ]
    return (*doubts, *stated, *density)


def doubts_of(material: Material) -> tuple[Finding, ...]:
    """Return the doubts that travel with a material as findings, and whether its law is unstable (M06).

    Parameters
    ----------
    material : Material
        As from `turgor.from_library`, or with a law that was stated or fitted.

    Returns
    -------
    tuple of Finding
        Warnings, or notes where the library has settled the question; texts without a code count as M04.

    Examples
    --------
    >>> from turgor.core.materials.library.records import from_library
    >>> [finding.code for finding in doubts_of(from_library("fiberglass"))]
    ['M04']
    >>> from turgor.core.materials.laws.laws import Yeoh
    >>> [finding.code for finding in doubts_of(Material(name="typed", law=Yeoh(C10=0.11e6, C20=-0.02e6)))]
    ['M06']
    """
    doubts = [_stated(text) for text in material.source.doubts]
    if isinstance(material.law, Law) and all(doubt.code != "M06" for doubt in doubts):
        doubts += unstable_law(material.law)  # records of the library were checked when they were loaded
    return tuple(_finding(material, doubt) for doubt in doubts)


def _stated(text: str) -> Doubt:
    """A doubt as a file states it: with a code, such as those that fits save, or in plain words."""
    match = _CODED.fullmatch(text)
    if match is None:
        return Doubt(code="M04", kind="stated", message=text)
    return Doubt(code=match[1], kind=match[2], message=match[3])


def _finding(material: Material, doubt: Doubt) -> Finding:
    return Finding(
        code=doubt.code,
        severity=Severity.NOTE if doubt.kind in _NOTES else Severity.WARNING,
        message=f"{material.name}: {doubt.message}",
        advice=_ADVICE.get(doubt.code, ""),
    )
