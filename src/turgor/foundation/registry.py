"""Registry: what the files of a folder define, by name, so that a new file is all that a new law or actuator needs."""

import sys
from collections.abc import Callable, Iterable, Iterator, Mapping
from importlib import import_module
from pkgutil import iter_modules
from types import ModuleType
from typing import Generic, TypeVar

from turgor.foundation.errors import TurgorError

Value = TypeVar("Value")


class Registry(Mapping[str, Value], Generic[Value]):
    """Definitions of the files of a folder, by name.

    If a file has the requested name, only this file is imported; otherwise all files are. They are read again once the
    folder has another path.

    Parameters
    ----------
    package : str
        Dotted name of the folder.
    listed : callable
        ``listed(module)`` gives the names and values that a file of the folder defines.

    Examples
    --------
    >>> is_law = class_of_file(lambda kind: hasattr(kind, "shear_modulus"))
    >>> laws = Registry("turgor.core.materials.laws.energies", is_law)
    >>> laws["yeoh"].__name__
    'Yeoh'
    """

    def __init__(self, package: str, listed: Callable[[ModuleType], Iterable[tuple[str, Value]]]) -> None:
        self._package = package
        self._listed = listed
        self._places: tuple[str, ...] = ()
        self._known: dict[str, Value] = {}
        self._own: dict[tuple[str, tuple[str, ...]], Value | None] = {}

    def __getitem__(self, name: str) -> Value:
        places = self._now()
        if places == self._places:
            return self._known[name]
        own = self._of_its_file(name, places)
        return self._all()[name] if own is None else own

    def __iter__(self) -> Iterator[str]:
        return iter(self._all())

    def __len__(self) -> int:
        return len(self._all())

    def _now(self) -> tuple[str, ...]:
        package = sys.modules.get(self._package) or import_module(self._package)  # a run calls it a thousand times
        return tuple(package.__path__)

    def _of_its_file(self, name: str, places: tuple[str, ...]) -> Value | None:
        """The definition of the file of this name. Most names need no import of the other files."""
        if (name, places) not in self._own:
            there = any(module.name == name for module in iter_modules(places))
            listed = self._listed(import_module(f"{self._package}.{name}")) if there else ()
            self._own[name, places] = dict(listed).get(name)
        return self._own[name, places]

    def _all(self) -> dict[str, Value]:
        places = self._now()
        if places != self._places:
            known: dict[str, Value] = {}
            for each in sorted(module.name for module in iter_modules(places)):
                for name, value in self._listed(import_module(f"{self._package}.{each}")):
                    if known.setdefault(name, value) is not value:
                        raise TurgorError(f"two files of {self._package} define '{name}'; rename one of them.")
            self._places, self._known = places, known
        return self._known


def class_of_file(suits: Callable[[type], bool]) -> Callable[[ModuleType], Iterable[tuple[str, type]]]:
    """Make the function by which a `Registry` reads files that define one class each, named like the file.

    Parameters
    ----------
    suits : callable
        ``suits(class)`` says whether it is what the folder is for; others in the file are not listed.

    Returns
    -------
    callable
    """

    def listed(module: ModuleType) -> Iterable[tuple[str, type]]:
        own = [each for each in vars(module).values() if isinstance(each, type) and each.__module__ == module.__name__]
        fitting = [each for each in own if not each.__name__.startswith("_") and suits(each)]
        if len(fitting) > 1:
            names = " and ".join(each.__name__ for each in fitting)
            raise TurgorError(f"{module.__name__} defines {names}; one class in a file is known by the file's name.")
        return [(module.__name__.rpartition(".")[2], each) for each in fitting]

    return listed


def name_in(registry: Mapping[str, type], value: object) -> str | None:
    """Return the name under which a registry lists the class of a value, None where it does not.

    Parameters
    ----------
    registry : mapping of str to type
    value : object

    Returns
    -------
    str or None
    """
    own = type(value).__module__.rpartition(".")[2]
    if registry.get(own) is type(value):
        return own  # known by the name of its file, without a look at the others
    return next((name for name, kind in registry.items() if type(value) is kind), None)
