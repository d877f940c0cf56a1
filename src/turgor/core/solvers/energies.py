"""Energies: the energy balance of a moving actuator."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Protocol

from turgor.foundation.finding import Finding, Severity

#: Share of the largest energy that may be lost to the time integration, and of the strain energy to stabilization.
TOLERATED = 0.01


@dataclass(frozen=True, slots=True, kw_only=True)
class Energies:
    """Energies of a moving actuator since the start of the run, of the modeled part [J].

    Parameters
    ----------
    kinetic, strain : float [J]
        What moves and what is stored now.
    dissipated : float [J]
        What damping, viscous stabilization, friction, relaxation and softening have dissipated. Rubber that relaxes
        returns a part of it when it is unloaded slowly.
    work : float [J]
        What loads, moving supports and moving obstacles have done, plus the kinetic and strain energy at the start.
    lasting : float [J]
        The part of ``dissipated`` in a stabilized run that is due to friction and softening, not to viscous forces.
    """

    kinetic: float
    strain: float
    dissipated: float
    work: float
    lasting: float = 0.0

    @property
    def viscous(self) -> float:
        """Energy that viscous stabilization has dissipated [J]."""
        return self.dissipated - self.lasting

    @property
    def missing(self) -> float:
        """Work that is in none of the others [J]: numerical damping, and the error of the time integration."""
        return self.work - self.kinetic - self.strain - self.dissipated


class _WithEnergies(Protocol):
    @property
    def energies(self) -> Energies | None: ...


def largest_energy(states: Sequence[_WithEnergies]) -> float:
    """Largest sum of energies at any state of a path [J]; 0 where none were counted."""
    energies = [state.energies for state in states if state.energies is not None]
    return max((each.kinetic + each.strain + each.dissipated for each in energies), default=0.0)


def imbalance(states: Sequence[_WithEnergies]) -> float:
    """Largest energy that is missing at any state, over the largest energy of the path."""
    missing = [abs(state.energies.missing) for state in states if state.energies is not None]
    largest = largest_energy(states)
    return max(missing, default=0.0) / largest if largest > 0 else 0.0


def unbalanced(states: Sequence[_WithEnergies]) -> tuple[Finding, ...]:
    """Find out whether too much energy is missing from the balance of a dynamic run (L05)."""
    share = imbalance(states)
    if share <= TOLERATED:
        return ()
    return (
        Finding(
            code="L05",
            severity=Severity.WARNING,
            message=f"The energy balance of the run misses {100 * share:.2g} % of the energy.",
            advice="Ask for a smaller procedure.accuracy, or for a spectral_radius nearer to 1.",
        ),
    )


def too_viscous(states: Sequence[_WithEnergies]) -> tuple[Finding, ...]:
    """Find out whether viscous stabilization dissipated more than a small share of the strain energy (L06)."""
    last = next((state.energies for state in reversed(states) if state.energies is not None), None)
    if last is None or last.viscous <= TOLERATED * last.strain:
        return ()
    return (
        Finding(
            code="L06",
            severity=Severity.WARNING,
            message=f"Viscous stabilization took {last.viscous:.3g} J, {100 * last.viscous / last.strain:.2g} % "
            "of the strain energy.",
            advice="If the actuator snapped, slid or fell, that is the energy it released; else lower "
            "procedure.stabilization.",
        ),
    )
