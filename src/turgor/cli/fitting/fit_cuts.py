"""``turgor fit --directions``: a law with directions, fitted to specimens that were cut along them."""

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import typer

from turgor.cli.fitting.fit_options import DEFAULT_LAWS, FitOptions
from turgor.cli.fitting.fit_texts import CUTS, STRIPS, common_name, cuts_of, fixed_of, names_cuts
from turgor.foundation.errors import TurgorError, unknown

if TYPE_CHECKING:
    from turgor.core.materials.experiments.material_test import MaterialTest
    from turgor.core.materials.fitting.fit_directions import DirectionsFit
    from turgor.core.materials.fitting.fit_woven import WovenFit

#: Law that is fitted by default: that of a print; that of strips of a fabric.
LAW, WOVEN = "orthotropic", "woven"


#: What the table for a job says above it, for a body and for a fabric, and its region.
_NOTES = (
    (
        "Fitted by turgor: copy this table into a job, and turn its directions to those of",
        "the part. Files of records have no directions.",
    ),
    (
        "Fitted by turgor: copy this table into a job, and add the thickness by which the forces of",
        'the strips were divided, and the direction of the warp: thickness = "0.2 mm", warp = "x".',
    ),
)
_REGIONS = ("body", "strain_limiting_layer")


def fit_cuts(chosen: FitOptions, tests: "Sequence[MaterialTest]") -> "list[DirectionsFit | WovenFit]":
    """Fit each law to specimens that were cut along directions, print the constants, and write them with a picture.

    Parameters
    ----------
    chosen : FitOptions
    tests : sequence of MaterialTest
        In the order of the files, or with the direction as their batch.
    """
    from turgor.core.materials.fitting.fit_laws import check_tests

    by_cut: dict[str, list[MaterialTest]] = {}
    for cut, test in zip(_cuts(chosen, tests), tests, strict=True):
        by_cut.setdefault(cut, []).append(test)
    usual = WOVEN if set(by_cut) <= set(STRIPS) else LAW
    laws = [usual] if chosen.laws == DEFAULT_LAWS else [law.strip() for law in chosen.laws.split(",") if law.strip()]
    fits = [_fit(chosen, law, by_cut) for law in laws]
    for law, result in zip(laws, fits, strict=True):
        _tell(law, result)
    for finding in check_tests(tests, tests, "even"):
        typer.echo(str(finding))
    if chosen.output is not None:
        _write(chosen.output, common_name(chosen.files), laws, fits)
    return fits


def _fit(chosen: FitOptions, law: str, by_cut: "dict[str, list[MaterialTest]]") -> "DirectionsFit | WovenFit":
    """Fit one law."""
    fixed = fixed_of(chosen.fixed)
    if law == WOVEN:
        from turgor.core.materials.fitting.fit_woven import fit_woven

        if list(fixed) != ["nu"]:
            raise TurgorError(
                "strips do not show the contraction of a woven fabric: state nu, and nothing else, with --fixed, "
                "such as --fixed nu=0.2; it moves the shear modulus by a few percent."
            )
        return fit_woven(by_cut, nu=fixed["nu"])
    from turgor.core.materials.fitting.fit_directions import fit_directions

    starts = min(chosen.starts, 4)  # each specimen needs a search for its width, and four agree on prints
    return fit_directions(law, by_cut, fixed=fixed, starts=starts, seed=chosen.seed)


def check_directions(chosen: FitOptions) -> None:
    """Check the options that go with ``--directions``, before files are read.

    Parameters
    ----------
    chosen : FitOptions
    """
    if chosen.fixed and not chosen.directions:
        raise TurgorError("--fixed goes with --directions, such as --directions along,across.")
    if not chosen.directions:
        return
    others = {"--by": chosen.by, "--each": chosen.each, "--average": chosen.average, "--softening": chosen.softening}
    others |= {"--relaxation": chosen.relaxation, "--rate-dependence": chosen.rates, "--set": chosen.sets}
    given = [name for name, value in others.items() if value]
    if given:
        why = (
            " Laws with directions do not relax or soften here." if given[-1] in ("--relaxation", "--softening") else ""
        )
        raise TurgorError(f"--directions does not go with {' and '.join(given)}.{why}")
    count = len(cuts_of(chosen.directions))
    for cut in cuts_of(chosen.directions) if count > 1 else ():
        if cut not in (*CUTS, *STRIPS):
            raise unknown("direction in --directions", cut, (*CUTS, *STRIPS))
    if names_cuts(chosen.directions) and count != len(chosen.files):
        raise TurgorError(
            f"--directions names {count} direction{'s' * (count > 1)} for {len(chosen.files)} files; give one for each "
            "file, or the name of the column that says so."
        )
    fixed_of(chosen.fixed)


def _cuts(chosen: FitOptions, tests: "Sequence[MaterialTest]") -> list[str]:
    """Direction of each test."""
    if names_cuts(chosen.directions):
        return cuts_of(chosen.directions)
    return [test.batch.strip().lower() for test in tests]


def _tell(law: str, result: "DirectionsFit | WovenFit") -> None:
    """Print the constants of a law and how far each test is off."""
    from turgor.units import deg

    typer.echo(f"{law}: {100 * result.relative:.2g} % off (root mean square of the relative error)")
    for name, value in result.values.items():
        typer.echo(f"  {name} = {_shown(law, name, value)} ± {_shown(law, name, result.errors[name])}")
    for cut, test in result.tests:
        low, high = test.range
        typer.echo(f"  {cut}, {test.name}: {100 * result.off(cut, test):.2g} % off, stretch {low:.3g} to {high:.3g}")
    zero = [name for name, value in result.values.items() if value == 0]
    if zero:
        typer.echo(f"  {', '.join(zero)} {'is' if len(zero) == 1 else 'are'} 0, the least value: not needed.")
    loose = [name for name, value in result.values.items() if value and result.errors[name] > 0.5 * abs(value)]
    if loose:
        typer.echo(f"  The tests hardly determine {', '.join(loose)}: state it with --fixed, or add a test.")
    if "angle" in result.values:
        typer.echo(f"  Fibers lie at {result.values['angle'] / deg:.3g}° on both sides of the first direction.")


def _shown(law: str, name: str, value: float) -> str:
    from turgor.core.materials.fitting.result import stress_text
    from turgor.core.materials.laws.conventions import has_no_unit
    from turgor.units import deg

    if name == "angle":
        return f"{value / deg:.3g}°"
    return f"{value:.4g}" if has_no_unit(name) else stress_text(value)


def _write(folder: Path, name: str, laws: Sequence[str], fits: "Sequence[DirectionsFit | WovenFit]") -> None:
    """Write a picture and the table of a job for each law."""
    import tomlkit

    from turgor.core.materials.fitting.save import job_table
    from turgor.views.plots.fits import directions_figure, write_fit_plot

    folder.mkdir(parents=True, exist_ok=True)
    for law, result in zip(laws, fits, strict=True):
        stem = "-".join([*name.lower().split(), law.replace("_", "-")])
        write_fit_plot(folder / f"{stem}.png", directions_figure(result, title=f"{name}: {law}"))
        document = tomlkit.document()
        for line in _NOTES[law == WOVEN]:
            document.add(tomlkit.comment(line))
        document["materials"] = {_REGIONS[law == WOVEN]: job_table(result.material())}
        (folder / f"{stem}.toml").write_text(tomlkit.dumps(document), encoding="utf-8")
    typer.echo(f"Pictures, and tables for a job, in {folder}.")
