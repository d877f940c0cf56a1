"""Groups of tests in ``turgor fit``: batches and replicates with their spread, and the rubber in the library."""

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

import typer

from turgor.foundation.errors import TurgorError

if TYPE_CHECKING:
    from turgor.core.materials.experiments.material_test import MaterialTest
    from turgor.core.materials.fitting.ranking import Ranking
    from turgor.core.materials.fitting.result import Fit
    from turgor.core.materials.library.fit_spread import FitSpread
    from turgor.foundation.finding import Finding

Groups = Mapping[str, "Sequence[MaterialTest]"]


def replicates_of(tests: "Sequence[MaterialTest]", by: str, average: bool) -> Groups:
    """Return the tests of each batch, or each replicate of ``--average``; empty where there is one group.

    Parameters
    ----------
    tests : sequence of MaterialTest
    by : str
        Column of the batches.
    average : bool
    """
    groups: dict[str, list[MaterialTest]] = {}
    if by:
        for test in tests:
            groups.setdefault(test.batch, []).append(test)
        if len(groups) < 2:
            raise TurgorError(f"--by: the column '{by}' holds one value, '{next(iter(groups))}'; leave --by out.")
    elif average and len({test.mode for test in tests}) == 1:
        groups = {test.name: [test] for test in tests}
    return groups


def spreads_of(
    ranking: "Ranking", groups: Groups, stretch: tuple[float, float] | None, weights: str, of: str
) -> "dict[str, FitSpread]":
    """Fit the laws of a ranking to each group, print the constants of the best, and return the spread of each law.

    Parameters
    ----------
    ranking : Ranking
        Of all tests together.
    groups : mapping of str to sequence of MaterialTest
    stretch, weights
        See `turgor.fit`.
    of : str
        What the groups are.

    Returns
    -------
    dict of str to FitSpread
        By the name of the law, without laws of several exponents, whose terms may change places.
    """
    from turgor.core.materials.fitting.fit_laws import fit
    from turgor.core.materials.fitting.uncertainty import scatter, spread_between

    spreads: dict[str, FitSpread] = {}
    for whole in ranking.fits:
        if scatter(whole) is None or len(whole.spec.shapes) > 1:  # constants of one curve differ without a meaning
            continue
        try:
            fits = {
                name: fit(whole.spec, tests, stretch=stretch, weights=weights, starts=5)
                for name, tests in groups.items()
            }
        except TurgorError as error:
            typer.echo(f"{whole.spec.name} has no spread between {of}: {error}")
            continue
        spreads[whole.spec.name] = spread_between(list(fits.values()), of)
        if len(spreads) == 1:
            _tell(whole, fits, of)
    return spreads


def _tell(whole: "Fit", fits: "Mapping[str, Fit]", of: str) -> None:
    """Print the constants of a law for each group, and how far their moduli differ."""
    typer.echo(f"Constants of {whole.spec.name} by {of}:")
    for name, each in fits.items():
        typer.echo(f"  {name}: {each.describe()}")
    from turgor.core.materials.fitting.result import stress_text

    moduli = [each.law.shear_modulus for each in fits.values()]
    middle = sum(moduli) / len(moduli)
    deviation = (sum((value - middle) ** 2 for value in moduli) / (len(moduli) - 1)) ** 0.5
    typer.echo(
        f"The initial modulus differs between {len(fits)} {of} by {100 * deviation / middle:.2g} % (standard "
        f"deviation), E from {stress_text(3 * min(moduli))} to {stress_text(3 * max(moduli))}. The file of constants "
        "carries this spread: turgor uncertainty --spread materials.body=fitted."
    )


def check_rubber(rankings: "Sequence[tuple[str, Ranking]]", rubber: str) -> "list[Finding]":
    """Compare the best law of each material with the library, and print how.

    Parameters
    ----------
    rankings : sequence of (str, Ranking)
    rubber : str
        Name in the library; by default the one that the name of the material or of a test contains.
    """
    from turgor.core.materials.fitting.library_check import check_library, rubber_of

    findings: list[Finding] = []
    for name, ranking in rankings:
        best = ranking.best
        names = (name, *(test.name for test in best.tests))
        known = rubber or next(filter(None, map(rubber_of, names)), "")
        if known:
            findings += check_library(best.law, known, best.stretch_range[1])
    for text in dict.fromkeys(f"{each.message} {each.advice} ({each.code})" for each in findings):
        typer.echo(text)
    return findings
