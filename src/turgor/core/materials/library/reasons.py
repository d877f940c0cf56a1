"""Why a set of constants is the one to take, and how it compares with the number of the maker."""

import numpy as np

from turgor.core.materials.laws.laws import Hooke
from turgor.core.materials.laws.pull import pull
from turgor.core.materials.library.record import Record
from turgor.core.materials.library.record_files import records
from turgor.core.materials.library.spread import OF_MAKER
from turgor.foundation.errors import TurgorError


def why_taken(record: Record) -> str:
    """Return why a record is the one to take: what its file says, else what stands behind the only set of a material.

    Parameters
    ----------
    record : Record
        One that `turgor.core.materials.library.records.recommended` returns.

    Examples
    --------
    >>> from turgor.core.materials.library.records import find_record
    >>> why_taken(find_record("mold-star-16"))
    'The only set: fitted by turgor to a curve that the library has, for stretches from 1 to 2.5.'
    >>> why_taken(find_record("ecoflex-00-20"))
    'The only set: computed from one number of the maker, for stretches from 1 to 2.'
    """
    if record.recommended:
        return record.recommended
    if len(records(record.library)) > 1:
        return ""
    low, high = record.stretch_range or (0.0, 0.0)
    within = f", for stretches from {low:g} to {high:g}" if record.stretch_range else ""
    check = against_maker(record)
    return f"The only set: {_behind(record)}{within}{f'; {check}' if check else ''}."


def _behind(record: Record) -> str:
    """What stands behind the constants of a record, in a few words."""
    if record.fitted is not None:
        return f"fitted by turgor to {'a curve' if len(record.fitted.names) == 1 else 'curves'} that the library has"
    if _from_maker(record):
        return "computed from one number of the maker"
    return "fitted by turgor to published tests" if "fitted by turgor" in record.source else "as published"


def _from_maker(record: Record) -> bool:
    return record.source.startswith("Computed by turgor from")


def against_maker(record: Record) -> str:
    """Return how far a record lies from the 100 % modulus of the maker, such as ``"14 % below the maker's 152 kPa"``.

    Parameters
    ----------
    record : Record

    Returns
    -------
    str
        Empty where the maker states none, or where the record was computed from it.

    Examples
    --------
    >>> from turgor.core.materials.library.records import find_record
    >>> against_maker(find_record("dragon-skin-20", "yeoh-marechal-2020"))
    "324 kPa at stretch 2, 4 % below the maker's 338 kPa"
    """
    stated = record.supplier.stress_at_stretch_2 if record.supplier else None
    if stated is None or record.kind != "rubber" or _from_maker(record):
        return ""
    try:
        law = record.build_law()
    except TurgorError:
        return ""
    if isinstance(law, Hooke):
        return ""
    stress = float(pull(law, "uniaxial", np.array([OF_MAKER]))[0])
    share = round(100 * (stress / stated - 1))
    side = f"{abs(share)} % {'above' if share > 0 else 'below'}" if share else "equal to"
    return f"{stress / 1e3:.3g} kPa at stretch 2, {side} the maker's {stated / 1e3:.3g} kPa"
