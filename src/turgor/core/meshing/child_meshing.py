"""Meshing of shapes and surfaces from files of others, in words: it is done in a child process."""

from turgor.core.geometry.child_process import Work

#: Time after which the mesh generator is stopped [s].
LONGEST_MESHING = 3600.0


def meshing(what: str) -> Work:
    """Return the meshing of a part in words, for the child process that does it.

    Parameters
    ----------
    what : str
        Name of the part or its file.

    Examples
    --------
    >>> meshing("finger").doing
    "meshing 'finger'"
    """
    return Work(
        who="the mesh generator",
        doing=f"meshing '{what}'",
        advice="Try another mesh size. If that does not help, the surfaces of the part are the cause, such as slivers "
        "or faces that nearly touch: repair it in the CAD program, and export STEP rather than STL.",
        limit=LONGEST_MESHING,
    )
