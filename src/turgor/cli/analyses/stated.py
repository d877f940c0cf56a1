"""Options of ``turgor calibrate`` and ``turgor uncertainty`` as the tables of a study file, which one reader reads."""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from turgor.studies.study_file.study_file import StudyFile

Texts = Sequence[str] | None


def stated_study(
    file: Path, kind: str, factors: Mapping[str, Any], table: Mapping[str, Any], options: Mapping[tuple[str, ...], str],
    changes: Texts,
) -> "tuple[StudyFile, str]":  # fmt: skip
    """Read a study file, or make one of a job file and options.

    Parameters
    ----------
    file : Path
        A study file, which states a job, or a job file.
    kind : str
        ``"calibrate"`` or ``"uncertainty"``.
    factors, table : mapping
        What options state, in the form of a study file.
    options : mapping of tuple of str to str
        The options that state their keys.
    changes : sequence of str or None
        What ``--set`` states.

    Returns
    -------
    (StudyFile, str)
        And the name that the folder of results begins with.
    """
    from turgor.foundation.errors import TurgorError
    from turgor.job.text.overrides import parse_changes
    from turgor.job.text.problems import Problems
    from turgor.studies.study_file.study_file import read_study_file, study_of

    given = parse_changes(changes or ())
    if names_a_job(file):
        if factors or table:
            option = next(iter(options.values()))
            raise TurgorError(f"{option} goes with a job file; the study file '{file}' states it in its tables.")
        study = read_study_file(file, given, kind)
        return study, study.name
    content = {"job": str(file), "factors": factors, kind: table}
    study = study_of(content, Path("options"), Problems(str(file), options), given, kind)
    return study, study.job.name


def names_a_job(file: Path) -> bool:
    """Return whether a file is a study file: it names a job, which job files do not."""
    from turgor.foundation.errors import TurgorError
    from turgor.foundation.toml_text import read_text, read_toml

    try:
        return isinstance(read_toml(read_text(file), str(file)).get("job"), str)
    except (OSError, TurgorError):  # the reader of jobs says what is wrong
        return False


def free_factors(free: Texts, priors: Texts) -> dict[str, Any]:
    """Return the factors that ``--free`` and ``--prior`` state.

    Parameters
    ----------
    free : sequence of str or None
        ``KEY``, ``KEY=START``, ``KEY:LOWER:UPPER`` or ``KEY=START:LOWER:UPPER``.
    priors : sequence of str or None
        ``KEY=MEAN+-DEVIATION``; the deviation may be in percent.

    Returns
    -------
    dict of str to dict

    Examples
    --------
    >>> free_factors(["wall=1 mm:0.5 mm:2 mm"], ["wall=1.1 mm +- 5 %"])
    {'wall': {'start': '1 mm', 'low': '0.5 mm', 'high': '2 mm', 'prior': '1.1 mm +- 5 %'}}
    """
    from turgor.foundation.errors import TurgorError, unknown

    factors: dict[str, Any] = {}
    for text in free or ():
        before, sign, after = text.partition("=")
        first, *limits = [part.strip() for part in (after if sign else before).split(":")]
        if len(limits) not in (0, 2):
            raise TurgorError(f"--free is '{text}'; write KEY, KEY=START, or KEY=START:LOWER:UPPER.")
        table = {"start": first} if sign else {}
        factors[_name(before if sign else first)] = table | dict(zip(("low", "high"), limits, strict=False))
    for text in priors or ():
        keys, sign, value = (part.strip() for part in text.partition("="))
        if not sign:
            raise TurgorError(
                f"--prior is '{text}'; write KEY=MEAN+-DEVIATION, such as materials.body.C10='0.1 MPa +- 5 %'."
            )
        if _name(keys) not in factors:
            raise unknown("parameter with a prior", _name(keys), factors)
        factors[_name(keys)]["prior"] = value
    return factors


def spread_factors(spreads: Texts) -> dict[str, Any]:
    """Return the factors that ``--spread`` states, such as ``"actuator.wall=0.1 mm as wall"``.

    Parameters
    ----------
    spreads : sequence of str or None
        ``KEY=DEVIATION`` or ``KEY=MEAN+-DEVIATION``, or replicates with semicolons between them; then ``as LABEL``.

    Returns
    -------
    dict of str to dict

    Examples
    --------
    >>> spread_factors(["actuator.wall=0.1 mm as wall"])
    {'actuator.wall': {'spread': '0.1 mm', 'label': 'wall'}}
    """
    from turgor.foundation.errors import TurgorError

    factors: dict[str, Any] = {}
    for text in spreads or ():
        keys, sign, value = (part.strip() for part in text.partition("="))
        if not (sign and keys and value):
            raise TurgorError(f"--spread is '{text}'; write KEY=DEVIATION, such as actuator.wall='0.1 mm'.")
        if _name(keys) in factors:
            raise TurgorError(f"'{keys}' has two spreads; give it one.")
        value, _, label = (part.strip() for part in value.partition(" as "))
        factors[_name(keys)] = {"spread": value, "label": label}
    return factors


def files_by_label(sets: Texts) -> dict[str, str]:
    """Return the tables of constants that ``--sets`` states, such as ``"rubber=specimens.csv"``."""
    from turgor.foundation.errors import TurgorError

    files: dict[str, str] = {}
    for text in sets or ():
        label, sign, file = (part.strip() for part in text.partition("="))
        if not (sign and label and file):
            raise TurgorError(f"--sets is '{text}'; write LABEL=FILE, such as rubber=specimens.csv.")
        files[label] = file
    return files


def labels_of_records(records: Texts) -> dict[str, str]:
    """Return the labels of materials that ``--records`` states, such as ``"materials.body as rubber"``."""
    from turgor.foundation.errors import TurgorError

    labels: dict[str, str] = {}
    for text in records or ():
        keys, _, label = (part.strip() for part in text.partition(" as "))
        if _name(keys) in labels:
            raise TurgorError(f"'{keys}' has two spreads; give it one.")
        labels[_name(keys)] = label
    return labels


def _name(keys: str) -> str:
    return ",".join(part.strip() for part in keys.split(","))
