"""Cases: the published records of a rubber as alternatives, the run of each, and the range of all."""

import csv
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import partial
from pathlib import Path
from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray

from turgor.core.materials.library.doubts import find_doubts
from turgor.core.materials.library.record import Record
from turgor.core.materials.library.record_files import records
from turgor.foundation.errors import TurgorError, unknown
from turgor.foundation.finding import Severity
from turgor.foundation.store.atomic_files import whole
from turgor.studies.uncertainty.spread import Alternatives

Array = NDArray[np.float64]

#: Text of a value of a column.
Shown = Callable[[str, float], str]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Case:
    """One record, and the response with it.

    Parameters
    ----------
    label : str
        Of the alternatives, such as ``"ecoflex-00-30"``.
    name : str
        Of the record.
    doubts : tuple of str
        Codes of what is doubtful about it, such as ``"M04"``; empty where nothing is.
    problem : str
        Why it is not part of the bands: its run failed, or ended before that of the nominal record. Empty where it is.
    curves : mapping of str to (n,) array [SI]
        Values at the rows of the bands, by column; none where there is a problem.
    """

    label: str
    name: str
    doubts: tuple[str, ...] = ()
    problem: str = ""
    curves: Mapping[str, Array] = field(default_factory=lambda: MappingProxyType({}))

    def __str__(self) -> str:
        return f"{self.name} ({', '.join(self.doubts)})" if self.doubts else self.name


def library_alternatives(
    name: str, library: str, *, nominal: str | None = None, leave_out_doubtful: bool = False, label: str = ""
) -> Alternatives:
    """Return all records of a rubber in the library as alternatives.

    Parameters
    ----------
    name : str
        Keyword of the function that computes the response; it gets the name of a record, for `turgor.from_library`.
    library : str
        Name of the rubber, one of `turgor.library()`, or the path of a file of your own that ends in ``.toml``.
    nominal : str, optional
        The nominal record; by default the first one without a doubt.
    leave_out_doubtful : bool
        Whether records with a doubt are left out, the nominal one excepted. Notes, such as a question that the library
        has settled, are no doubts.
    label : str
        Name in sentences and pictures; by default that of the rubber.

    Returns
    -------
    Alternatives

    Raises
    ------
    TurgorError
        If the rubber or the record is unknown, or fewer than two records are left.

    Examples
    --------
    >>> alternatives = library_alternatives("record", "dragon-skin-10", leave_out_doubtful=True)
    >>> alternatives.sets[0]
    {'record': 'neo-hooke-polygerinos-2020'}
    >>> library_alternatives("record", "elastosil-m4601").doubts[-1]
    ('M07',)
    """
    doubts = {each.name: doubt_codes(each) for each in records(library)}
    if nominal is not None and nominal not in doubts:
        raise unknown(f"record of '{library}'", nominal, doubts)
    first = nominal or next((each for each, codes in doubts.items() if not codes), next(iter(doubts)))
    rest = [each for each in doubts if each != first and not (leave_out_doubtful and doubts[each])]
    names = (first, *rest)
    if len(names) < 2:
        which = " without doubts besides" if leave_out_doubtful and len(doubts) > 1 else ""
        counted = f"no other record{which}" if which else "one record"
        raise TurgorError(f"'{library}' has {counted}, '{first}'; a spread needs two or more.")
    return Alternatives(
        sets=tuple({name: each} for each in names), label=label or library, names=names,
        doubts=tuple(doubts[each] for each in names),
    )  # fmt: skip


def doubt_codes(record: Record) -> tuple[str, ...]:
    """Return the codes of the doubts about a record, each once, without notes.

    Examples
    --------
    >>> [doubt_codes(each) for each in records("ecoflex-00-30")][:3]
    [(), ('M06', 'M04'), ('M04',)]
    """
    return tuple(dict.fromkeys(each.code for each in find_doubts(record) if each.severity != Severity.NOTE))


def case_texts(cases: Sequence[Case], values: Mapping[str, Sequence[float]], shown: Shown) -> list[str]:
    """Return what the records of each rubber say about some columns, in sentences.

    Parameters
    ----------
    cases : sequence of Case
    values : mapping of str to sequence of float [SI]
        Value of each case by column, in the order of the cases; nan for those with a problem.
    shown : callable
        Text of a value of a column.

    Returns
    -------
    list of str
    """
    sentences = []
    for label in dict.fromkeys(each.label for each in cases):
        group = [number for number, each in enumerate(cases) if each.label == label]
        ran = [number for number in group if not cases[number].problem]
        sound = [number for number in ran if not cases[number].doubts]
        sentences.append(f"{label}: {len(group)} records, {len(ran)} of them in the band.")
        for name, column in values.items():
            text = f"{name.replace('_', ' ')}: {_range(cases, ran, column, partial(shown, name))}"
            if len(sound) < len(ran):
                without = _range(cases, sound, column, partial(shown, name)) if sound else "none is left"
                text += f"; without the {len(ran) - len(sound)} doubtful: {without}"
            sentences.append(f"{text}.")
        doubtful = [str(cases[number]) for number in group if cases[number].doubts]
        if doubtful:
            sentences.append(f"Doubtful: {', '.join(doubtful)}.")
        sentences += [f"Not in the band: {cases[n]}: {_first(cases[n].problem)}" for n in group if cases[n].problem]
    return sentences


def write_cases(cases: Sequence[Case], names: Sequence[str], file: Path) -> None:
    """Write the records as a table: doubts, problem, and the columns at the last row of the bands, in SI units.

    Parameters
    ----------
    cases : sequence of Case
    names : sequence of str
        Columns.
    file : Path
        CSV, UTF-8.
    """
    with whole(file) as part, part.open("w", encoding="utf-8", newline="") as opened:
        table = csv.writer(opened)
        table.writerow(["rubber", "record", "doubts", "problem", *(f"{name} (SI)" for name in names)])
        for each in cases:
            values = [f"{each.curves[name][-1]:.9g}" if each.curves else "" for name in names]
            table.writerow([each.label, each.name, " ".join(each.doubts), each.problem, *values])


def _range(cases: Sequence[Case], which: Sequence[int], column: Sequence[float], text: Callable[[float], str]) -> str:
    low, high = (pick(which, key=lambda number: column[number]) for pick in (min, max))
    if len(which) == 1:
        return f"{text(column[low])} ({cases[low].name}) alone"
    deviation = float(np.std([column[number] for number in which], ddof=1))
    return (
        f"lowest {text(column[low])} ({cases[low].name}), highest {text(column[high])} ({cases[high].name}), "
        f"standard deviation {text(deviation)}"
    )


def _first(problem: str) -> str:
    """The first two sentences of a problem: the table has all of them."""
    return ". ".join(problem.split(". ")[:2]).rstrip(".") + "."
