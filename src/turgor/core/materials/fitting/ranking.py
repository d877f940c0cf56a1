"""Ranking of laws on the same tests, with sentences that explain the numbers."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from turgor.core.materials.experiments.material_test import MaterialTest
from turgor.core.materials.fitting.fit_laws import fit
from turgor.core.materials.fitting.modes import missing_modes
from turgor.core.materials.fitting.result import Fit
from turgor.core.materials.fitting.settings import FIT
from turgor.core.materials.laws.stability import Criterion, instabilities
from turgor.foundation.display import brief
from turgor.foundation.errors import TurgorError

#: What happens where each criterion of stability fails.
_FAILS: Mapping[Criterion, str] = {
    "nominal": "the nominal stress has an extreme",
    "cauchy": "the Cauchy stress has an extreme",
    "drucker": "Drucker's postulate fails",
}


#: Findings that concern the tests, not a law.
OF_TESTS = ("P08", "P10", "P11", "P12", "P13", "P14")


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Ranking:
    """Fits of several laws to the same tests, the best first.

    Parameters
    ----------
    fits : tuple of Fit
        In the order of Akaike's criterion; laws that lose their stability where soft actuators work come last.
    failed : tuple of str
        A sentence for each law that could not be fitted.
    """

    fits: tuple[Fit, ...]
    failed: tuple[str, ...] = ()

    __repr__ = brief

    @property
    def best(self) -> Fit:
        """The first fit: of the stable laws that with the smallest AIC."""
        return self.fits[0]

    @property
    def words(self) -> tuple[str, ...]:
        """Sentences that help to choose a law: order, modes, range and search."""
        return (
            *_on_order(self.fits),
            *_on_modes(self.fits),
            *missing_modes([each for each in self.fits if _unstable(each) == _unstable(self.best)]),
            *_on_range(self.fits),
            *_on_search(self.fits),
            *_on_tests(self.fits),
        )


def rank(
    laws: Sequence[str | type],
    tests: MaterialTest | Sequence[MaterialTest],
    *,
    stretch: tuple[float, float] | None = None,
    weights: str = "relative",
    starts: int = 20,
    seed: int = 0,
) -> Ranking:
    """Fit several laws to the same tests and order them by Akaike's criterion, the best first, the stable ones before.

    Parameters
    ----------
    laws : sequence of str or type
        Such as ``["yeoh", "ogden-3"]``.
    tests, stretch, weights, starts, seed
        See `fit`.
    """
    if not laws:
        raise TurgorError("no law was given; name one or more, for example 'yeoh'.")
    fits, failed = [], []
    for law in laws:
        try:
            fits.append(fit(law, tests, stretch=stretch, weights=weights, starts=starts, seed=seed))
        except TurgorError as error:
            failed.append(str(error))
    if not fits:
        raise TurgorError(" ".join(dict.fromkeys(failed)))
    return Ranking(fits=tuple(sorted(fits, key=lambda each: (_unstable(each), each.aic))), failed=tuple(failed))


def _unstable(fitted: Fit) -> bool:
    """Whether a law loses its stability within the range of its tests or the usual one of soft actuators."""
    return bool(fitted.instability) or any(finding.code == "M06" for finding in fitted.findings)


def _on_order(fits: Sequence[Fit]) -> list[str]:
    lines = []
    for each in fits:
        limit = getattr(each.law, "max_stretch_hint", None)
        if limit is not None and each.stretch[1] > limit:
            lines.append(
                f"{each.spec.name} suits strains up to {100 * (limit - 1):.0f} %; over the "
                f"{100 * (each.stretch[1] - 1):.0f} % wanted it is {100 * each.relative:.2g} % off (M03)."
            )
    best = fits[0]
    alike = [each for each in fits if _unstable(each) == _unstable(best)]
    good = [each for each in alike if each.relative <= FIT.alike * min(other.relative for other in alike)]
    fewest = min(good, key=lambda each: (len(each.spec.names), each.aic))
    lines += [
        f"{each.spec.name} is closer, {100 * each.relative:.2g} % off, but comes later because it loses its stability."
        for each in fits
        if each.aic < best.aic
    ]
    if fewest is best:
        lines.append(f"{best.spec.name} fits best, {100 * best.relative:.2g} % off.")
    else:
        few = len(fewest.spec.names)
        lines.append(
            f"{best.spec.name} fits best, {100 * best.relative:.2g} % off; {fewest.spec.name} is nearly as good, "
            f"{100 * fewest.relative:.2g} %, with {few} parameter{'s' if few > 1 else ''}, not {len(best.spec.names)}."
        )
    return lines


def _on_modes(fits: Sequence[Fit]) -> list[str]:
    """Sentences of M02, each once with the names of its laws, and the advice once."""
    lines: dict[str, list[str]] = {}
    advice = ""
    for each in fits:
        for finding in each.findings:
            if finding.code == "M02":
                lines.setdefault(finding.message, []).append(each.spec.name)
                advice = finding.advice
    return [f"{', '.join(names)}: {message} (M02)" for message, names in lines.items()] + ([advice] if advice else [])


def _on_tests(fits: Sequence[Fit]) -> list[str]:
    """Sentences on the tests themselves: copies, slack, and where their points lie."""
    of_tests = [finding for finding in fits[0].findings if finding.code in OF_TESTS]
    return [f"{finding.message} {finding.advice} ({finding.code})" for finding in of_tests]


def _on_range(fits: Sequence[Fit]) -> list[str]:
    low, high = fits[0].stretch_range
    lines = [f"Use these constants only from stretch {low:.3g} to {high:.3g}, the range of the tests (M01)."]
    beyond = [finding for finding in fits[0].findings if finding.code == "M01"]
    if beyond:
        least, most = fits[0].stretch
        lines.append(f"You requested {least:.3g} to {most:.3g}, more than the tests cover.")
    return lines


def _on_search(fits: Sequence[Fit]) -> list[str]:
    lines = []
    for each in fits:
        agreed, starts = each.starts
        if starts > 1 and agreed < 0.2 * starts:
            lines.append(f"{each.spec.name}: only {agreed} of {starts} starts found this fit; try more starts.")
        loose = each.undetermined
        if loose and not each.unconstrained:
            lines.append(f"{each.spec.name}: the tests determine only a combination of {loose[0]} and {loose[1]}.")
        lines += [f"{each.spec.name} {_lost(each, mode)}" for mode in each.instability]
        if not each.instability:  # M06 then concerns stretches beyond the range
            lines += [
                f"{each.spec.name}: {finding.message} (M06)" for finding in each.findings if finding.code == "M06"
            ]
        if each.bounds_hit:
            lines.append(f"{each.spec.name}: {'; '.join(each.bounds_hit)}.")
    return lines


def _lost(fitted: Fit, mode: str) -> str:
    """Sentence about where stability is lost in a mode, by the strictest criterion and by the others."""
    low, high = min(fitted.stretch[0], 1.0), max(fitted.stretch[1], 1.0)
    first, *others = instabilities(fitted.law, mode, high, low).items()  # type: ignore[arg-type]
    rest = "".join(f"; {_FAILS[name]} at {at:.4g}" for name, at in others)
    return f"loses its stability in {mode} tests at stretch {first[1]:.4g}, where {_FAILS[first[0]]}{rest}."
