"""Tests of ``turgor fit``: read, corrected, cropped and thinned as the options say."""

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import typer

from turgor.cli.fitting.fit_options import FitOptions
from turgor.cli.fitting.fit_texts import names_cuts, preload_of, specimens_of, working_range, zero_of
from turgor.foundation.errors import TurgorError

if TYPE_CHECKING:
    from turgor.core.materials.experiments.material_test import MaterialTest
    from turgor.core.materials.experiments.specimen import Specimen


def read_all_tests(chosen: FitOptions, modes: Sequence[str | None]) -> "list[MaterialTest]":
    """Read all tests, crop them and thin them for the fit.

    Parameters
    ----------
    chosen : FitOptions
    modes : sequence of str or None
        Of each file.
    """
    tests = []
    specimens = specimens_of(chosen.specimen, len(chosen.files))
    for file, mode, specimen in zip(chosen.files, modes, specimens, strict=True):
        several = chosen.average or _column(chosen)
        read = _read_all(chosen, file, mode, specimen) if several else [read_one(chosen, file, mode, specimen)]
        for each in read:
            whole = _cropped(_handled(each, chosen), working_range(chosen.range_, chosen.working))
            test = whole if chosen.average else _thinned(whole, chosen.points)
            tell(file, test)
            _tell_lost(whole, test)
            tests.append(test)
    return tests


def tell(file: Path, test: "MaterialTest") -> None:
    """Print the content of a file and the edits.

    Parameters
    ----------
    file : Path
    test : MaterialTest
    """
    typer.echo(f"{file.name}: {test!r}")
    for edit in test.edits:
        typer.echo(f"  {edit.text}")


def means_of(tests: "Sequence[MaterialTest]", points: int) -> "list[MaterialTest]":
    """Average the replicates of each mode.

    Parameters
    ----------
    tests : sequence of MaterialTest
    points : int
        Number of points of the mean; 0 for the default.
    """
    from turgor.core.materials.experiments.test_edits import average

    means = []
    for mode in dict.fromkeys(test.mode for test in tests):
        group = [test for test in tests if test.mode == mode]
        if len(group) == 1:
            raise TurgorError(f"--average has one {mode} test only; give two replicates or more of each mode.")
        name = f"mean of {len(group)} {mode}"
        mean = average(group, points=points, name=name) if points else average(group, name=name)
        typer.echo(f"{mean!r}\n  {mean.edits[-1].text}\n  {_spread(mean)}")
        means.append(mean)
    return means


def read_one(
    chosen: FitOptions, file: Path, mode: str | None, specimen: "Specimen | None", cyclic: bool | None = None
) -> "MaterialTest":
    """Read the only test of a file.

    Parameters
    ----------
    chosen : FitOptions
    file : Path
    mode : str or None
    specimen : Specimen or None
    cyclic : bool, optional
        Whether the stretch may reverse; by default if a cycle is chosen.
    """
    from turgor.core.materials.experiments.read_tests import read_test

    cyclic = chosen.cycle is not None if cyclic is None else cyclic
    measure = chosen.stress or None
    return _of_machine(read_test(file, mode=mode, stress_measure=measure, specimen=specimen, cyclic=cyclic), chosen)


def _spread(mean: "MaterialTest") -> str:
    """Sentence on how far replicates lie apart, for a mean of `average`."""
    assert mean.spread is not None
    share = (mean.spread / abs(mean.nominal_stress).max()).max()
    return f"The replicates scatter by up to {100 * share:.2g} % of the largest stress (standard deviation)."


def _tell_lost(whole: "MaterialTest", test: "MaterialTest") -> None:
    """Print findings about a test that its thinned points do not show."""
    from turgor.core.materials.fitting.fit_laws import check_tests

    shown = {each.code for each in check_tests([test], [test])}
    for finding in check_tests([whole], [whole], "even"):
        if finding.code not in shown:
            typer.echo(f"  {finding}")


def _read_all(
    chosen: FitOptions, file: Path, mode: str | None, specimen: "Specimen | None"
) -> "Sequence[MaterialTest]":
    from turgor.core.materials.experiments.read_tests import read_tests

    measure = chosen.stress or None
    columns = {"batch": _column(chosen)} if _column(chosen) else None
    read = read_tests(
        file, mode=mode, stress_measure=measure, specimen=specimen, columns=columns, cyclic=chosen.cycle is not None
    )
    return [_of_machine(each, chosen) for each in read]


def _of_machine(test: "MaterialTest", chosen: FitOptions) -> "MaterialTest":
    """Return a test without what the testing machine gave way."""
    from turgor.core.materials.experiments.machine import remove_compliance, stated_machine

    machine = stated_machine(chosen.compliance)
    return test if machine is None else remove_compliance(test, machine)


def _column(chosen: FitOptions) -> str:
    """Column that tells the specimens of a file apart, besides those that are known by their names."""
    return chosen.by or ("" if names_cuts(chosen.directions) else chosen.directions)


def _handled(test: "MaterialTest", chosen: FitOptions) -> "MaterialTest":
    from turgor.core.materials.experiments.cycles import select_cycle
    from turgor.core.materials.experiments.slack import count_from_zero
    from turgor.core.materials.experiments.test_edits import remove_slack, remove_tail

    cycle, preload, zero = chosen.cycle, preload_of(chosen.preload), zero_of(chosen.zero)
    if cycle is not None:
        test = select_cycle(test, cycle)
    if not chosen.keep_tail and test.mode != "biaxial":
        test = remove_tail(test)
    if zero is not None:
        return count_from_zero(test, None if isinstance(zero, str) else zero)
    return test if preload is None else remove_slack(test, preload)


def _cropped(test: "MaterialTest", ends: tuple[float, float] | None) -> "MaterialTest":
    from turgor.core.materials.experiments.test_edits import crop

    return test if ends is None or test.mode in ("biaxial", "simple_shear") else crop(test, *ends)


def _thinned(test: "MaterialTest", points: int) -> "MaterialTest":
    from turgor.core.materials.experiments.test_edits import thin

    return thin(test, points) if points and test.mode not in ("biaxial", "simple_shear") else test
