"""Materials of a deck as materials of a job."""

from collections.abc import Callable, Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from math import inf
from typing import Any

from turgor.core.inp.materials import POLYNOMIAL
from turgor.core.materials.history.softening import Mullins
from turgor.core.materials.history.viscoelastic import Prony
from turgor.core.materials.laws.laws import (
    ArrudaBoyce,
    CompressibleNeoHooke,
    GeneralizedRivlin,
    Hooke,
    Hyperfoam,
    MooneyRivlin,
    NeoHooke,
    Ogden,
    Yeoh,
    YeohN,
)
from turgor.core.materials.material import Material
from turgor.core.meshing.exchange.formats.abaqus import Keyword
from turgor.core.meshing.exchange.formats.raw import numbers
from turgor.foundation.errors import TurgorError
from turgor.foundation.source import Source
from turgor.job.decks.account import Account
from turgor.job.decks.units import DeckUnits

#: Names of the laws of ``*HYPERELASTIC`` that stand as parameters.
_LAWS = (
    "neo hooke", "neo hooke coupled", "mooney-rivlin", "yeoh", "reduced polynomial", "polynomial", "ogden",
    "arruda-boyce", "van der waals", "marlow", "user", "test data input",
)  # fmt: skip

#: Behavior of a material that has no form here.
REFUSED = (
    "plastic", "hysteresis", "creep", "user material", "cyclic hardening", "fluid constants", "hypoelastic",
    "rate dependent",
)  # fmt: skip

#: What a material may have that no static model of rubber needs.
IDLE = ("conductivity", "specific heat", "depvar")


@dataclass(slots=True)
class _Draft:
    """A material of a deck while its keywords are read."""

    name: str
    keyword: Keyword
    fields: dict[str, Any] = field(default_factory=dict)
    relaxing: tuple[Keyword, list[list[float]]] | None = None
    moduli: str = "long_term"


def materials_of(
    keywords: Iterable[Keyword], units: DeckUnits, account: Account, needed: Collection[str] = ()
) -> dict[str, Material]:
    """Read the materials of a deck.

    Parameters
    ----------
    keywords : iterable of Keyword
        What stands before the steps.
    units : DeckUnits
    account : Account
        Takes what became of each keyword.
    needed : collection of str
        ``expansion``, ``damping``: what loads or motion need of the behavior that others lack.

    Returns
    -------
    dict of str to Material
        By the name in the deck, in lower case; without those that have no law here.
    """
    drafts: list[_Draft] = []
    for keyword in keywords:
        if keyword.name == "material":
            drafts.append(_Draft(keyword.given.get("name", "material"), keyword))
        elif keyword.name in IDLE or (keyword.name in ("expansion", "damping") and keyword.name not in needed):
            account.not_needed(keyword, "no load of the job needs it")
        elif drafts and keyword.name in _PARTS:
            try:
                _PARTS[keyword.name](drafts[-1], keyword, units)
            except (TurgorError, IndexError, ValueError) as error:
                text = str(error) if isinstance(error, TurgorError) else "a line of data is short, or a number is none"
                account.missing(keyword, text)
            else:
                account.taken(keyword, _meaning(drafts[-1], keyword))
    return _finished(drafts, account)


def _finished(drafts: Iterable[_Draft], account: Account) -> dict[str, Material]:
    materials = {}
    for draft in drafts:
        try:
            if draft.relaxing is not None:
                rows = draft.relaxing[1]
                series = Prony(g=tuple(r[0] for r in rows), tau=tuple(r[2] for r in rows), moduli=draft.moduli)
                draft.fields["viscoelasticity"] = series
            if "law" not in draft.fields:
                account.missing(draft.keyword, "it has no law that turgor has")
                continue
            source = Source(text=f"{draft.keyword.path.name}, line {draft.keyword.line}")
            materials[draft.name.lower()] = Material(name=draft.name, source=source, **draft.fields)
        except TurgorError as error:
            account.missing(draft.keyword, str(error))
        else:
            account.taken(draft.keyword, f"material '{draft.name}'")
    return materials


def _values(keyword: Keyword) -> list[float]:
    """All numbers of a keyword with one row of constants, which may go on over several lines."""
    return [value for line in keyword.lines for value in numbers(line, keyword.path, f"*{keyword.name.upper()}")]


def _constant(keyword: Keyword, count: int) -> list[float]:
    """The constants, which must be the same in the rows of all temperatures."""
    rows = [numbers(line, keyword.path, f"*{keyword.name.upper()}")[:count] for line in keyword.lines]
    if any(row != rows[0] for row in rows):
        raise TurgorError("constants that depend on temperature have no form here; give one line.")
    return list(rows[0])


def _elastic(draft: _Draft, keyword: Keyword, units: DeckUnits) -> None:
    kind = keyword.given.get("type", "iso").lower()
    if kind not in ("iso", "isotropic"):
        raise TurgorError(f"linear elasticity of the type {kind.upper()} has no form here; only the isotropic one has.")
    values = _constant(keyword, 2)
    draft.fields["law"] = Hooke(E=values[0] * units.stress, nu=values[1])


def _hyperelastic(draft: _Draft, keyword: Keyword, units: DeckUnits) -> None:
    law = next((name for name in _LAWS if name in keyword.given), "polynomial")
    order = int(keyword.given.get("n", "1") or 1)
    if law not in _FORMS:
        raise TurgorError(f"the law {law.upper()} has no form here; these have one: {', '.join(_FORMS).upper()}.")
    needed, make = _FORMS[law]
    count = needed(order)
    values = _values(keyword)
    temperature = 1 if len(values) > count + _compressions(law, order) else 0
    if len(values) > count + _compressions(law, order) + temperature:
        raise TurgorError("constants that depend on temperature have no form here; give one row.")
    values += [0.0] * (count - len(values))
    draft.fields["law"] = make(values[:count], units.stress)
    if law == "neo hooke coupled":  # of FEBio; its energy has the change of volume
        return
    draft.fields["bulk_modulus"] = _bulk(values[count : count + _compressions(law, order)], units)
    draft.moduli = keyword.given.get("moduli", "long term").lower().replace(" ", "_")


def _bulk(compressions: Sequence[float], units: DeckUnits) -> float:
    """κ = 2/D1; D2 and D3 have no form, and 0 means that the volume stays."""
    first, *others = [*compressions, 0.0]
    if any(others):
        raise TurgorError("D2 and D3 have no form here; the bulk modulus is constant, κ = 2/D1.")
    return 2 / first * units.stress if first else inf


def _compressions(law: str, order: int) -> int:
    return {"yeoh": 3, "neo hooke": 1, "neo hooke coupled": 0, "mooney-rivlin": 1, "arruda-boyce": 1}.get(law, order)


def _hyperfoam(draft: _Draft, keyword: Keyword, units: DeckUnits) -> None:
    order = int(keyword.given.get("n", "1") or 1)
    values = _values(keyword)
    if not 3 * order <= len(values) <= 3 * order + 1:
        raise TurgorError(f"{3 * order} constants and no second row for another temperature are needed.")
    mu, alpha, nu = values[0 : 2 * order : 2], values[1 : 2 * order : 2], values[2 * order : 3 * order]
    draft.fields["law"] = Hyperfoam.from_abaqus(mu=[m * units.stress for m in mu], alpha=alpha, nu=nu)


def _viscoelastic(draft: _Draft, keyword: Keyword, units: DeckUnits) -> None:
    if keyword.given.get("time", "").lower() != "prony":
        raise TurgorError("only TIME=PRONY has a form here.")
    rows = [[*numbers(line, keyword.path, "a Prony term"), 0.0, 0.0][:3] for line in keyword.lines]
    if any(row[1] for row in rows):
        raise TurgorError("a bulk modulus that relaxes has no form here; the second column must be 0.")
    draft.relaxing = keyword, rows


def _mullins(draft: _Draft, keyword: Keyword, units: DeckUnits) -> None:
    r, m, *beta = _values(keyword)
    draft.fields["stress_softening"] = Mullins(r=r, m=m * units.stress, beta=beta[0] if beta else 0.0)


def _density(draft: _Draft, keyword: Keyword, units: DeckUnits) -> None:
    draft.fields["density"] = _values(keyword)[0] * units.density


def _expansion(draft: _Draft, keyword: Keyword, units: DeckUnits) -> None:
    kind = keyword.given.get("type", "iso").lower()
    if kind not in ("iso", "isotropic"):
        raise TurgorError(f"expansion of the type {kind.upper()} has no form here; only the isotropic one has.")
    draft.fields["expansion"] = _constant(keyword, 1)[0]


def _refused(draft: _Draft, keyword: Keyword, units: DeckUnits) -> None:
    raise TurgorError("this behavior of a material has no form here.")


def _meaning(draft: _Draft, keyword: Keyword) -> str:
    law = draft.fields.get("law")
    if keyword.name == "elastic":
        return "Hooke on sheets and threads; in bodies the neo-Hookean law of the same moduli, alike at small strains"
    if keyword.name in ("hyperelastic", "hyperfoam"):
        volume = ", the volume stays" if draft.fields.get("bulk_modulus") == inf else ""
        return f"{type(law).__name__}{volume}"
    return _MEANINGS[keyword.name]


def _scaled(values: Iterable[float], stress: float) -> list[float]:
    return [value * stress for value in values]


def _rivlin(values: Sequence[float], stress: float) -> GeneralizedRivlin:
    terms = zip(POLYNOMIAL, _scaled(values, stress), strict=False)
    return GeneralizedRivlin(coefficients=tuple((i, j, C) for (i, j), C in terms if C))


def _ogden(values: Sequence[float], stress: float) -> Ogden:
    return Ogden.from_abaqus(mu=_scaled(values[0::2], stress), alpha=values[1::2])


def _coupled(values: Sequence[float], stress: float) -> CompressibleNeoHooke:
    """From Young's modulus and Poisson's ratio."""
    return CompressibleNeoHooke(mu=values[0] * stress / (2 * (1 + values[1])), nu=values[1])


def _yeoh(values: Sequence[float], stress: float) -> Yeoh:
    first, second, third = _scaled(values, stress)
    return Yeoh(C10=first, C20=second, C30=third)


#: Laws by their name in a deck: how many constants they have by the order N, and what makes them.
_FORMS: dict[str, tuple[Callable[[int], int], Callable[[Sequence[float], float], Any]]] = {
    "neo hooke": (lambda order: 1, lambda v, unit: NeoHooke(C10=v[0] * unit)),
    "neo hooke coupled": (lambda order: 2, _coupled),
    "mooney-rivlin": (lambda order: 2, lambda v, unit: MooneyRivlin(C10=v[0] * unit, C01=v[1] * unit)),
    "yeoh": (lambda order: 3, _yeoh),
    "reduced polynomial": (lambda order: order, lambda v, unit: YeohN(coefficients=tuple(_scaled(v, unit)))),
    "polynomial": (lambda order: order * (order + 3) // 2, _rivlin),
    "ogden": (lambda order: 2 * order, _ogden),
    "arruda-boyce": (lambda order: 2, lambda v, unit: ArrudaBoyce(mu=v[0] * unit, locking_stretch=v[1])),
}

_MEANINGS = {
    "density": "density", "viscoelastic": "viscoelasticity", "mullins effect": "stress_softening",
    "expansion": "thermal expansion; only differences of temperature count",
}  # fmt: skip

_PARTS: Mapping[str, Callable[[_Draft, Keyword, DeckUnits], None]] = {
    **dict.fromkeys(REFUSED, _refused),
    "elastic": _elastic,
    "hyperelastic": _hyperelastic,
    "hyperfoam": _hyperfoam,
    "viscoelastic": _viscoelastic,
    "mullins effect": _mullins,
    "density": _density,
    "expansion": _expansion,
}
