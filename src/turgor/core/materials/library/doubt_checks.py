"""The checks behind `turgor.core.materials.library.doubts`: each takes one record and yields its doubts."""

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, fields
from functools import cached_property
from itertools import pairwise
from math import inf, log

import numpy as np

from turgor.core.materials.laws.conventions import law_from_printed, ogden_moduli
from turgor.core.materials.laws.laws import Hooke, Law
from turgor.core.materials.laws.pull import pull
from turgor.core.materials.library.record import Record
from turgor.core.materials.library.record_files import all_records
from turgor.core.materials.library.settings import DOUBTS
from turgor.foundation.errors import TurgorError
from turgor.foundation.finding import Severity

#: Stretches that walls of soft actuators see, by mode: from 50 % compression to 300 %, or 200 % in both directions.
USUAL_RANGE: Mapping[str, tuple[float, float]] = {
    "uniaxial": (0.5, 4.0),
    "planar": (0.5, 4.0),
    "equibiaxial": (0.7, 3.0),
}


@dataclass(frozen=True, slots=True, kw_only=True)
class Doubt:
    """One reason to doubt a record.

    Parameters
    ----------
    code : str
        ``"M04"`` to ``"M07"``.
    kind : str
        What it is in a word or two, such as ``"borrowed"``.
    message : str
        One or two sentences with the numbers.
    severity : Severity
        A note where the library has settled the question, a warning otherwise.

    Examples
    --------
    >>> print(Doubt(code="M06", kind="unstable", message="Pulled further, it pulls less."))
    M06 unstable: Pulled further, it pulls less.
    """

    code: str
    kind: str
    message: str
    severity: Severity = field(default=Severity.WARNING)

    def __str__(self) -> str:
        return f"{self.code} {self.kind}: {self.message}"


@dataclass(frozen=True)
class Case:
    """A record with the others that it is compared with; None for those of the library."""

    record: Record
    given: Sequence[Record] | None

    @cached_property
    def others(self) -> Sequence[Record]:
        """The library is read once a check looks at it."""
        return all_records() if self.given is None else self.given

    @cached_property
    def law(self) -> Law | Hooke | None:
        """The law; None where none can have the constants."""
        return _law(self.record)

    @property
    def rubber(self) -> Law | None:
        """The law, where it is one of a rubber."""
        return None if self.law is None or isinstance(self.law, Hooke) else self.law


def _law(record: Record) -> Law | Hooke | None:
    try:
        return record.build_law()
    except TurgorError:
        return None


def _negative_modulus(case: Case) -> Iterator[Doubt]:
    modulus = _printed_modulus(case.record)
    if modulus is not None and not modulus > 0:
        text = f"the initial shear modulus is {_kPa(modulus)}, so that the rubber is unstable at rest; no law has it."
        yield Doubt(code="M06", kind="negative modulus", message=_sentence(text))


def _unstable(case: Case) -> Iterator[Doubt]:
    if case.rubber is not None and case.record.kind == "rubber":
        yield from unstable_law(case.rubber)


def unstable_law(law: Law) -> Iterator[Doubt]:
    """Find out whether the stress of a law has an extreme within the usual range of soft actuators (M06)."""
    limits = []
    for mode, (lower, upper) in USUAL_RANGE.items():
        for end in (upper, lower):
            limit = falls_at(law, mode, end)
            if limit is not None:
                limits.append(f"{mode} {'tension' if end > 1 else 'compression'} at stretch {limit:.2f}")
    if limits:
        text = f"the nominal stress passes an extreme in {', '.join(limits)}, within the usual range of soft actuators."
        yield Doubt(code="M06", kind="unstable", message=_sentence(text))


def _borrowed(case: Case) -> Iterator[Doubt]:
    """Find the same constants under two materials; the one whose properties they contradict has borrowed them."""
    record = case.record
    if not _misfit(record) > log(DOUBTS.far):  # its own constants
        return
    others = [other for other in case.others if other.material_name != record.material_name]
    lender = min((other for other in others if _same(record, other)), key=_misfit, default=record)
    if _misfit(record) > _misfit(lender):
        nearly = "" if record.constants == lender.constants else "nearly "
        text = (
            f"the constants ({record.printed}) are {nearly}those of {lender.material_name} ({lender.printed}, record "
            f"{lender.name}), and do not suit {record.material_name}."
        )
        yield Doubt(code="M04", kind="borrowed", message=_sentence(text))


def _far_from_supplier(case: Case) -> Iterator[Doubt]:
    record, supplier = case.record, case.record.supplier
    if record.kind == "rubber" and isinstance(case.law, Hooke) and DOUBTS.stiffest_rubber < case.law.E:
        text = f"E = {case.law.E / 1e9:.3g} GPa is impossible for a rubber, which has less than 0.1 GPa."
        yield Doubt(code="M04", kind="no rubber", message=_sentence(text))
    if supplier is None or case.law is None:
        return
    if isinstance(case.law, Hooke):
        here, there, what = case.law.E, supplier.modulus, "Young's modulus is"
    else:
        here, there = _stress_at_2(case.law), supplier.stress_at_stretch_2
        what = "the nominal stress at stretch 2 is"
    if there is not None and not 1 / DOUBTS.far < here / there < DOUBTS.far:
        factor = here / there
        times = f"{factor:.3g} times" if factor > 1 else f"1/{1 / factor:.3g} of"
        text = f"{what} {_kPa(here)}, {times} the {_kPa(there)} that the supplier states."
        yield Doubt(code="M04", kind="far from the supplier", message=_sentence(text))


def _convention(case: Case) -> Iterator[Doubt]:
    """Compare both conventions of Ogden's law.

    Xavier, Fleming and Yong 2021 print Σ μ/α (…) with constants for Abaqus's Σ 2 μ/α² (…).
    """
    record = case.record
    if record.law != "ogden" or not record.quoted_in:
        return
    moduli = ogden_moduli(record.constants)
    here = record.convention
    other = next(name for name in moduli if name != here)
    text = (
        f"read in the convention {here}, the initial shear modulus is {_kPa(moduli[here])}; read in the convention "
        f"{other} it would be {_kPa(moduli[other])}."
    )
    ratio = {name: _poisson_ratio(modulus, record.bulk_modulus) for name, modulus in moduli.items()}
    if moduli[other] <= 0:
        kind, severity = "wrong convention negative", Severity.NOTE
    elif _round(ratio[here]) and not _round(ratio[other]):
        kind, severity = "convention settled", Severity.NOTE
        text += f" D1 gives a Poisson's ratio of {ratio[here]:.2f} in the first, {ratio[other]:.4f} in the second."
    else:
        kind, severity = "convention ambiguous", Severity.WARNING
    message = f"{_sentence(text)} {record.convention_reason}".strip()
    yield Doubt(code="M05", kind=kind, message=message, severity=severity)


def _composite(case: Case) -> Iterator[Doubt]:
    if case.record.convention == "combined":
        text = (
            f"{case.record.printed} stands for a layer of {case.record.material_name.lower()} and rubber together, of "
            "a thickness that the table does not give; it belongs to neither of them."
        )
        yield Doubt(code="M04", kind="combined layer", message=_sentence(text))


def _secant(case: Case) -> Iterator[Doubt]:
    """Linear elastic constants of a rubber are a secant of its curve."""
    record, law = case.record, case.law
    if record.kind != "rubber" or not isinstance(law, Hooke) or DOUBTS.stiffest_rubber <= law.E:
        return
    text = f"E = {_kPa(law.E)} describes a rubber by one straight line"
    for other in case.others:
        rubber = _law(other) if other.material_name == record.material_name else None
        if rubber is None or isinstance(rubber, Hooke):
            continue
        text += f"; the initial modulus of the record {other.name} is {_kPa(3 * rubber.shear_modulus)}"
        strain = _secant_strain(rubber, law.E)
        if strain is not None:
            text += f", and E is the secant of its nominal stress at {strain:.0%} strain"
        break
    assumed = ", ".join(f"{symbol} = {value:g}" for symbol, value in record.assumed.items())
    text += f". {assumed} is not printed but assumed" if assumed else ""
    yield Doubt(code="M07", kind="linear elastic rubber", message=_sentence(f"{text}."))


LOOKS: tuple[Callable[[Case], Iterator[Doubt]], ...] = (
    _negative_modulus,
    _unstable,
    _borrowed,
    _far_from_supplier,
    _convention,
    _composite,
    _secant,
)


def _printed_modulus(record: Record) -> float | None:
    """Initial shear modulus of the printed constants, also where no law can have it."""
    if record.law == "ogden":
        return ogden_moduli(record.constants)[record.convention]
    try:
        law = law_from_printed(record.law, record.convention, {**record.constants, **record.assumed})
    except TurgorError:
        # the modulus is linear in the constants: add a stiffness that makes it positive, and take it off again
        symbol, value = next(iter(record.constants.items()))
        lift = 10 * sum(abs(v) for v in record.constants.values())
        lifted = {**record.constants, **record.assumed, symbol: value + lift}
        try:
            modulus = law_from_printed(record.law, record.convention, lifted).shear_modulus
            again = law_from_printed(record.law, record.convention, {**lifted, symbol: value + 2 * lift}).shear_modulus
        except TurgorError:
            return None
        return 2 * modulus - again
    return law.shear_modulus


def falls_at(law: Law, mode: str, end: float) -> float | None:
    """First stretch between 1 and ``end`` at which the nominal stress stops to rise with the stretch."""
    stretch = np.linspace(1.0, end, 600)
    with np.errstate(invalid="ignore", divide="ignore"):  # beyond a locking stretch there is no stress
        stress = pull(law, mode, stretch)
    fallen = np.flatnonzero(np.diff(stress) * np.sign(end - 1.0) <= 0)
    return float(stretch[fallen[0]]) if fallen.size else None


def _same(one: Record, other: Record) -> bool:
    a, b = _law(one), _law(other)
    if a is None or type(a) is not type(b) or one.law in ("ogden", "generalized_rivlin"):
        return one.law == other.law and one.constants == other.constants
    values = [(getattr(a, item.name), getattr(b, item.name)) for item in fields(a)]  # type: ignore[arg-type]
    return all(abs(x - y) <= DOUBTS.same * max(abs(x), abs(y)) for x, y in values)


def _misfit(record: Record) -> float:
    """How badly the constants suit the name: the logarithm of the ratio to what the supplier states."""
    law = _law(record)
    if law is None or (isinstance(law, Hooke) and record.kind == "rubber" and DOUBTS.stiffest_rubber < law.E):
        return inf
    stated = record.supplier.stress_at_stretch_2 if record.supplier else None
    if isinstance(law, Hooke) or stated is None:
        return 0.0
    here = _stress_at_2(law)
    return abs(log(here / stated)) if here > 0 else inf


def _stress_at_2(law: Law) -> float:
    return float(pull(law, "uniaxial", np.array([2.0]))[0])


def _secant_strain(law: Law, modulus: float) -> float | None:
    """Strain at which stress over strain equals a modulus, in uniaxial tension."""
    strain = np.linspace(0.01, 5.0, 500)
    excess = pull(law, "uniaxial", 1 + strain) / strain - modulus
    for (a, before), (b, after) in pairwise(zip(strain, excess, strict=True)):
        if before > 0 >= after:
            return float(a + (b - a) * before / (before - after))
    return None


def _poisson_ratio(shear: float, bulk: float) -> float:
    return 0.5 if bulk == inf else (3 * bulk - 2 * shear) / (2 * (3 * bulk + shear))


def _round(ratio: float) -> bool:
    """Whether a Poisson's ratio is a number that a person types, such as 0.48."""
    return ratio < 0.5 and abs(ratio - round(ratio, 2)) < 2e-4


def _kPa(value: float) -> str:
    return f"{value / 1e9:.4g} GPa" if abs(value) >= 1e9 else f"{value / 1e3:.4g} kPa"


def _sentence(text: str) -> str:
    return text[0].upper() + text[1:] if text[:2] not in ("E ", "C_") else text
