"""Arguments and options of ``turgor fit``."""

from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

import typer

from turgor.cli.fitting.fit_behavior import Behavior
from turgor.cli.options import Compliance, Debug, Json, output_option

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
    compliance: Compliance = ""
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
    directions: Annotated[
        str,
        typer.Option(
            help="Fit a law with directions: along, across or through for each file; warp, weft and bias of a fabric; "
            "or the column that says so."
        ),
    ] = ""
    fixed: Annotated[
        str, typer.Option(help="Parameters of that law that are known, such as 'a3=0 kPa, C30=0 kPa'.")
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
