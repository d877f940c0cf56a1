"""Texts of the options of ``turgor fit``, read before any file is."""

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from turgor.cli.options import option_quantity
from turgor.foundation.errors import TurgorError

if TYPE_CHECKING:
    from turgor.core.materials.experiments.specimen import Specimen

#: Directions that specimens are cut along; a test compares them with those of `fit_directions`.
CUTS = ("along", "across", "through")

#: Directions of the strips of a woven fabric; a test compares them with those of `fit_woven`.
STRIPS = ("warp", "weft", "bias")

#: What `--zero` estimates.
AUTO = "auto"

#: Column of a run that says which stretch its rubber sees.
STRETCH = "principal_stretch_p99"


def working_range(within: str, seen: str) -> tuple[float, float] | None:
    """Return the stretches of ``--range`` or ``--for``; None where neither is stated.

    Parameters
    ----------
    within : str
        ``LOW:HIGH``.
    seen : str
        ``stretch LOW:HIGH``, or the folder of a run.

    Examples
    --------
    >>> working_range("1:4", ""), working_range("", "stretch 1:2.5"), working_range("", "")
    ((1.0, 4.0), (1.0, 2.5), None)
    """
    if within and seen:
        raise TurgorError("--range and --for both state stretches; give one of them.")
    if within:
        return _ends("--range", within)
    if not seen:
        return None
    text = seen.strip().removeprefix("stretch").strip(" =")
    return _of_run(Path(seen)) if Path(seen).exists() else _ends("--for", text, seen)


def _ends(option: str, text: str, whole: str = "") -> tuple[float, float]:
    try:
        low, high = (float(part) for part in text.split(":"))
    except ValueError:
        example = "1:4" if option == "--range" else "stretch 1:2.5, or name the folder of a run"
        raise TurgorError(
            f"{option} is '{whole or text}'; write smallest and largest stretch, for example {example}."
        ) from None
    if not 0 < low < high:
        raise TurgorError(f"{option} is '{whole or text}'; the smaller stretch comes first, and both are above 0.")
    return low, high


def _of_run(run: Path) -> tuple[float, float]:
    """Stretches that the rubber of a run sees."""
    from turgor.core.results.files.response_csv import read_response
    from turgor.foundation.errors import unknown
    from turgor.job.output.folder import RESPONSE

    file = run / RESPONSE if run.is_dir() else run
    if not file.is_file():
        raise TurgorError(f"--for: '{run}' holds no {RESPONSE}, so it is no folder of a run; run the job first.")
    response = read_response(file)
    if STRETCH not in response:
        raise unknown(f"column of {file}", STRETCH, response.names)
    high = float(response.column(STRETCH).max())
    if not high > 1:
        raise TurgorError(f"--for: the largest {STRETCH} of {file} is {high:g}; nothing is stretched there.")
    return 1.0, high


def modes_of(text: str, count: int) -> list[str | None]:
    """Return the mode of each file.

    Examples
    --------
    >>> modes_of("uniaxial", 2), modes_of("", 1)
    (['uniaxial', 'uniaxial'], [None])
    """
    given: list[str | None] = [part.strip() or None for part in text.split(",")]
    if len(given) == 1:
        return given * count
    if len(given) != count:
        raise TurgorError(f"--mode names {len(given)} modes for {count} files; give one, or one for each file.")
    return given


def specimens_of(text: str, count: int) -> "list[Specimen | None]":
    """Return the dimensions of the specimen of each file, which ``--specimen`` separates by semicolons."""
    parts = [part.strip() for part in text.split(";")]
    if len(parts) == 1:
        return [_specimen(text)] * count
    if len(parts) != count:
        raise TurgorError(
            f"--specimen states {len(parts)} specimens for {count} files; give one, or one for each file."
        )
    return [_specimen(part) for part in parts]


def _specimen(text: str) -> "Specimen | None":
    from turgor.core.materials.experiments.specimen import Specimen

    if not text:
        return None
    sizes = [option_quantity("--specimen", part, "length") for part in text.split(",")]
    if len(sizes) != 3:
        raise TurgorError(
            f"--specimen is '{text}'; write length, width and thickness, for example '33 mm, 6 mm, 3 mm'."
        )
    return Specimen(length=sizes[0], width=sizes[1], thickness=sizes[2])


def preload_of(text: str) -> float | None:
    """Return the stress of ``--preload`` [Pa]."""
    return option_quantity("--preload", text, "pressure") if text else None


def zero_of(text: str) -> float | str | None:
    """Return the stretch of ``--zero``, or that it is to be estimated.

    Examples
    --------
    >>> zero_of("auto"), zero_of("1.034"), zero_of("")
    ('auto', 1.034, None)
    """
    if text in ("", AUTO):
        return text or None
    try:
        return float(text)
    except ValueError:
        raise TurgorError(
            f"--zero is '{text}'; write auto, or the stretch at which the stress is zero, such as 1.034."
        ) from None


def names_cuts(text: str) -> bool:
    """Return whether ``--directions`` names the direction of each file, and no column.

    Examples
    --------
    >>> names_cuts("along,across"), names_cuts("warp,weft,bias"), names_cuts("print direction"), names_cuts("")
    (True, True, False, False)
    """
    return bool(text) and all(cut in (*CUTS, *STRIPS) for cut in cuts_of(text))


def cuts_of(text: str) -> list[str]:
    """Return the directions that ``--directions`` names, in the order of the files.

    Examples
    --------
    >>> cuts_of("along, across")
    ['along', 'across']
    """
    return [part.strip().lower() for part in text.split(",")]


def fixed_of(text: str) -> dict[str, float]:
    """Return the known parameters of ``--fixed``, in SI units.

    Examples
    --------
    >>> fixed_of("a3=0, C20=1 kPa, kappa=0.1, angle=30 deg")
    {'a3': 0.0, 'C20': 1000.0, 'kappa': 0.1, 'angle': 0.5235987755982988}
    """
    from turgor.core.materials.laws.conventions import has_no_unit
    from turgor.units import parse_quantity

    fixed: dict[str, float] = {}
    for part in filter(None, map(str.strip, text.split(","))):
        name, equals, value = (each.strip() for each in part.partition("="))
        if not equals:
            raise TurgorError(f"--fixed is '{text}'; write names and values, for example 'a3=0 kPa, C30=0 kPa'.")
        plain = has_no_unit(name) or value == "0"
        try:
            fixed[name] = float(value) if plain else parse_quantity(value, "angle" if name == "angle" else "pressure")
        except ValueError as error:
            raise TurgorError(f"--fixed: {name} is '{value}'; {error}") from None
    return fixed


def common_name(files: Sequence[Path]) -> str:
    """Return the name of the only file, or of the folder that all share."""
    folder = files[0].resolve().parent.name
    return files[0].stem if len(files) == 1 else folder or "fit"
