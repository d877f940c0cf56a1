"""Names of laws as people write them: ``neo_hooke``, ``neo-hooke`` and ``Neo Hooke`` are one law."""

import re
from collections.abc import Iterable

from turgor.core.materials.laws.laws import LAWS
from turgor.foundation.errors import unknown


def spelled(text: str, names: Iterable[str]) -> str | None:
    """Return the name that a text spells; letters and digits count, hyphens, blanks and capitals do not.

    Parameters
    ----------
    text : str
        As a person wrote it.
    names : iterable of str
        Known names.

    Returns
    -------
    str or None
        None where no name fits.

    Examples
    --------
    >>> spelled("Mooney–Rivlin", ["neo_hooke", "mooney_rivlin"])
    'mooney_rivlin'
    """
    letters = _letters(text)
    return next((name for name in names if _letters(name) == letters), None)


def law_name(text: str) -> str:
    """Return the name of a law in files of jobs and records, however it is spelled.

    Parameters
    ----------
    text : str
        Such as ``"neo-hooke"``.

    Raises
    ------
    TurgorError
        If no law has such a name.

    Examples
    --------
    >>> law_name("neo-hooke"), law_name("Yeoh")
    ('neo_hooke', 'yeoh')
    """
    name = spelled(text, LAWS)
    if name is None:
        raise unknown("law", text, LAWS)
    return name


def _letters(text: str) -> str:
    return re.sub(r"[\W_]+", "", text.lower())
