"""Names of faces with a fixed meaning."""

from collections.abc import Iterable

from turgor.foundation.finding import Finding, Severity

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


def measured_faces(faces: Iterable[str], cavities: Iterable[str]) -> tuple[str, ...]:
    """Return the faces that measures may take for what they are called: all but those called cavity that are none.

    Parameters
    ----------
    faces : iterable of str
    cavities : iterable of str
        Those that enclose a cavity.

    Returns
    -------
    tuple of str

    Examples
    --------
    >>> measured_faces(["cavity_rim", "tip"], [])
    ('tip',)
    """
    known, called = tuple(faces), set(cavities)
    return tuple(name for name in known if name in called or name not in cavity_names(known))


def no_cavity(faces: Iterable[str]) -> Finding:
    """Say that faces are called a cavity and enclose nothing."""
    listed = ", ".join(f"'{name}'" for name in faces)
    return Finding(
        code="G26",
        severity=Severity.WARNING,
        message=f"{listed} has the name of a cavity, but is an open surface that encloses nothing: it is taken for a "
        "plain face.",
        advice="Name all walls of the cavity, or give the face another name; a cavity is measured and filled, and "
        "pressure = ... in a job acts in all of them.",
    )
