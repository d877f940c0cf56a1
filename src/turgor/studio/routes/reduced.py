"""Reduced models: a connection over which a page moves one, and sequences of inputs as CSV files."""

import asyncio
import json
from contextlib import suppress
from pathlib import Path
from typing import Any

from starlette.requests import Request
from starlette.routing import WebSocketRoute
from starlette.websockets import WebSocket, WebSocketDisconnect

from turgor.foundation.errors import TurgorError
from turgor.studio.answers import Studio, route, table_of, text_in
from turgor.studio.settings import LIVE, STUDIO


class _Newest:
    """The newest request of a page: while one is answered, all but the last of those that arrive are left out."""

    def __init__(self) -> None:
        self.there = asyncio.Event()
        self.ended = False
        self._request: dict[str, Any] | None = None

    def put(self, text: str) -> None:
        """Take a request in place of one that still waits."""
        try:
            value = json.loads(text) if len(text) <= STUDIO.body_bytes else None
        except (ValueError, RecursionError):
            value = None
        self._request = value if isinstance(value, dict) else {}
        self.there.set()

    async def next(self, wait: float | None = None) -> dict[str, Any] | None:
        """Return the newest request; None after some time [s] without one, or at the end."""
        with suppress(TimeoutError):
            await asyncio.wait_for(self.there.wait(), wait)
        self.there.clear()
        request, self._request = self._request, None
        return request

    def end(self) -> None:
        """The page is gone."""
        self.ended = True
        self.there.set()


async def _live(socket: WebSocket) -> None:
    """Send what the page needs once, then answer each request with a state, until the page goes."""
    studio: Studio = socket.app.state.studio
    await socket.accept()
    newest = _Newest()
    reading = asyncio.create_task(_read(socket, newest))
    try:
        file = studio.workspace.file(socket.path_params["name"])
        table, numbers = await studio.live.do("reduced.described", file)
        await socket.send_json(table)
        await socket.send_bytes(numbers)
        await _answer(studio, file, socket, newest)
    except TurgorError as error:
        with suppress(WebSocketDisconnect, RuntimeError):
            await socket.send_json({"error": error.on_command_line})
            await socket.close()
    except (WebSocketDisconnect, RuntimeError):
        pass  # the page is gone
    finally:
        reading.cancel()


async def _read(socket: WebSocket, newest: _Newest) -> None:
    try:
        while True:
            newest.put(await socket.receive_text())
    except (WebSocketDisconnect, RuntimeError, KeyError):
        newest.end()


async def _answer(studio: Studio, file: Path, socket: WebSocket, newest: _Newest) -> None:
    """Answer requests; where a state stays for some time, all of its measures follow."""
    resting: dict[str, Any] | None = None
    while not newest.ended:
        request = await newest.next(LIVE.rest if resting is not None else None)
        try:
            if request is not None:
                answer = await _state(studio, file, request)
                resting = {"number": answer["number"], "values": answer["inputs"]}
            elif resting is not None:
                rows = await studio.live.do("reduced.read_off", file, resting["values"])
                answer, resting = {"number": resting["number"], "readings": rows}, None
            else:
                continue
        except TurgorError as error:
            answer = {"number": (request or resting or {}).get("number"), "refused": error.on_command_line}
            resting = None
        await socket.send_json(answer)


async def _state(studio: Studio, file: Path, request: dict[str, Any]) -> dict[str, Any]:
    """State at the inputs of a request, or nearest to its wanted place of the tip."""
    inputs, wanted = request.get("inputs"), request.get("wanted")
    if not isinstance(inputs, dict):
        raise TurgorError("the request has no table 'inputs'.")
    if wanted is None:
        answer = await studio.live.do("reduced.at_inputs", file, inputs)
    else:
        free = [str(key) for key in request.get("free") or ()]
        place = wanted if isinstance(wanted, list) else []
        answer = await studio.live.do("reduced.at_tip", file, place, inputs, free, bool(request.get("settle")))
    return {**answer, "number": request.get("number")}


async def _save(studio: Studio, request: Request) -> Any:
    """Write a sequence as a new CSV file."""
    model, given = studio.workspace.file(request.path_params["name"]), await table_of(request)
    file = studio.workspace.new(text_in(given, "name"), ".csv")
    return await studio.live.do("sequences.write_sequence", model, file, given.get("knots"))


async def _load(studio: Studio, request: Request) -> Any:
    """Read a sequence from a CSV file."""
    model = studio.workspace.file(request.path_params["name"])
    return await studio.live.do("sequences.read_sequence", model, studio.workspace.file(request.path_params["table"]))


REDUCED = [
    WebSocketRoute("/ws/live/{name}", _live),
    route("/api/reduced/{name}/sequences", _save, "POST"),
    route("/api/reduced/{name}/sequences/{table}", _load),
]
