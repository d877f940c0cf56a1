"""Behavior in time that ``turgor fit`` fits: relaxation, softening, dependence on the rate, permanent set."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from turgor.foundation.errors import TurgorError

if TYPE_CHECKING:
    from turgor.core.materials.experiments.material_test import MaterialTest
    from turgor.core.materials.fitting.histories.history_fit import HistoryFit
    from turgor.core.materials.laws.laws import Law


@dataclass(frozen=True, slots=True, kw_only=True)
class Behavior:
    """What is fitted over time.

    Parameters
    ----------
    terms : int
        Terms of the Prony series; 0 for none.
    softening : bool
        Whether to fit stress softening.
    rates : bool
        Whether to fit the network of Bergström and Boyce.
    sets : bool
        Whether to fit a permanent set.
    """

    terms: int = 0
    softening: bool = False
    rates: bool = False
    sets: bool = False

    def __post_init__(self) -> None:
        if self.terms and self.flows:
            raise TurgorError("--relaxation goes with neither --rate-dependence nor --set; leave one of them out.")

    def __bool__(self) -> bool:
        return bool(self.terms or self.softening or self.flows)

    @property
    def flows(self) -> bool:
        """Whether a network flows."""
        return self.rates or self.sets

    def fit(self, law: "Law", tests: "Sequence[MaterialTest]") -> "HistoryFit":
        """Fit it to tests with time, after a law."""
        if self.flows:
            from turgor.core.materials.fitting.histories.fit_flow import fit_flow

            return fit_flow(
                law, tests, rate_dependence=self.rates, permanent_set=self.sets, stress_softening=self.softening
            )
        from turgor.core.materials.fitting.histories.fit_history import fit_history

        return fit_history(law, tests, terms=self.terms, stress_softening=self.softening)
