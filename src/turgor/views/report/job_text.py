"""Tidy: texts of a job as a report shows them."""

import re

_LONG = re.compile(r"(?<![\w.])\d+\.\d{5,}(?:e[+-]?\d+)?")


def tidy(text: str) -> str:
    """Shorten numbers of more than five decimals to six digits, and write truth values as words.

    Parameters
    ----------
    text : str

    Examples
    --------
    >>> tidy("0.30000000000000004 mm"), tidy("True"), tidy("1.25 mm")
    ('0.3 mm', 'yes', '1.25 mm')
    """
    return {"True": "yes", "False": "no"}.get(text) or _LONG.sub(lambda match: f"{float(match[0]):.6g}", text)
