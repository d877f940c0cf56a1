"""Keys of a table in a file of records or of a job: all known, none missing."""

from collections.abc import Iterable, Mapping
from typing import Any

from turgor.foundation.errors import TurgorError, near_match


def table(values: Any, where: str, known: Iterable[str] = (), needed: Iterable[str] = ()) -> Mapping[str, Any]:
    """Return a table whose keys are all known and none of whose needed keys is missing."""
    if not isinstance(values, Mapping) or not values:
        raise TurgorError(f"{where}: a table with at least one key is needed.")
    known = tuple(known)
    for key in values:
        if known and key not in known:
            raise TurgorError(f"{where}: unknown key '{key}'{near_match(key, known) or '.'} Known: {', '.join(known)}.")
    for key in needed:
        if key not in values:
            raise TurgorError(f"{where}: '{key}' is missing, and it has no default.")
    return values
