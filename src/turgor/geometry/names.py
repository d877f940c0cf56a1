"""Names of faces that mean something everywhere."""

from collections.abc import Iterable

#: Name of the faces between two regions that have no better one.
INTERFACE = "interface"


def cavity_names(faces: Iterable[str]) -> tuple[str, ...]:
    """Return the names that mean a cavity, those that begin with ``cavity``, in the order in which they are counted.

    Parameters
    ----------
    faces : iterable of str

    Returns
    -------
    tuple of str

    Examples
    --------
    >>> cavity_names(["cavity_10", "cavity_2", "fixed", "cavity_1"])
    ('cavity_1', 'cavity_2', 'cavity_10')
    """
    return tuple(sorted((name for name in faces if name.startswith("cavity")), key=lambda name: (len(name), name)))
