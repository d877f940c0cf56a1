"""Optional packages: imported when they are needed, with a sentence where they are missing."""

from importlib import import_module
from typing import Any

from turgor.foundation.errors import NotHere

#: Packages that are installed by another name than they are imported by.
_NAMES = {"sklearn": "scikit-learn"}


def needed(module: str, purpose: str, extra: str | None = "studies") -> Any:
    """Import a module of an optional package.

    Parameters
    ----------
    module : str
    purpose : str
        What needs it, for the message.
    extra : str or None
        Group of optional packages that has it; None where none does.

    Returns
    -------
    module

    Raises
    ------
    TurgorError
        If it is not installed.
    """
    try:
        return import_module(module)
    except ImportError:
        package = module.split(".")[0]
        name = _NAMES.get(package, package)
        what = name if extra is None else f'"turgor[{extra}]"'
        raise NotHere(f"{purpose} needs {name}, which is not installed; install it with: pip install {what}") from None
