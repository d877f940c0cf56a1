"""Store: archives in one folder that refer to each other, so that every array is written once.

A run writes its results after every step. A state, once written, is only named by later archives, and so are the
arrays of the last points of the path. Archives to which none of the present ones refers are removed.
"""

import json
import weakref
from collections.abc import Iterable, Mapping
from contextlib import suppress
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from numpy.typing import NDArray

from turgor.foundation.errors import TurgorError
from turgor.foundation.store.archive import Content, read_archive, write_archive
from turgor.foundation.store.atomic_files import whole
from turgor.foundation.store.codec import Decoder, Encoder
from turgor.foundation.store.saved_objects import ENDING


@dataclass(frozen=True, slots=True, eq=False)
class _Needs:
    """Other archives that an archive names: those of objects, which are read whole, and those of arrays."""

    whole: set[str] = field(default_factory=set)
    arrays: set[str] = field(default_factory=set)

    def note(self, name: str | None) -> None:
        """Note the archive of an object or array."""
        for mark, noted in (("@", self.whole), ("#", self.arrays)):
            if name is not None and mark in name:
                noted.add(name.partition(mark)[0])


@dataclass(slots=True, eq=False)
class Store:
    """Archives in a folder.

    Parameters
    ----------
    folder : Path
        It must exist.
    named : dict of str to object
        What is not written, such as the equations that a model leads to; a reader gives its own under the same name.
    """

    folder: Path
    named: dict[str, object] = field(default_factory=dict)
    _arrays: dict[int, tuple[weakref.ref[NDArray[Any]], str]] = field(default_factory=dict)
    _objects: dict[int, tuple[object, str]] = field(default_factory=dict)
    _opened: dict[str, Content] = field(default_factory=dict)
    _read: dict[str, tuple[Any, Decoder]] = field(default_factory=dict)
    _needs: dict[str, _Needs] = field(default_factory=dict)
    _orphans: set[str] = field(default_factory=set)

    def add_orphans(self, names: Iterable[str]) -> None:
        """Note archives that a process left which was killed; `forget` removes those that are not needed."""
        self._orphans.update(names)

    def keep(self, name: str, value: object, kind: str) -> None:
        """Write an archive whose objects are named by later ones, and which stays while any of these does.

        Parameters
        ----------
        name : str
            Name of the archive.
        value : object
        kind : str
            What it is, for people who look into the folder.

        Raises
        ------
        TurgorError
            If it holds a function.
        OSError
            If the archive cannot be written.
        """
        encoder = self._write(name, value, kind)
        for number, each in enumerate(encoder.objects):
            self._objects[id(each)] = (each, f"{name}@{number}")

    def note(self, name: str, value: object, kind: str) -> None:
        """Write an archive of which later ones name the arrays alone; parameters as those of `keep`."""
        self._write(name, value, kind)

    def _write(self, name: str, value: object, kind: str) -> Encoder:
        needs, names = _Needs(), {id(each): key for key, each in self.named.items()}

        def known(item: object) -> str | None:
            name = names.get(id(item)) or self._known(item)
            needs.note(name)
            return name

        encoder = Encoder(known)
        tree = encoder.encode(value, kind)
        write_archive(self._file(name), Content(kind, tree, encoder.arrays))
        self._note(name, encoder.arrays, needs)
        return encoder

    def _note(self, name: str, arrays: Mapping[str, NDArray[Any]], needs: _Needs) -> None:
        """Note the arrays of an archive, and which others it names."""
        for key, array in arrays.items():
            self._arrays[id(array)] = (weakref.ref(array), f"{name}#{key}")
        self._needs[name] = needs

    def _known(self, item: object) -> str | None:
        if id(item) in self._arrays:
            reference, name = self._arrays[id(item)]
            return name if reference() is item else None
        entry = self._objects.get(id(item))
        return None if entry is None else entry[1]

    def knows(self, value: object) -> bool:
        """Whether an object was written by `keep`, or read."""
        return self._known(value) is not None

    def has(self, name: str) -> bool:
        """Whether there is an archive of a name."""
        return self._file(name).exists()

    def read(self, name: str, noted: bool = False) -> Any:
        """Return what an archive holds; what it names in others is read, too.

        Parameters
        ----------
        name : str
        noted : bool
            Whether it was written by `note`, so that later archives name its arrays alone.

        Raises
        ------
        TurgorError
            If an archive is missing or damaged.
        """
        return self._decoded(name, noted)[0]

    def _decoded(self, name: str, noted: bool = False) -> tuple[Any, Decoder]:
        if name not in self._read:
            content, needs = self._content(name), _Needs()

            def known(item: str) -> Any:
                needs.note(item)
                return self._named(item)

            decoder = Decoder(content.arrays, known)
            try:
                value = decoder.decode(content.tree)
            except TurgorError:
                raise
            except (LookupError, TypeError, ValueError, AttributeError, RecursionError) as error:
                raise TurgorError(f"'{self._file(name)}' is damaged: {error!r}.") from None
            self._read[name] = value, decoder
            self._note(name, content.arrays, needs)
            if not noted:
                for number, each in decoder.objects.items():
                    self._objects[id(each)] = (each, f"{name}@{number}")
        return self._read[name]

    def _content(self, name: str) -> Content:
        if name not in self._opened:
            self._opened[name] = read_archive(self._file(name))
            self._note(name, self._opened[name].arrays, _Needs())
        return self._opened[name]

    def _named(self, name: str) -> Any:
        archive, mark, key = name.partition("@")
        if mark:
            return self._decoded(archive)[1].objects[int(key)]
        archive, mark, key = name.partition("#")
        if mark:
            return self._content(archive).arrays[key]
        if name not in self.named:
            raise TurgorError(f"'{self.folder}' refers to '{name}', which is not known here.")
        return self.named[name]

    def forget(self, present: Iterable[str]) -> None:
        """Remove the archives that none of the present ones needs: their objects, those of these, and all arrays."""
        whole: set[str] = set()
        stack = list(present)
        while stack:
            name = stack.pop()
            if name not in whole:
                whole.add(name)
                stack.extend(self._needs[name].whole if name in self._needs else ())
        needed = whole.union(*(self._needs[name].arrays for name in whole if name in self._needs))
        obsolete = {name for name in self._needs if name not in needed}
        if all(name in self._needs or not self.has(name) for name in whole):  # else it is not known what is needed
            obsolete |= self._orphans - needed
            self._orphans.clear()
        if not obsolete:
            return
        for name in obsolete:
            with suppress(OSError):
                self._file(name).unlink(missing_ok=True)
            for table in (self._needs, self._opened, self._read):
                table.pop(name, None)
        self._objects = {key: entry for key, entry in self._objects.items() if _archive(entry[1]) not in obsolete}
        self._arrays = {
            key: entry
            for key, entry in self._arrays.items()
            if entry[0]() is not None and _archive(entry[1]) not in obsolete
        }

    def _file(self, name: str) -> Path:
        return self.folder / f"{name}{ENDING}"


def _archive(name: str) -> str:
    return name.replace("@", "#").partition("#")[0]


def write_index(file: Path, content: object) -> None:
    """Write a small JSON file, whole or not at all."""
    with whole(file) as part:
        part.write_text(json.dumps(content), encoding="utf-8")
