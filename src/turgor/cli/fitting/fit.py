"""Command ``turgor fit``: read tests, fit laws, print their ranking, write plots and constants."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from turgor.cli.exits import errors_as_sentences
from turgor.cli.fitting.fit_tables import show, show_each
from turgor.cli.options import Debug, Json, command_of, output_option
from turgor.foundation.errors import TurgorError

if TYPE_CHECKING:
    from turgor.core.materials.experiments.material_test import MaterialTest
    from turgor.core.materials.experiments.specimen import Specimen
    from turgor.core.materials.fitting.history_fit import HistoryFit
    from turgor.core.materials.fitting.ranking import Ranking

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
    stress: Annotated[str, typer.Option(help="nominal or cauchy, where a file does not say.")] = ""
    weights: Annotated[str, typer.Option(help="relative or absolute.")] = "relative"
    specimen: Annotated[
        str, typer.Option(help="Length, width and thickness for files of force, such as '33 mm, 6 mm, 3 mm'.")
    ] = ""
    cycle: Annotated[
        int | None, typer.Option(help="Loading curve of cyclic tests: 1 the first, -1 the last.", show_default=False)
    ] = None
    preload: Annotated[str, typer.Option(help="Nominal stress at which the specimen is taut, such as '0.7 kPa'.")] = ""
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
    output: Annotated[Path | None, output_option("Folder for plots and constants.")] = None
    as_json: Json = False
    debug: Debug = False


def fit_files(chosen: FitOptions) -> None:
    """Fit laws to material tests, all files together, and rank them."""
    with errors_as_sentences(chosen.debug, chosen.as_json) as answer:
        from turgor.cli.answers.file_results import fit_result

        names = [law.strip() for law in chosen.laws.split(",") if law.strip()]
        modes = _modes(chosen.mode, len(chosen.files))
        _range(chosen.range_)  # checked before files are read
        if chosen.average and (chosen.each or chosen.relaxation or chosen.softening):
            raise TurgorError("--average goes with neither --each nor --relaxation nor --softening.")
        if chosen.relaxation or chosen.softening:
            tests, fit = _fit_over_time(chosen, modes, names)
            answer.give(lambda: fit_result(tests, (), fit, chosen.output))
            return
        if chosen.average:
            tests = _means(chosen, modes)
        else:
            tests = [_test(chosen, file, mode) for file, mode in zip(chosen.files, modes, strict=True)]
        groups = [(test.name, [test]) for test in tests] if chosen.each else [(_common_name(chosen.files), tests)]
        rankings = _ranked(chosen, groups, names)
        if chosen.each:
            show_each(rankings, names)
        if chosen.output is not None:
            _write(chosen.output, rankings)
        answer.give(lambda: fit_result(tests, rankings, folder=chosen.output))
        answer.findings.extend(dict.fromkeys(each for _, ranking in rankings for each in ranking.best.findings))


#: The command.
fit_command = command_of(FitOptions, fit_files)


def _test(chosen: FitOptions, file: Path, mode: str | None) -> "MaterialTest":
    """Read a test, crop it and thin it for the fit."""
    from turgor.core.materials.experiments.slack import check_slack

    read = _read(chosen, file, mode, cyclic=chosen.cycle is not None)
    whole = _cropped(_handled(read, chosen), _range(chosen.range_))
    test = _thinned(whole, chosen.points)
    _tell(file, test)
    for finding in check_slack([whole]) if not check_slack([test]) else ():  # few points of its beginning are left
        typer.echo(f"  {finding}")
    return test


def _means(chosen: FitOptions, modes: Sequence[str | None]) -> "list[MaterialTest]":
    """Read replicates, several in a file or one in each, and average those of each mode."""
    from turgor.core.materials.experiments.read_tests import read_tests
    from turgor.core.materials.experiments.test_edits import average

    measure, specimen = chosen.stress or None, _specimen(chosen.specimen)
    by_mode: dict[str, list[MaterialTest]] = {}
    for file, mode in zip(chosen.files, modes, strict=True):
        cyclic = chosen.cycle is not None
        for read in read_tests(file, mode=mode, stress_measure=measure, specimen=specimen, cyclic=cyclic):
            test = _cropped(_handled(read, chosen), _range(chosen.range_))
            _tell(file, test)
            by_mode.setdefault(test.mode, []).append(test)
    means = []
    for mode, group in by_mode.items():
        if len(group) == 1:
            raise TurgorError(f"--average has one {mode} test only; give two replicates or more of each mode.")
        name = f"mean of {len(group)} {mode}"
        mean = average(group, points=chosen.points, name=name) if chosen.points else average(group, name=name)
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
            names, group, stretch=_range(chosen.range_), weights=chosen.weights, starts=chosen.starts, seed=chosen.seed
        )
        rankings.append((name, ranking))
        if not chosen.each:
            show(ranking)
    return rankings


def _fit_over_time(
    chosen: FitOptions, modes: Sequence[str | None], names: list[str]
) -> "tuple[list[MaterialTest], HistoryFit]":
    """Fit relaxation and softening to tests with all their cycles; slack points are at rest."""
    from turgor.cli.fitting.fit_history import fit_over_time, write_history_fit
    from turgor.core.materials.experiments.test_edits import rest_below

    preload, tests = _preload(chosen.preload), []
    for file, mode in zip(chosen.files, modes, strict=True):
        test = _read(chosen, file, mode, cyclic=True)
        test = test if preload is None else rest_below(test, preload)
        _tell(file, test)
        tests.append(test)
    name = _common_name(chosen.files)
    fit = fit_over_time(tests, names, terms=chosen.relaxation, softening=chosen.softening, name=name)
    if chosen.output is not None:
        write_history_fit(chosen.output, fit, tests)
    return tests, fit


def _read(chosen: FitOptions, file: Path, mode: str | None, cyclic: bool) -> "MaterialTest":
    from turgor.core.materials.experiments.read_tests import read_test

    measure, specimen = chosen.stress or None, _specimen(chosen.specimen)
    return read_test(file, mode=mode, stress_measure=measure, specimen=specimen, cyclic=cyclic)


def _handled(test: "MaterialTest", chosen: FitOptions) -> "MaterialTest":
    from turgor.core.materials.experiments.cycles import select_cycle
    from turgor.core.materials.experiments.test_edits import remove_slack, remove_tail

    cycle, preload = chosen.cycle, _preload(chosen.preload)
    if cycle is not None:
        test = select_cycle(test, cycle)
    if not chosen.keep_tail and test.mode != "biaxial":
        test = remove_tail(test)
    return test if preload is None else remove_slack(test, preload)


def _cropped(test: "MaterialTest", ends: tuple[float, float] | None) -> "MaterialTest":
    from turgor.core.materials.experiments.test_edits import crop

    return test if ends is None or test.mode in ("biaxial", "simple_shear") else crop(test, *ends)


def _thinned(test: "MaterialTest", points: int) -> "MaterialTest":
    from turgor.core.materials.experiments.test_edits import thin

    return thin(test, points) if points and test.mode not in ("biaxial", "simple_shear") else test


def _write(folder: Path, rankings: "Sequence[tuple[str, Ranking]]") -> None:
    from turgor.core.materials.fitting.save import can_be_saved, save_fits
    from turgor.views.plots.fits import fit_figure, write_fit_plot

    folder.mkdir(parents=True, exist_ok=True)
    unsaved: dict[str, None] = {}
    for name, ranking in rankings:
        stem = "-".join(name.lower().split())
        write_fit_plot(folder / f"{stem}.png", fit_figure(ranking.fits, title=name))
        saved = [fit for fit in ranking.fits if can_be_saved(fit)]
        if saved:
            save_fits(folder / f"{stem}.toml", name, saved)
        unsaved |= {fit.spec.name: None for fit in ranking.fits if fit not in saved}
    if unsaved:
        typer.echo(f"Files of constants have no form for {', '.join(unsaved)} yet; see the plots.")
    typer.echo(f"Plots and constants in {folder}.")


def _range(text: str) -> tuple[float, float] | None:
    if not text:
        return None
    try:
        low, high = (float(part) for part in text.split(":"))
    except ValueError:
        raise TurgorError(f"--range is '{text}'; write smallest and largest stretch, for example 1:4.") from None
    return low, high


def _modes(text: str, count: int) -> list[str | None]:
    given: list[str | None] = [part.strip() or None for part in text.split(",")]
    if len(given) == 1:
        return given * count
    if len(given) != count:
        raise TurgorError(f"--mode names {len(given)} modes for {count} files; give one, or one for each file.")
    return given


def _specimen(text: str) -> "Specimen | None":
    from turgor.core.materials.experiments.specimen import Specimen
    from turgor.units import parse_quantity

    if not text:
        return None
    sizes = [parse_quantity(part.strip(), "length") for part in text.split(",")]
    if len(sizes) != 3:
        raise TurgorError(
            f"--specimen is '{text}'; write length, width and thickness, for example '33 mm, 6 mm, 3 mm'."
        )
    return Specimen(length=sizes[0], width=sizes[1], thickness=sizes[2])


def _preload(text: str) -> float | None:
    from turgor.units import parse_quantity

    return parse_quantity(text, "pressure") if text else None


def _common_name(files: Sequence[Path]) -> str:
    """Name of the only file, or of the folder that all share."""
    folder = files[0].resolve().parent.name
    return files[0].stem if len(files) == 1 else folder or "fit"
