"""Guideline: a design rule from the literature, the studies that test it, and how they are judged."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from enum import StrEnum
from typing import Literal

import turgor as tg
from turgor.studies import Computed, Run

#: How much is computed: coarse meshes and few values, or the default meshes and all values.
Setting = Literal["quick", "full"]

#: Results of the runs of a study, by the names of the runs.
Runs = Mapping[str, Computed]


class Verdict(StrEnum):
    """What the numbers say of a claim."""

    CONFIRMED = "confirmed"
    CONDITIONAL = "confirmed under these conditions"
    NOT_REPRODUCED = "not reproduced"
    NOT_JUDGED = "not judged"


@dataclass(frozen=True, slots=True, kw_only=True)
class Judgement:
    """A verdict, and what it rests on.

    Parameters
    ----------
    verdict : Verdict
    finding : str
        The numbers, with their mesh errors.
    conditions : str
        On what the rule depends that it does not state; empty where it depends on nothing else.
    """

    verdict: Verdict
    finding: str
    conditions: str = ""


@dataclass(frozen=True, slots=True, kw_only=True)
class GuidelineTest:
    """One test of a guideline.

    Parameters
    ----------
    title : str
        What is varied, in a few words.
    setup : str
        Geometry, material, load and quantity, as a reader needs them to repeat it.
    expected : str
        Sign or number that the guideline leads to.
    runs : callable
        Gives the runs for a `Setting`. Runs that several studies share are computed once.
    judge : callable
        Computes the judgement from the results of the runs. It must be able to come out either way.
    panels : callable
        What to draw, from the results of the runs.
    """

    title: str
    setup: str
    expected: str
    runs: Callable[[Setting], tuple[Run, ...]]
    judge: Callable[[Runs], Judgement]
    panels: Callable[[Runs], tuple[tg.pictures.Panel, ...]]


@dataclass(frozen=True, slots=True, kw_only=True)
class Guideline:
    """A design rule of the review, and the studies that test it.

    Parameters
    ----------
    key : str
        Section and item of the review, such as ``"7.4-5"``.
    rule : str
        What is claimed, in one sentence.
    sources : tuple of str
        Publications that the review gives for it.
    families : tuple of str
        Actuators that it is about, as they are called in jobs; their pages link here.
    studies : tuple of GuidelineTest
    """

    key: str
    rule: str
    sources: tuple[str, ...]
    families: tuple[str, ...]
    studies: tuple[GuidelineTest, ...]


def overall(judgements: tuple[Judgement, ...]) -> Verdict:
    """Verdict on a guideline from those on its studies.

    Parameters
    ----------
    judgements : tuple of Judgement

    Returns
    -------
    Verdict
        That of all studies where they agree; *not judged* where one could not be; otherwise the rule holds under
        conditions.

    Examples
    --------
    >>> yes, no = (Judgement(verdict=each, finding="") for each in (Verdict.CONFIRMED, Verdict.NOT_REPRODUCED))
    >>> overall((yes, yes)).value, overall((yes, no)).value
    ('confirmed', 'confirmed under these conditions')
    """
    verdicts = {each.verdict for each in judgements}
    if Verdict.NOT_JUDGED in verdicts or not verdicts:
        return Verdict.NOT_JUDGED
    return verdicts.pop() if len(verdicts) == 1 else Verdict.CONDITIONAL
