"""Tracks: how each row of loads and displacements of an .inp file changes through the steps.

A row is written in the step in which its value begins to change, with an amplitude over the total time. Steps that do
not state it leave it at its last value, as both programs do by default (``OP=MOD``).
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from turgor.core.model.history import points_of, share_at
from turgor.core.model.loads.load import DeckRows

Curve = tuple[tuple[float, float], ...]

#: Where the value stands in a row of each keyword; last where it is not named.
_VALUE = {"*DLOAD": 2, "*BOUNDARY": 3}

#: Difference of values that is round-off, as a share of the largest one of a row.
SAME = 1e-12


@dataclass(frozen=True, slots=True)
class Statement:
    """Rows of one keyword that a step states with one amplitude.

    Parameters
    ----------
    keyword : str
    curve : tuple of (float, float)
        Points of total time and share.
    rows : tuple of str
    """

    keyword: str
    curve: Curve
    rows: tuple[str, ...]


def statements(acting: Sequence[Sequence[DeckRows]], spans: Sequence[tuple[float, float]]) -> list[list[Statement]]:
    """Find what each stage states.

    Parameters
    ----------
    acting : sequence of sequence of DeckRows
        What acts in each stage, with histories over its load factor.
    spans : sequence of (float, float)
        Total time at which each begins and ends.

    Examples
    --------
    >>> rise = DeckRows("*DSLOAD", ((0.0, 0.0), (1.0, 1.0)), ("cavity, P, 2",))
    >>> stays = DeckRows("*DSLOAD", ((0.0, 1.0), (1.0, 1.0)), ("cavity, P, 2",))
    >>> first, second = statements([[rise], [stays]], [(0, 1), (1, 2)])
    >>> first, second
    ([Statement(keyword='*DSLOAD', curve=((0.0, 0.0), (1.0, 1.0)), rows=('cavity, P, 2',))], [])
    """
    last: dict[tuple[str, str], float] = {}
    out = []
    for stage, (begin, end) in zip(acting, spans, strict=True):
        values = _values(stage)
        for key in last:
            values.setdefault(key, ((0.0, 0.0), (1.0, 0.0)))  # it acts no more
        groups: dict[tuple[str, Curve], list[str]] = {}
        for (keyword, row), curve in values.items():
            before = last.get((keyword, row))
            last[keyword, row] = curve[-1][1]
            peak = max((value for _, value in curve), key=abs)
            constant = all(abs(value - (before or 0.0)) <= SAME * abs(peak) for _, value in curve)
            if constant and not (before is None and keyword == "*BOUNDARY"):
                continue
            shares = [(s, value / peak) for s, value in curve] if peak else [(0.0, 0.0), (1.0, 1.0)]
            points = tuple((begin + s * (end - begin), share) for s, share in shares)
            groups.setdefault((keyword, points), []).append(row.replace("@", f"{peak:.12g}"))
        out.append([Statement(keyword, curve, tuple(rows)) for (keyword, curve), rows in groups.items()])
    return out


def _values(stage: Sequence[DeckRows]) -> dict[tuple[str, str], Curve]:
    """The value of each row over the load factor of a stage; what acts on the same place adds up."""
    parts: dict[tuple[str, str], list[tuple[float, DeckRows]]] = {}
    for each in stage:
        for row in each.rows:
            place, value = _split(each.keyword, row)
            parts.setdefault((each.keyword, place), []).append((value, each))
    return {key: _summed(terms) for key, terms in parts.items()}


def _summed(terms: Sequence[tuple[float, DeckRows]]) -> Curve:
    factors = sorted({factor for _, each in terms for factor, _ in points_of(each.history)})
    return tuple((s, sum(value * share_at(each.history, s) for value, each in terms)) for s in factors)


def _split(keyword: str, row: str) -> tuple[str, float]:
    """A row with ``@`` in the place of its value, and the value."""
    words = row.split(", ")
    place = _VALUE.get(keyword, len(words) - 1)
    value = float(words[place])
    return ", ".join([*words[:place], "@", *words[place + 1 :]]), value


def amplitude_lines(stages: Sequence[Sequence[Statement]]) -> tuple[list[str], dict[Curve, str]]:
    """Write an amplitude for each way to go; return its lines, and the name of each."""
    names: dict[Curve, str] = {}
    lines = list[str]()
    for each in (each for stage in stages for each in stage):
        if each.curve in names:
            continue
        names[each.curve] = "ramp" if each.curve == ((0.0, 0.0), (1.0, 1.0)) else f"history_{len(names) + 1}"
        lines.append(f"*AMPLITUDE, NAME={names[each.curve]}, TIME=TOTAL TIME")
        lines += [f"{time:.12g}, {share:.12g}" for time, share in each.curve]
    return lines, names


def stated_lines(stage: Sequence[Statement], names: dict[Curve, str]) -> Iterator[str]:
    """Write what a step states."""
    for each in stage:
        yield f"{each.keyword}, AMPLITUDE={names[each.curve]}"
        yield from each.rows
