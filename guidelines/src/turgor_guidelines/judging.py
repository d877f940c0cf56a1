"""What judges share: one verdict from several comparisons, lines of values with their mesh errors."""

from collections.abc import Iterable, Sequence

import turgor as tg
from turgor_guidelines.guideline import Verdict
from turgor_guidelines.values import Value


def verdict_of(holds: Iterable[bool]) -> Verdict:
    """Verdict from comparisons: a rule that holds in some of them only holds under conditions.

    Parameters
    ----------
    holds : iterable of bool
        Whether the rule holds in each comparison.

    Returns
    -------
    Verdict

    Examples
    --------
    >>> verdict_of([True, True]).value, verdict_of([True, False]).value, verdict_of([False]).value
    ('confirmed', 'confirmed under these conditions', 'not reproduced')
    """
    each = tuple(bool(one) for one in holds)
    if all(each):
        return Verdict.CONFIRMED
    return Verdict.CONDITIONAL if any(each) else Verdict.NOT_REPRODUCED


def line_of(x: Sequence[float] | Sequence[str], values: Sequence[Value], label: str = "") -> tg.pictures.Line:
    """Line of values with their mesh errors as bars.

    Parameters
    ----------
    x : (n,) sequence of float or str
        Names give bars.
    values : (n,) sequence of Value
    label : str
        Name in the legend.

    Returns
    -------
    Line
    """
    return tg.pictures.Line(x=x, y=[each.number for each in values], label=label, error=[each.error for each in values])


def change(value: Value, rest: Value) -> float:
    """Relative change from one value to another: 0.1 is 10 % more.

    Parameters
    ----------
    value, rest : Value

    Returns
    -------
    float
    """
    return value.number / rest.number - 1


def differs(value: Value, rest: Value) -> bool:
    """Whether two values differ by more than their mesh errors together.

    Parameters
    ----------
    value, rest : Value

    Returns
    -------
    bool
    """
    return abs(value.number - rest.number) > value.error + rest.error
