"""Behavior of rubber in time as Abaqus writes it: viscoelasticity, stress softening and permanent set."""

from dataclasses import dataclass

import numpy as np

from turgor.core.materials.history.permanent_set import PermanentSet
from turgor.core.materials.material import Material
from turgor.foundation.errors import TurgorError
from turgor.units import MPa


@dataclass(frozen=True, slots=True, kw_only=True)
class SetTable:
    """Rows of the hardening curve of a permanent set, which Abaqus takes as a table.

    Parameters
    ----------
    rows : int
        With strains in a geometric row, so that a power is a line between neighbors within 1 %.
    least, most : float [-]
        First and last log plastic strain; rubbers keep less than the last one.
    """

    rows: int = 41
    least: float = 1e-5
    most: float = 1.0


SET_TABLE = SetTable()


def moduli_of(material: Material) -> str:
    """Option of ``*HYPERELASTIC`` that says what the constants of a rubber that relaxes mean; else empty."""
    if material.flowing_network is not None:
        return ", MODULI=LONG TERM"
    return "" if material.prony is None else f", MODULI={material.prony.moduli.upper().replace('_', ' ')}"


def history_lines(name: str, material: Material, program: str) -> list[str]:
    """Write viscoelasticity, stress softening and permanent set in N, mm, MPa and s.

    Parameters
    ----------
    name : str
        Name in the file.
    material : Material
        A rubber.
    program : str
        ``"abaqus"`` or ``"calculix"``.

    Raises
    ------
    TurgorError
        If the program has no such behavior.

    Examples
    --------
    >>> from turgor.core.materials.history.bergstrom_boyce import BergstromBoyce
    >>> from turgor.core.materials.laws.laws import NeoHooke
    >>> flowing = BergstromBoyce.from_abaqus(S=1.6, A=0.5, m=4)
    >>> history_lines("body", Material(name="rubber", law=NeoHooke(C10=1e5), viscoelasticity=flowing), "abaqus")
    ['*HYSTERESIS', '1.6, 0.5, 4, -1, 0.01']
    """
    series, network = material.prony, material.flowing_network
    mullins, plastic = material.stress_softening, material.permanent_set
    if program == "calculix" and material.remembers:
        raise TurgorError(
            f"materials.{name}: CalculiX has neither viscoelasticity nor stress softening nor permanent set of a "
            "rubber; leave them out, or write for Abaqus."
        )
    _check_together(name, material)
    lines = []
    if series is not None:
        rows = [row([g, 0.0, tau]) for g, tau in zip(series.g, series.tau, strict=True)]
        lines += ["*VISCOELASTIC, TIME=PRONY", *rows]
    if network is not None:
        A = network.rate / (network.stress / MPa) ** network.exponent
        constants = [network.stiffness, A, network.exponent, network.strain_exponent, network.offset]
        lines += ["*HYSTERESIS", row(constants)]
    if plastic is not None:
        lines += ["*PLASTIC, HARDENING=ISOTROPIC", *_hardening(plastic)]
    if mullins is not None:
        lines += ["*MULLINS EFFECT", row([mullins.r, mullins.m / MPa, mullins.beta])]
    return lines


def _check_together(name: str, material: Material) -> None:
    """Refuse pairs that Abaqus does not have, or understands in another way."""
    series, network = material.prony, material.flowing_network
    mullins, plastic = material.stress_softening, material.permanent_set
    if series is not None and mullins is not None:
        raise TurgorError(
            f"materials.{name}: '{material.name}' relaxes and softens; Abaqus would soften its long-term stress alone "
            "and turgor softens all of it, so the file would be another rubber. Leave one out."
        )
    if network is not None and (mullins is not None or plastic is not None):
        other = "stress_softening" if mullins is not None else "permanent_set"
        raise TurgorError(
            f"materials.{name}: '{material.name}' has the viscoelasticity of Bergström and Boyce and a {other}; "
            "*HYSTERESIS of Abaqus takes neither softening nor plasticity. Leave one out."
        )


def _hardening(plastic: PermanentSet) -> list[str]:
    """Rows of stress and log plastic strain, the first one at no strain."""
    strain = np.geomspace(SET_TABLE.least, SET_TABLE.most, SET_TABLE.rows)
    stress = (plastic.onset + plastic.stress * strain ** (1.0 / plastic.exponent)) / MPa
    first = plastic.onset / MPa if plastic.onset > 0 else 0.5 * stress[0]  # Abaqus needs a stress above 0
    pairs = [(first, 0.0), *zip(stress.tolist(), strain.tolist(), strict=True)]
    return [f"{s:.6g}, {e:.6g}" for s, e in pairs]


def row(numbers: list[float]) -> str:
    """One line of numbers."""
    return ", ".join(f"{value:.15g}" for value in numbers)
