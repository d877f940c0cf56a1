"""Versions of the programs that made a result."""

import platform
from importlib.metadata import PackageNotFoundError, version

#: Packages on which the numbers of a run depend.
PACKAGES = ("turgor", "numpy", "scipy", "numba", "fenics-basix", "netgen-mesher", "rslab", "mkl")


def package_version(name: str) -> str | None:
    """Return the version of an installed package, or None.

    Examples
    --------
    >>> package_version("no-such-package") is None
    True
    """
    try:
        return version(name)
    except PackageNotFoundError:
        return None


def versions() -> dict[str, str]:
    """Return the versions of Python, the platform and every installed package that may change the results.

    Examples
    --------
    >>> sorted(set(versions()) & {"numpy", "platform", "python"})
    ['numpy', 'platform', 'python']
    """
    numbers = {name: package_version(name) for name in PACKAGES}
    here = {"python": platform.python_version(), "platform": f"{platform.system()} {platform.machine()}"}
    return {name: number for name, number in numbers.items() if number is not None} | here
