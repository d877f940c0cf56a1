"""Drive: which columns of a response say what drove the actuator."""

from turgor.response import Column, Response


def pressures_in(response: Response) -> tuple[Column, ...]:
    """Return the columns of the pressures: ``pressure``, or ``cavity_1_pressure`` and the like where they differ.

    Parameters
    ----------
    response : Response

    Returns
    -------
    tuple of Column

    Examples
    --------
    >>> from turgor.source import Source
    >>> columns = (Column("load_factor", "", [0, 1]), Column("cavity_1_pressure", "kPa", [0, 2e4]))
    >>> [column.name for column in pressures_in(Response(columns=columns, source=Source(text="a gauge")))]
    ['cavity_1_pressure']
    """
    return tuple(
        c
        for c in response.columns
        if c.unit == "kPa" and f"_{c.name}".endswith("_pressure") and not c.name.endswith("contact_pressure")
    )


def drive_of(response: Response) -> str:
    """Return the name of the column that others are shown against: the pressure if there is one, else the first column.

    Parameters
    ----------
    response : Response

    Returns
    -------
    str
    """
    return "pressure" if "pressure" in response.names else response.names[0]


def face_of(column: Column) -> str:
    """Return the name of the face that a column of pressures or volumes belongs to.

    Parameters
    ----------
    column : Column

    Returns
    -------
    str

    Examples
    --------
    >>> face_of(Column("cavity_1_pressure", "kPa", [0.0]))
    'cavity_1'
    """
    return column.name.rpartition("_")[0]


def with_each_cavity(response: Response, name: str) -> list[str]:
    """Return a column's name and, where it is the volume of all cavities, those of each cavity.

    Parameters
    ----------
    response : Response
    name : str

    Returns
    -------
    list of str
    """
    if name != "cavity_volume":
        return [name]
    return [name, *(n for n in response.names if n != name and n.startswith("cavity_") and n.endswith("_volume"))]
