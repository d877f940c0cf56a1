"""Command ``turgor fit``: read tests, fit laws, print their ranking, write plots and constants."""

from collections.abc import Sequence
from typing import TYPE_CHECKING

from turgor.cli.exits import errors_as_sentences
from turgor.cli.fitting.fit_cuts import check_directions, fit_cuts
from turgor.cli.fitting.fit_files import write_fits
from turgor.cli.fitting.fit_options import FitOptions
from turgor.cli.fitting.fit_reading import means_of, read_all_tests, read_one, tell
from turgor.cli.fitting.fit_tables import show, show_each
from turgor.cli.fitting.fit_texts import common_name, modes_of, preload_of, specimens_of, working_range, zero_of
from turgor.cli.options import command_of
from turgor.foundation.errors import TurgorError

if TYPE_CHECKING:
    from turgor.core.materials.experiments.material_test import MaterialTest
    from turgor.core.materials.fitting.histories.history_fit import HistoryFit
    from turgor.core.materials.fitting.ranking import Ranking

#: Options of fits over time, in messages.
_OVER_TIME = "--relaxation nor --softening nor --rate-dependence nor --set"


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
        tests = read_all_tests(chosen, modes)
        if chosen.directions:
            cuts = fit_cuts(chosen, tests)
            answer.give(lambda: fit_result(tests, (), folder=chosen.output, directions=cuts))
            return
        name = common_name(chosen.files)
        replicates = replicates_of(tests, chosen.by, chosen.average)
        used = means_of(tests, chosen.points) if chosen.average else tests
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
    check_directions(chosen)
    if chosen.rubber:
        from turgor.core.materials.library.record_files import records

        records(chosen.rubber)
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
        test = read_one(chosen, file, mode, specimen, cyclic=True)
        test = test if preload is None else rest_below(test, preload)
        tell(file, test)
        tests.append(test)
    name = common_name(chosen.files)
    fit = fit_over_time(tests, names, chosen.behavior, name)
    if chosen.output is not None:
        write_history_fit(chosen.output, fit, tests)
    return tests, fit


def _weights(chosen: FitOptions) -> str:
    return "even" if chosen.working else chosen.weights
