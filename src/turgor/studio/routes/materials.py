"""Materials: the library, tests of a user, fits, and the entry that a choice becomes in the job."""

from typing import Any

from starlette.requests import Request

from turgor.foundation.errors import TurgorError
from turgor.studio.answers import Studio, route, table_of, text_in
from turgor.studio.routes.jobs import history_of
from turgor.studio.settings import FITTING


async def _library(studio: Studio, request: Request) -> Any:
    return await studio.worker.do("materials.library_table")


async def _curves(studio: Studio, request: Request) -> Any:
    """Curves of records: ``records`` as pairs, ``mode``, largest stretch ``most``."""
    given = await table_of(request)
    chosen = given.get("records")
    pairs = [each for each in chosen if _is_pair(each)] if isinstance(chosen, list) else []
    return await studio.worker.do("materials.curves", pairs, text_in(given, "mode"), _number(given, "most"))


async def _read(studio: Studio, request: Request) -> Any:
    """A table of the folder as tests: ``file``, and how it is read where it does not say."""
    given = await table_of(request)
    return await studio.slow.do("materials.read_own", studio.workspace.file(text_in(given, "file")), _how(given))


async def _fit(studio: Studio, request: Request) -> Any:
    """Laws fitted to tables of the folder: ``files``, ``laws``, ``range`` or null, and how they are read."""
    given = await table_of(request)
    files, laws, ends = given.get("files"), given.get("laws"), given.get("range")
    if not isinstance(files, list) or not files:
        raise TurgorError("no test was chosen; mark one of the tables.")
    if not isinstance(laws, list) or not 1 <= len(laws) <= FITTING.laws:
        raise TurgorError(f"choose one to {FITTING.laws} laws.")
    if ends is not None:
        ends = [_number({"range": each}, "range") for each in (ends if isinstance(ends, list) else [])]
        if len(ends) != 2 or not 0 < ends[0] < ends[1]:
            raise TurgorError("the range is two stretches, the smaller one first.")
    paths = [studio.workspace.file(str(name)) for name in files]
    return await studio.slow.do("materials.fitted", paths, _how(given), ends, [str(law) for law in laws])


async def _regions(studio: Studio, request: Request) -> Any:
    text = history_of(studio, request.path_params["name"]).text
    return await studio.worker.do("materials.regions", text)


async def _entry(studio: Studio, request: Request) -> Any:
    """The entry of a region with the material that was chosen."""
    given = await table_of(request)
    choice = given.get("choice")
    if not isinstance(choice, dict):
        raise TurgorError("the request has no table 'choice'.")
    text = history_of(studio, request.path_params["name"]).text
    return await studio.worker.do("materials.entry_for", text, text_in(given, "region"), choice)


def _how(given: dict[str, Any]) -> dict[str, str]:
    return {key: text_in(given, key) for key in ("mode", "stress", "specimen", "cycle")}


def _is_pair(value: Any) -> bool:
    return isinstance(value, list) and len(value) == 2 and all(isinstance(each, str) for each in value)


def _number(given: dict[str, Any], key: str) -> float:
    value = given.get(key)
    if isinstance(value, bool) or not isinstance(value, int | float):
        raise TurgorError(f"the request has no number '{key}'.")
    return float(value)


MATERIALS = [
    route("/api/materials", _library),
    route("/api/materials/curves", _curves, "POST"),
    route("/api/materials/tests", _read, "POST"),
    route("/api/materials/fits", _fit, "POST"),
    route("/api/jobs/{name}/materials", _regions),
    route("/api/jobs/{name}/materials", _entry, "POST"),
]
