"""Answers: JSON to the page, errors as sentences, and bodies of requests within their limits."""

import json
from collections.abc import Awaitable, Callable
from dataclasses import dataclass
from typing import Any

from starlette.requests import Request
from starlette.responses import JSONResponse, Response
from starlette.routing import Route

from turgor.foundation.errors import TurgorError
from turgor.studio.checking import Checking
from turgor.studio.children.children import Children
from turgor.studio.history import Conflict
from turgor.studio.settings import STUDIO
from turgor.studio.worker import Worker
from turgor.studio.workspace import Workspace

#: Status of an answer: wrong input, a file that another program has changed, a body that is too large.
WRONG, CHANGED, LARGE = 400, 409, 413


@dataclass(frozen=True, slots=True, kw_only=True)
class Studio:
    """What all routes share.

    Parameters
    ----------
    workspace : Workspace
    worker : Worker
        For what a person waits for: shapes, checks, scenes.
    slow : Worker
        For what takes longer: fits, uploads.
    live : Worker
        For reduced models, whose answers must not wait for others.
    checking : Checking
        For checks of jobs, which newer ones replace.
    """

    workspace: Workspace
    worker: Worker
    slow: Worker
    live: Worker
    checking: Checking

    @property
    def workers(self) -> tuple[Worker, ...]:
        """All of them."""
        return self.worker, self.slow, self.live, self.checking.worker

    @property
    def children(self) -> Children:
        """The processes of runs and studies."""
        return Children(self.workspace)


Answer = Callable[[Studio, Request], Awaitable[Any]]


def route(path: str, answer: Answer, method: str = "GET") -> Route:
    """Return a route whose function returns a value for JSON or a response; its errors become sentences.

    Parameters
    ----------
    path : str
    answer : coroutine function
        ``answer(studio, request)``.
    method : str
    """

    async def endpoint(request: Request) -> Response:
        try:
            value = await answer(request.app.state.studio, request)
        except Conflict as error:
            return JSONResponse({"error": str(error)}, status_code=CHANGED)
        except TooLarge as error:
            return JSONResponse({"error": str(error)}, status_code=LARGE)
        except TurgorError as error:
            return JSONResponse({"error": error.on_command_line}, status_code=WRONG)
        return value if isinstance(value, Response) else JSONResponse(value)

    return Route(path, endpoint, methods=[method])


class TooLarge(TurgorError):
    """A request with more bytes than allowed."""


async def table_of(request: Request) -> dict[str, Any]:
    """Return the JSON table that a request holds."""
    try:
        value = json.loads(await body_of(request, STUDIO.body_bytes))
    except (ValueError, RecursionError) as error:
        raise TurgorError("the request holds no JSON.") from error
    if not isinstance(value, dict):
        raise TurgorError("the request holds no table.")
    return value


async def body_of(request: Request, most: int) -> bytes:
    """Return the body of a request; raise `TooLarge` beyond a number of bytes, without reading the rest."""
    body = bytearray()
    async for part in request.stream():
        body += part
        if len(body) > most:
            raise TooLarge(f"the file has more than {most / 1e6:.0f} MB, which is the most that is read.")
    return bytes(body)


def text_in(values: dict[str, Any], key: str) -> str:
    """Return a text of a request by its key."""
    value = values.get(key)
    if not isinstance(value, str):
        raise TurgorError(f"the request has no text '{key}'.")
    return value
