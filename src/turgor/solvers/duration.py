"""Duration: the time that a path takes, checked."""

from math import inf

from turgor.errors import TurgorError


def check_duration(duration: float | None) -> None:
    """Refuse a duration that is none.

    Raises
    ------
    TurgorError
        If it is not more than 0, or infinite.
    """
    if duration is not None and not 0 < duration < inf:
        raise TurgorError(f"procedure.duration is {duration:g} s; it must be more than 0.")
