"""Tests behind the records that turgor has fitted itself: curves in the library, each folder with its license."""

from collections.abc import Mapping
from dataclasses import dataclass
from importlib.resources import files
from pathlib import Path
from typing import TYPE_CHECKING, Any

from turgor.core.materials.table_keys import table
from turgor.foundation.errors import TurgorError

if TYPE_CHECKING:  # a job loads this file, and needs no tests
    from turgor.core.materials.experiments.material_test import MaterialTest

_KEYS = ("tests", "modes", "law", "zero_stretch")


@dataclass(frozen=True, slots=True, kw_only=True)
class FittedTests:
    """Tests that a record was fitted to.

    Parameters
    ----------
    names : tuple of str
        Files below ``library/curves``.
    modes : tuple of str
        Mode of each.
    law : str
        Name of the fit, such as ``"yeoh-2"``.
    zero_stretch : float [-]
        Stretch of the files from which the stretch was counted, because the specimens were slack below.
    """

    names: tuple[str, ...]
    modes: tuple[str, ...]
    law: str
    zero_stretch: float = 1.0

    def read(self) -> "tuple[MaterialTest, ...]":
        """Return the tests as they were fitted.

        Examples
        --------
        >>> from turgor.core.materials.library.records import find_record
        >>> find_record("mold-star-16").fitted.read()[0].mode
        'uniaxial'
        """
        from turgor.core.materials.experiments.read_tests import read_test
        from turgor.core.materials.experiments.test_edits import set_zero_length

        folder = Path(str(files("turgor.core.materials.library").joinpath("curves")))
        tests = [read_test(folder / name, mode=mode) for name, mode in zip(self.names, self.modes, strict=True)]
        return tuple(test if self.zero_stretch == 1 else set_zero_length(test, self.zero_stretch) for test in tests)


def read_fitted(values: Any, where: str) -> FittedTests:
    """Read the table ``fitted`` of a record.

    Parameters
    ----------
    values : mapping
    where : str
        Key of the table, for messages.

    Returns
    -------
    FittedTests

    Raises
    ------
    TurgorError
        If a key is unknown, or the tests and modes are not as many.
    """
    given: Mapping[str, Any] = table(values, where, _KEYS, ("tests", "modes", "law"))
    if len(given["tests"]) != len(given["modes"]) or not given["tests"]:
        raise TurgorError(f"{where}: {len(given['tests'])} tests have {len(given['modes'])} modes; each needs one.")
    return FittedTests(
        names=tuple(map(str, given["tests"])), modes=tuple(map(str, given["modes"])), law=str(given["law"]),
        zero_stretch=float(given.get("zero_stretch", 1.0)),
    )  # fmt: skip
