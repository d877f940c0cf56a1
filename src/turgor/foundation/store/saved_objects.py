"""Saved: objects that are saved to a file and loaded again."""

import copyreg
from pathlib import Path
from types import MappingProxyType
from typing import Any, Self

from turgor.foundation.errors import TurgorError
from turgor.foundation.store.archive import Content, read_archive, write_archive
from turgor.foundation.store.codec import Decoder, Encoder

#: Ending of the files.
ENDING = ".turgor"


class Saved:
    """Gives a dataclass ``save`` and ``load``.

    The file holds numbers, text and arrays, no code and no pickle; docs/reference/saved-files.md describes it.
    """

    __slots__ = ()

    def save(self, file: str | Path) -> Path:
        """Save it to a file, which appears whole or not at all.

        Parameters
        ----------
        file : str or Path
            The ending ``.turgor`` is added where it is missing.

        Returns
        -------
        Path
            The file.

        Raises
        ------
        TurgorError
            If it holds a function, which no file can hold.
        OSError
            If the file cannot be written.
        """
        path = with_ending(Path(file))
        encoder = Encoder()
        kind = type(self).__name__
        tree = encoder.encode(self, kind)
        write_archive(path, Content(kind, tree, encoder.arrays))
        return path

    @classmethod
    def load(cls, file: str | Path) -> Self:
        """Load what `save` wrote.

        Parameters
        ----------
        file : str or Path
            The ending ``.turgor`` may be left out, as for `save`.

        Returns
        -------
        object
            Of this class.

        Raises
        ------
        TurgorError
            If the file is missing or damaged, of another version of the format, or holds something else.
        """
        loaded = load_file(Path(file))
        if not isinstance(loaded, cls):
            raise TurgorError(
                f"'{file}' holds a {type(loaded).__name__}, not a {cls.__name__}; `turgor.load` loads either."
            )
        return loaded


def with_ending(path: Path) -> Path:
    """Return a path with the ending of saved files, added where it is missing.

    Examples
    --------
    >>> with_ending(Path("finger")).name, with_ending(Path("finger.turgor")).name
    ('finger.turgor', 'finger.turgor')
    """
    return path if path.suffix == ENDING else path.with_name(path.name + ENDING)


def load_file(path: Path) -> Any:
    """Load the object that a file holds, whose ending may be left out; its errors name the file."""
    if not path.is_file() and with_ending(path).is_file():
        path = with_ending(path)
    content = read_archive(path)
    try:
        loaded = Decoder(content.arrays, _nothing_elsewhere).decode(content.tree)
        repr(loaded)  # a first use, which fails where a value is one that its class would have refused
    except TurgorError as error:
        raise TurgorError(f"'{path}' cannot be loaded: {error}") from None
    except (LookupError, TypeError, ValueError, AttributeError, RecursionError) as error:
        raise TurgorError(f"'{path}' is damaged: {error!r}.") from None
    return loaded


def _nothing_elsewhere(name: str) -> Any:
    raise TurgorError(f"it refers to '{name}' in another file; load the folder that it lies in.")


def fixed_mapping(content: dict[Any, Any]) -> MappingProxyType[Any, Any]:
    """A mapping that cannot be changed, for pickle.

    Examples
    --------
    >>> fixed_mapping({"body": 1})["body"]
    1
    """
    return MappingProxyType(content)


# Mappings that cannot be changed are part of a model, and pickle knows only those that can.
copyreg.pickle(MappingProxyType, lambda mapping: (fixed_mapping, (dict(mapping),)))
