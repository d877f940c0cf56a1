"""Saving fits: a file of records in the form of the library, which a job or a script can name."""

from collections.abc import Sequence
from pathlib import Path

import tomlkit

from turgor.errors import TurgorError
from turgor.materials.conventions import law_from_printed
from turgor.materials.fit_result import Fit
from turgor.units import format_quantity

#: How files write a law: its name there and the convention that says what its symbols mean.
_FORMS = {
    "neo-hooke": ("neo_hooke", "two_index"),
    "mooney-rivlin": ("mooney_rivlin", "two_index"),
    "yeoh": ("yeoh", "two_index"),
    "yeoh-2": ("yeoh", "two_index"),
    "gent": ("gent", "canonical"),
    "arruda-boyce": ("arruda_boyce", "canonical"),
}


def can_be_saved(fit: Fit) -> bool:
    """Whether files of records have a form for the law of a fit.

    Parameters
    ----------
    fit : Fit
        The fit.
    """
    law, convention = _form(fit)
    try:
        law_from_printed(law, convention, _printed(fit))
    except (TurgorError, TypeError):
        return False
    return True


def records_toml(name: str, fits: Sequence[Fit]) -> str:
    """Write fits as the text of a file of records, which reads back to exactly the same laws.

    Parameters
    ----------
    name : str
        What the material is called.
    fits : sequence of Fit
        One or more, each of another law.
    """
    document = tomlkit.document()
    document.add(tomlkit.comment("Fitted by turgor; moduli with their units, exponents without."))
    document["name"] = name
    document["kind"] = "rubber"
    records = tomlkit.table(is_super_table=True)
    for fit in fits:
        records[fit.spec.name] = _record(fit)
    document["records"] = records
    return tomlkit.dumps(document)


def save_fits(path: str | Path, name: str, fits: Sequence[Fit]) -> None:
    """Write fits into a file of records; ``from_library`` with its path and a record's name reads one.

    Parameters
    ----------
    path : str or Path
        A file ending in ``.toml``.
    name : str
        What the material is called.
    fits : sequence of Fit
        One or more, each of another law.
    """
    if Path(path).suffix != ".toml":
        raise TurgorError(f"'{path}' does not end in .toml, the form in which materials are saved.")
    Path(path).write_text(records_toml(name, fits), encoding="utf-8")


def _record(fit: Fit) -> tomlkit.items.Table:
    law, convention = _form(fit)
    if not can_be_saved(fit):
        raise TurgorError(f"files of records have no form for the law {fit.spec.name}; use its material directly.")
    entry = tomlkit.table()
    entry["law"] = law
    parameters = tomlkit.inline_table()
    for key, (symbol, value) in zip(fit.values, _printed(fit).items(), strict=True):
        parameters[symbol] = value if key in fit.spec.shapes else format_quantity(value, "kPa")
    entry["parameters"] = parameters
    entry["convention"] = convention
    entry["stretch_range"] = [round(edge, 6) for edge in fit.stretch_range]
    source = fit.material.source
    entry["source"] = str(source)
    if source.doubts:
        entry["doubts"] = list(source.doubts)
    return entry


def _printed(fit: Fit) -> dict[str, float]:
    """Parameters by their symbols in files."""
    if not fit.spec.name.startswith("ogden"):
        return dict(fit.values)
    return {f"{key[:-1]}_{key[-1]}": value for key, value in fit.values.items()}


def _form(fit: Fit) -> tuple[str, str]:
    kind = fit.spec.name.partition("-")[0]
    if kind == "ogden":
        return "ogden", "mu/alpha"
    return _FORMS.get(fit.spec.name, ("generalized_rivlin", "two_index"))
