"""Limits: how much memory a file of a stranger may need, checked before it is allocated."""

import os

from turgor.foundation.errors import TurgorError

#: Most bytes that a file may unpack to if it is smaller than a twentieth of that; `MOST` states another number of MB.
UNPACKED, RATIO = 200_000_000, 20

#: Most designs of a study, so that a slip such as ``samples = 1e9`` does not fill the memory, and the environment
#: variable that states another number.
DESIGNS, MOST_DESIGNS = 100_000, "TURGOR_MOST_DESIGNS"

#: Environment variable with the most megabytes that a file may unpack to.
MOST = "TURGOR_UNPACKED_MB"


def most_designs() -> int:
    """Return how many designs a study may have, and levels a factor.

    Returns
    -------
    int

    Examples
    --------
    >>> most_designs()
    100000
    """
    stated = os.environ.get(MOST_DESIGNS, "")
    return int(stated) if stated.isdigit() else DESIGNS


def check_unpacked(named: str, packed: int, unpacked: int) -> None:
    """Refuse what unpacks to far more than it is.

    Parameters
    ----------
    named : str
        The file, for the message.
    packed, unpacked : int
        Bytes.

    Raises
    ------
    TurgorError

    Examples
    --------
    >>> check_unpacked("'bomb.vtu'", 1000, 10**10)
    Traceback (most recent call last):
    turgor.TurgorError: 'bomb.vtu' unpacks from 0.001 to 1e+04 MB, and at most 200 MB are read; set the \
environment variable TURGOR_UNPACKED_MB to read more.
    """
    stated = os.environ.get(MOST, "")
    most = 1e6 * float(stated) if stated.replace(".", "", 1).isdigit() else max(UNPACKED, RATIO * packed)
    if unpacked > most:
        raise TurgorError(
            f"{named} unpacks from {packed / 1e6:.3g} to {unpacked / 1e6:.3g} MB, and at most {most / 1e6:.4g} MB are "
            f"read; set the environment variable {MOST} to read more."
        )
