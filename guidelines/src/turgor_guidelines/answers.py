"""Results of ``turgor guidelines`` for programs."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from turgor_guidelines.guideline import Guideline
    from turgor_guidelines.judge import Judged


@dataclass(frozen=True, slots=True, kw_only=True)
class GuidelinesResult:
    """``turgor guidelines``: the rules, and where they were run, the verdicts.

    Parameters
    ----------
    guidelines : list of tables
        ``key``, ``rule``, ``sources``, ``families``; where it was run ``verdict`` and ``studies``, each with
        ``title``, ``setup``, ``expected``, ``verdict``, ``found``, ``conditions`` and ``cpu_seconds``.
    page : str
        The page with the figures; empty where none was written.
    """

    guidelines: list[dict[str, object]]
    page: str


def listed_result(guidelines: "Sequence[Guideline]") -> GuidelinesResult:
    """Result of ``turgor guidelines list``."""
    return GuidelinesResult(guidelines=[_row(each) for each in guidelines], page="")


def judged_result(judged: "Sequence[Judged]", page: Path) -> GuidelinesResult:
    """Result of ``turgor guidelines run`` and ``report``."""
    rows = []
    for each in judged:
        studies = [
            {
                "title": study.study.title,
                "setup": study.study.setup,
                "expected": study.study.expected,
                "verdict": str(study.judgement.verdict),
                "found": study.judgement.finding,
                "conditions": study.judgement.conditions,
                "cpu_seconds": study.seconds,
            }
            for study in each.studies
        ]
        rows.append({**_row(each.guideline), "verdict": str(each.verdict), "studies": studies})
    return GuidelinesResult(guidelines=rows, page=str(page))


def _row(guideline: "Guideline") -> dict[str, object]:
    return {
        "key": guideline.key,
        "rule": guideline.rule,
        "sources": list(guideline.sources),
        "families": list(guideline.families),
    }
