"""Command ``turgor fit``: read tests, fit laws, print their ranking, write plots and constants."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from turgor.cli.exits import errors_as_sentences
from turgor.cli.fitting.fit_behavior import Behavior
from turgor.cli.fitting.fit_files import write_fits
from turgor.cli.fitting.fit_tables import show, show_each
from turgor.cli.fitting.fit_texts import common_name, modes_of, preload_of, specimens_of, working_range, zero_of
from turgor.cli.options import Debug, Json, command_of, output_option
from turgor.foundation.errors import TurgorError

if TYPE_CHECKING:
    from turgor.core.materials.experiments.material_test import MaterialTest
    from turgor.core.materials.experiments.specimen import Specimen
    from turgor.core.materials.fitting.histories.history_fit import HistoryFit
    from turgor.core.materials.fitting.ranking import Ranking

#: Options of fits over time, in messages.
_OVER_TIME = "--relaxation nor --softening nor --rate-dependence nor --set"

#: Laws that are fitted by default, from few to many parameters.
DEFAULT_LAWS = "neo-hooke,mooney-rivlin,yeoh,ogden-3,gent"


@dataclass(frozen=True, slots=True, kw_only=True)
class FitOptions:
    """Arguments and options of ``turgor fit``."""

    files: Annotated[
        list[Path], typer.Argument(metavar="FILES...", help="Tables of tests of one material.", show_default=False)
    ]
    mode: Annotated[
        str, typer.Option(help="uniaxial, equibiaxial, planar, simple_shear or biaxial; one, or one for each file.")
    ] = ""
    laws: Annotated[str, typer.Option(help="Laws, such as yeoh,ogden-3,rivlin-2,arruda-boyce.")] = DEFAULT_LAWS
    range_: Annotated[str, typer.Option("--range", help="Stretches wanted, such as 1:4; by default all.")] = ""
    working: Annotated[
        str,
        typer.Option(
            "--for",
            help="What the actuator sees: 'stretch 1:2.5', or the folder of a run. All stretches weigh the same.",
        ),
    ] = ""
    stress: Annotated[str, typer.Option(help="nominal or cauchy, where a file does not say.")] = ""
    weights: Annotated[str, typer.Option(help="relative, absolute or even (over the stretch).")] = "relative"
    specimen: Annotated[
        str,
        typer.Option(
            help="Length, width and thickness for files of force, such as '33 mm, 6 mm, 3 mm'; or one for each "
            "file, with semicolons between."
        ),
    ] = ""
    cycle: Annotated[
        int | None, typer.Option(help="Loading curve of cyclic tests: 1 the first, -1 the last.", show_default=False)
    ] = None
    preload: Annotated[str, typer.Option(help="Nominal stress at which the specimen is taut, such as '0.7 kPa'.")] = ""
    zero: Annotated[
        str, typer.Option(help="Stretch at which the stress is zero, such as 1.034, from which it counts; or auto.")
    ] = ""
    rubber: Annotated[
        str, typer.Option(help="Library material to compare with; by default the one that the name contains.")
    ] = ""
    by: Annotated[
        str, typer.Option(help="Column that tells batches or specimens apart: one fit of all, and their spread.")
    ] = ""
    keep_tail: Annotated[bool, typer.Option("--keep-tail", help="Keep the points after the break.")] = False
    points: Annotated[int, typer.Option(help="Number of points that a curve is thinned to; 0 takes all.")] = 60
    each: Annotated[bool, typer.Option("--each", help="Every file is a material of its own.")] = False
    average: Annotated[
        bool, typer.Option("--average", help="Files are replicates: fit the mean of those of each mode.")
    ] = False
    starts: Annotated[int, typer.Option(min=1, help="Number of random starts of the search.")] = 20
    seed: Annotated[int, typer.Option(help="Seed of the random starts.")] = 0
    relaxation: Annotated[
        int, typer.Option(min=0, help="Terms of a Prony series, fitted over time after the law; 0 for none.")
    ] = 0
    softening: Annotated[bool, typer.Option("--softening", help="Fit stress softening to cycles too.")] = False
    rates: Annotated[bool, typer.Option("--rate-dependence", help="Fit the network of Bergström and Boyce.")] = False
    sets: Annotated[bool, typer.Option("--set", help="Fit the permanent set to loading and unloading.")] = False
    output: Annotated[Path | None, output_option("Folder for plots and constants.")] = None
    as_json: Json = False
    debug: Debug = False

    @property
    def behavior(self) -> Behavior:
        """What is fitted over time."""
        return Behavior(terms=self.relaxation, softening=self.softening, rates=self.rates, sets=self.sets)


def fit_files(chosen: FitOptions) -> None:
    """Fit laws to material tests, all files together, and rank them."""
    with errors_as_sentences(chosen.debug, chosen.as_json) as answer:
        from turgor.cli.answers.file_results import fit_result
        from turgor.cli.fitting.fit_groups import check_rubber, replicates_of, spreads_of

        names = [law.strip() for law in chosen.laws.split(",") if law.strip()]
        modes = modes_of(chosen.mode, len(chosen.files))
        _check(chosen)
        if chosen.behavior:
            tests, fit = _fit_over_time(chosen, modes, names)
            answer.give(lambda: fit_result(tests, (), fit, chosen.output))
            return
        tests = _tests(chosen, modes)
        name = common_name(chosen.files)
        replicates = replicates_of(tests, chosen.by, chosen.average)
        used = _means(tests, chosen.points) if chosen.average else tests
        rankings = _ranked(chosen, [(test.name, [test]) for test in used] if chosen.each else [(name, used)], names)
        if chosen.each:
            show_each(rankings, names)
        spreads = {}
        if replicates:
            within, weights = working_range(chosen.range_, chosen.working), _weights(chosen)
            spreads = spreads_of(rankings[0][1], replicates, within, weights, _kind(chosen.by))
        findings = check_rubber(rankings, chosen.rubber)
        if chosen.output is not None:
            write_fits(chosen.output, rankings, spreads)
        answer.give(lambda: fit_result(used, rankings, folder=chosen.output))
        answer.findings.extend(dict.fromkeys(each for _, ranking in rankings for each in ranking.best.findings))
        answer.findings.extend(findings)


#: The command.
fit_command = command_of(FitOptions, fit_files)


def _check(chosen: FitOptions) -> None:
    """Check options that exclude each other, before files are read."""
    working_range(chosen.range_, chosen.working)
    zero_of(chosen.zero)
    over_time = chosen.behavior
    if chosen.average and (chosen.each or over_time):
        raise TurgorError(f"--average goes with neither --each nor {_OVER_TIME}.")
    if chosen.by and (chosen.each or over_time):
        raise TurgorError(f"--by goes with neither --each nor {_OVER_TIME}.")
    if chosen.zero and (chosen.preload or over_time):
        raise TurgorError(f"--zero goes with neither --preload nor {_OVER_TIME}.")


def _kind(by: str) -> str:
    """Return what the groups of tests are."""
    from turgor.core.materials.experiments.columns import role_of

    return "specimens" if role_of(by) == "specimen" else "batches" if by else "replicates"


def _weights(chosen: FitOptions) -> str:
    return "even" if chosen.working else chosen.weights


def _tests(chosen: FitOptions, modes: Sequence[str | None]) -> "list[MaterialTest]":
    """Read all tests, crop them and thin them for the fit."""
    tests = []
    specimens = specimens_of(chosen.specimen, len(chosen.files))
    for file, mode, specimen in zip(chosen.files, modes, specimens, strict=True):
        several = chosen.average or chosen.by
        read = _read_all(chosen, file, mode, specimen) if several else [_read(chosen, file, mode, specimen)]
        for each in read:
            whole = _cropped(_handled(each, chosen), working_range(chosen.range_, chosen.working))
            test = whole if chosen.average else _thinned(whole, chosen.points)
            _tell(file, test)
            _tell_lost(whole, test)
            tests.append(test)
    return tests


def _tell_lost(whole: "MaterialTest", test: "MaterialTest") -> None:
    """Print findings about a test that its thinned points do not show."""
    from turgor.core.materials.fitting.fit_laws import check_tests

    shown = {each.code for each in check_tests([test], [test])}
    for finding in check_tests([whole], [whole], "even"):
        if finding.code not in shown:
            typer.echo(f"  {finding}")


def _means(tests: "Sequence[MaterialTest]", points: int) -> "list[MaterialTest]":
    """Average the replicates of each mode."""
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


def _spread(mean: "MaterialTest") -> str:
    """Sentence on how far replicates lie apart, for a mean of `average`."""
    assert mean.spread is not None
    share = (mean.spread / abs(mean.nominal_stress).max()).max()
    return f"The replicates scatter by up to {100 * share:.2g} % of the largest stress (standard deviation)."


def _tell(file: Path, test: "MaterialTest") -> None:
    """Print the content of a file and the edits."""
    typer.echo(f"{file.name}: {test!r}")
    for edit in test.edits:
        typer.echo(f"  {edit.text}")


def _ranked(
    chosen: FitOptions, groups: "Sequence[tuple[str, list[MaterialTest]]]", names: Sequence[str]
) -> "list[tuple[str, Ranking]]":
    """Rank the laws for each material; print the table where there is only one."""
    from turgor.core.materials.fitting.ranking import rank

    rankings = []
    for name, group in groups:
        ranking = rank(
            names, group, stretch=working_range(chosen.range_, chosen.working), weights=_weights(chosen),
            starts=chosen.starts, seed=chosen.seed,
        )  # fmt: skip
        rankings.append((name, ranking))
        if not chosen.each:
            show(ranking)
    return rankings


def _fit_over_time(
    chosen: FitOptions, modes: Sequence[str | None], names: list[str]
) -> "tuple[list[MaterialTest], HistoryFit]":
    """Fit the behavior in time to tests with all their cycles; slack points are at rest."""
    from turgor.cli.fitting.fit_history import fit_over_time, write_history_fit
    from turgor.core.materials.experiments.test_edits import rest_below

    preload, tests = preload_of(chosen.preload), []
    specimens = specimens_of(chosen.specimen, len(chosen.files))
    for file, mode, specimen in zip(chosen.files, modes, specimens, strict=True):
        test = _read(chosen, file, mode, specimen, cyclic=True)
        test = test if preload is None else rest_below(test, preload)
        _tell(file, test)
        tests.append(test)
    name = common_name(chosen.files)
    fit = fit_over_time(tests, names, chosen.behavior, name)
    if chosen.output is not None:
        write_history_fit(chosen.output, fit, tests)
    return tests, fit


def _read(
    chosen: FitOptions, file: Path, mode: str | None, specimen: "Specimen | None", cyclic: bool | None = None
) -> "MaterialTest":
    from turgor.core.materials.experiments.read_tests import read_test

    cyclic = chosen.cycle is not None if cyclic is None else cyclic
    measure = chosen.stress or None
    return read_test(file, mode=mode, stress_measure=measure, specimen=specimen, cyclic=cyclic)


def _read_all(
    chosen: FitOptions, file: Path, mode: str | None, specimen: "Specimen | None"
) -> "Sequence[MaterialTest]":
    from turgor.core.materials.experiments.read_tests import read_tests

    measure = chosen.stress or None
    columns = {"batch": chosen.by} if chosen.by else None
    return read_tests(
        file, mode=mode, stress_measure=measure, specimen=specimen, columns=columns, cyclic=chosen.cycle is not None
    )


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
