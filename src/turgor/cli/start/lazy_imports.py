"""Libraries that others import in passing: what they do is put off until somebody uses them."""

import sys
from collections.abc import Sequence
from importlib.abc import Loader, MetaPathFinder
from importlib.machinery import ModuleSpec, PathFinder
from threading import RLock
from types import ModuleType
from typing import Any

#: Modules that a usual run imports but does not use, which would take 0.1 CPU seconds. SciPy takes over all names of
#: NumPy, and with them its wrapper of Fortran code and its tools for tests; it also has a reader of docstrings. numba
#: looks whether there are a reader of YAML, for a file of settings that hardly anybody has, one of C, and the linear
#: algebra of SciPy.
LATE = frozenset({"numpy.f2py", "numpy.testing", "pycparser", "pydoc", "scipy.linalg", "yaml"})

_LOCK = RLock()


class LateModule(ModuleType):
    """A module that is executed when a name is looked up that it does not have yet.

    `importlib.util.LazyLoader` does so for any name, also for ``__path__``, which the import of a part asks for.
    """

    def __getattr__(self, name: str) -> Any:
        with _LOCK:  # other threads wait until all names are there
            waiting = self.__dict__.pop("_waiting", None)
            if waiting is not None:
                self._execute(waiting)
            if type(self) is not LateModule:
                return getattr(self, name)
        raise AttributeError(f"module '{self.__name__}' has no attribute '{name}'")

    def _execute(self, waiting: Loader) -> None:
        """Make it the module that it would have been; where it fails, the next use tries again."""
        if self.__spec__ is not None:
            self.__spec__.loader = waiting
        self.__loader__ = waiting
        try:
            waiting.exec_module(self)
        except BaseException:
            self.__dict__["_waiting"] = waiting
            raise
        self.__class__ = ModuleType  # type: ignore[assignment]  # which looks nothing up any more


class LateLoader(Loader):
    """Loads a module without executing it.

    Parameters
    ----------
    loader : Loader
        What executes it later.
    """

    def __init__(self, loader: Loader) -> None:
        self._loader = loader

    def create_module(self, spec: ModuleSpec) -> ModuleType | None:
        """Make the module as the loader does."""
        return self._loader.create_module(spec)

    def exec_module(self, module: ModuleType) -> None:
        """Note what is to be executed."""
        module.__dict__["_waiting"] = self._loader
        module.__class__ = LateModule


class LateFinder(MetaPathFinder):
    """Finds the modules of `LATE` as Python does, and lets them be executed late."""

    def find_spec(self, name: str, path: Sequence[str] | None, target: ModuleType | None = None) -> ModuleSpec | None:
        """Find a module of `LATE`; none of the others."""
        spec = PathFinder.find_spec(name, path, target) if name in LATE else None
        if spec is not None and spec.loader is not None:
            spec.loader = LateLoader(spec.loader)
        return spec


def load_late() -> None:
    """Put off what `LATE` lists, from now on: for the process of a command, which belongs to nobody else."""
    if not any(isinstance(each, LateFinder) for each in sys.meta_path):
        sys.meta_path.insert(0, LateFinder())
