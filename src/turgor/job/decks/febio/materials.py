"""Materials of a .feb file as keywords of a deck."""

from collections.abc import Callable, Mapping
from math import sqrt

from turgor.core.meshing.exchange.formats.abaqus import Keyword
from turgor.foundation.errors import TurgorError
from turgor.job.decks.febio.elements import Element

#: Most terms of an Ogden law and of a Prony series of FEBio.
TERMS = range(1, 7)

#: Type of a material that is no rubber but a rigid body.
RIGID = "rigid body"

Rows = list[Keyword]


def material_rows(material: Element, name: str, *, weighs: bool) -> Rows:
    """Return the keywords of one material.

    Parameters
    ----------
    material : Element
    name : str
        Its name in the deck.
    weighs : bool
        Whether a load needs its density.
    """
    rows = [material.keyword("material", [], {"name": name})]
    try:
        rows += _law(material)
        if weighs:
            rows.append(material.keyword("density", [repr(material.number("density", 1.0))]))
    except TurgorError as error:
        return [material.missing(str(error))]
    return rows


def _law(material: Element) -> Rows:
    kind = material.given.get("type", "")
    if kind not in _LAWS:
        raise TurgorError(f"the law '{kind}' has no form here; these have one: {', '.join(_LAWS)}.")
    if material.first("prestrain", "generation"):
        raise TurgorError("prestrain has no form here.")
    return _LAWS[kind](material)


def _neo_hooke(material: Element) -> Rows:
    E, nu = material.number("E"), material.number("v")
    return [material.keyword("hyperelastic", [f"{E!r}, {nu!r}"], {"neo hooke coupled": ""})]


def _elastic(material: Element) -> Rows:
    return [material.keyword("elastic", [f"{material.number('E')!r}, {material.number('v')!r}"])]


def _incompressible(material: Element) -> Rows:
    return [_form(material, "neo hooke", [material.number("G") / 2])]


def _mooney(material: Element) -> Rows:
    return [_form(material, "mooney-rivlin", [material.number("c1"), material.number("c2", 0.0)])]


def _yeoh(material: Element) -> Rows:
    c = [material.number(f"c{i}", 0.0) for i in TERMS]
    order = max(i for i, value in enumerate(c, start=1) if value or i == 1)
    return [_form(material, "reduced polynomial", c[:order], n=str(order))]


def _ogden(material: Element) -> Rows:
    """W = Σ c/m² (λ̄ᵐ − 3), so that c is twice the μ of a deck."""
    terms = [(material.number(f"c{i}", 0.0), material.number(f"m{i}", 1.0)) for i in TERMS]
    flat = [part for c, m in terms if c for part in (c / 2, m)]
    return [_form(material, "ogden", flat, n=str(len(flat) // 2))]


def _arruda_boyce(material: Element) -> Rows:
    return [_form(material, "arruda-boyce", [material.number("mu"), sqrt(material.number("N"))])]


def _viscoelastic(material: Element) -> Rows:
    """G(t) = g0 + Σ g exp(−t/τ) times the law, which is that of an infinitely slow test where g0 is 1."""
    elastic = material.first("elastic")
    if elastic is None:
        raise TurgorError("it has no <elastic>.")
    slow = material.number("g0", 1.0)
    terms = [(material.number(f"g{i}", 0.0), material.number(f"t{i}", 1.0)) for i in TERMS]
    if slow != 1:
        raise TurgorError(f"g0 is {slow:g}; only a g0 of 1 has a form here.")
    total = 1 + sum(g for g, _ in terms)
    bulk = material.number("k", 0.0)  # it adds to that of the law
    rows = _law(elastic)
    if bulk:
        raise TurgorError("a k besides that of the law has no form here; add it there.")
    series = [f"{g / total!r}, 0., {tau!r}" for g, tau in terms if g]
    return [*rows, material.keyword("viscoelastic", series, {"time": "prony"})]


def _form(material: Element, law: str, constants: list[float], **given: str) -> Keyword:
    """A law with its constants, and D1 of its bulk modulus; the other D are zero."""
    k = material.number("k")
    if not k > 0:
        raise TurgorError(f"k is {k:g}; a positive bulk modulus is needed.")
    order = int(given.get("n", "1"))
    values = [*constants, 2 / k, *[0.0] * (order - 1)]
    return material.keyword("hyperelastic", [", ".join(map(repr, values))], {law: "", **given})


_LAWS: Mapping[str, Callable[[Element], Rows]] = {
    "neo-Hookean": _neo_hooke,
    "isotropic elastic": _elastic,
    "incomp neo-Hookean": _incompressible,
    "Mooney-Rivlin": _mooney,
    "Yeoh": _yeoh,
    "Ogden": _ogden,
    "Arruda-Boyce": _arruda_boyce,
    "uncoupled viscoelastic": _viscoelastic,
}
