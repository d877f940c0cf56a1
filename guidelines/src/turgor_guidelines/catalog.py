"""Catalog: all guidelines in the order of the review, and how they are chosen by their keys."""

import pkgutil
import re
from collections.abc import Sequence
from difflib import get_close_matches
from importlib import import_module

import turgor as tg
from turgor_guidelines.guideline import Guideline

#: Folders of this package that hold a module for each guideline.
CHAPTERS = (
    "universal",
    "single_chamber",
    "fiber_reinforced",
    "omnidirectional",
    "multi_chamber",
    "convergence",
    "modeling",
)


def guidelines() -> dict[str, Guideline]:
    """All guidelines by key, in the order of the review.

    Returns
    -------
    dict of str to Guideline

    Examples
    --------
    >>> guidelines()["7.4-8"].families
    ('free_bottom_pneunet', 'fast_pneunet')
    """
    results = []
    for chapter in CHAPTERS:
        package = import_module(f"turgor_guidelines.{chapter}")
        for module in pkgutil.iter_modules(package.__path__):
            member = import_module(f"{package.__name__}.{module.name}")
            if hasattr(member, "GUIDELINE"):
                results.append(member.GUIDELINE)
    return {each.key: each for each in sorted(results, key=lambda each: _order(each.key))}


def chosen(keys: Sequence[str]) -> tuple[Guideline, ...]:
    """Guidelines of the given keys or sections.

    Parameters
    ----------
    keys : sequence of str
        Such as ``"7.4-5"``; ``"7.4"`` for a whole section; none for all.

    Returns
    -------
    tuple of Guideline
        In the order of the review, each once.

    Raises
    ------
    TurgorError
        If a key is unknown.

    Examples
    --------
    >>> [each.key for each in chosen(["7.4-5"])]
    ['7.4-5']
    """
    known = guidelines()
    selected = set()
    for key in keys:
        matches = {each for each in known if each == key or each.startswith(f"{key}-")}
        if not matches:
            near = get_close_matches(key, known, n=1)
            hint = f"; did you mean '{near[0]}'?" if near else "."
            raise tg.TurgorError(f"unknown guideline '{key}'{hint} Known: {', '.join(known)}.")
        selected |= matches
    return tuple(each for key, each in known.items() if key in selected or not keys)


def _order(key: str) -> list[int]:
    """Numbers of a key: section, item; ``"5-1"`` comes before ``"6.2-1"``."""
    section, _, item = key.partition("-")
    numbers = [int(each) for each in re.findall(r"\d+", section)]
    return [*numbers, *[0] * (2 - len(numbers)), *(int(each) for each in re.findall(r"\d+", item))]
