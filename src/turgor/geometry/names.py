"""Names of faces with a fixed meaning."""

from collections.abc import Iterable

#: Default name of the faces between two regions.
INTERFACE = "interface"


def cavity_names(faces: Iterable[str]) -> tuple[str, ...]:
    """Return the names of cavities, which begin with ``cavity``, in the order of their numbers.

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
