"""Plain materials: a material, its law, or its name in the library, as a material."""

from typing import Any

from turgor.core.materials.laws.laws import Hooke
from turgor.core.materials.material import LAW_KINDS, Material
from turgor.foundation.errors import TurgorError
from turgor.foundation.given import shown


def as_material(value: Any, what: str, name: str) -> Material:
    """Return a material that was given by itself, by its law, or by its name in the library.

    Parameters
    ----------
    value : Material, a law or str
    what : str
        What it is, for the message.
    name : str
        Name of a material that is given by its law.

    Raises
    ------
    TurgorError
        If it is something else, or a name with several records; the message lists them.

    Examples
    --------
    >>> from turgor.core.materials.laws.laws import NeoHooke
    >>> as_material(NeoHooke(C10=0.12e6), "materials.body", "body")
    Material('body', NeoHooke(C10=120000.0) [SI], incompressible)
    >>> as_material(0.12e6, "materials.body", "body")
    Traceback (most recent call last):
    turgor.TurgorError: materials.body is 120000.0; a Material is needed, or its law, or its name in the library.
    """
    if isinstance(value, Material):
        return value
    if isinstance(value, str):
        from turgor.core.materials.library.records import from_library  # here: it reads the files of the library

        try:
            return from_library(value)
        except TurgorError as error:
            raise TurgorError(f"{what}: {error} from_library(name, record) gives one Material.") from None
    kinds: Any = (*LAW_KINDS, Hooke)
    if isinstance(value, kinds) and not isinstance(value, type):
        return Material(name=name, law=value)
    raise TurgorError(f"{what} is {shown(value)}; a Material is needed, or its law, or its name in the library.")
