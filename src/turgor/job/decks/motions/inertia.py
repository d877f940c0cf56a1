"""Steps of a deck with inertia: the keys of the procedure ``dynamic``."""

from typing import Any

from turgor.foundation.errors import TurgorError
from turgor.job.decks.account import Account
from turgor.job.decks.steps import Path
from turgor.units import format_quantity


def damping_of(path: Path, account: Account) -> dict[str, Any]:
    """Return the key of damping in proportion to the mass, which a job has for all materials alike.

    Parameters
    ----------
    path : Path
        What the deck prescribes.
    account : Account
        Takes what became of each ``*DAMPING``.
    """
    keywords = [each for each in path.deck.model if each.name == "damping"]
    if not path.moves or not keywords:
        return {}
    materials = sum(each.name == "material" for each in path.deck.model)
    try:
        stated = [{key: float(value) for key, value in each.given.items() if float(value)} for each in keywords]
        if strange := {key for each in stated for key in each} - {"alpha"}:
            raise TurgorError(
                f"{', '.join(sorted(strange)).upper()} has no form here; ALPHA has one. The stiffness_damping of a job "
                "resists change of shape alone, BETA also that of volume."
            )
        if any(each != stated[0] for each in stated) or len(keywords) != materials:
            raise TurgorError("materials with different damping have no form here; a job has one for all.")
    except (TurgorError, ValueError) as error:
        account.missing(keywords[0], str(error) if isinstance(error, TurgorError) else "its damping is no number.")
        return {}
    for each in keywords:
        account.taken(each, "mass_damping of the procedure")
    return {"mass_damping": format_quantity(stated[0]["alpha"], "1/s")} if stated[0] else {}
