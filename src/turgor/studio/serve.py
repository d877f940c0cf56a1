"""Serve: bind an address, print it, open the browser, and serve until Ctrl-C."""

import hashlib
import json
import os
import secrets
import socket
import webbrowser
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from pathlib import Path

import uvicorn
from filelock import FileLock, Timeout

from turgor.foundation.errors import TurgorError
from turgor.foundation.store.atomic_files import write_whole
from turgor.foundation.store.caches import caches, private
from turgor.studio.answers import Studio
from turgor.studio.app import studio_app
from turgor.studio.checking import Checking
from turgor.studio.guard import Access, access_to, in_address
from turgor.studio.settings import STUDIO
from turgor.studio.worker import Worker
from turgor.studio.workspace import Workspace, read_json

#: Addresses that only this machine can reach.
LOOPBACK = ("127.0.0.1", "localhost", "::1")


@dataclass(frozen=True, slots=True, kw_only=True)
class Address:
    """Where the studio is served.

    Parameters
    ----------
    host : str
    port : int
        0 for any free one.
    names : tuple of str
        Further names under which browsers reach it.
    """

    host: str = LOOPBACK[0]
    port: int = STUDIO.port
    names: tuple[str, ...] = ()


def serve(
    folder: Path, say: Callable[[str], None], address: Address = Address(), *, start: str = "", browser: bool = True
) -> None:
    """Serve the studio of a folder until it is interrupted.

    A server that was killed and starts again takes its token and port up again, so that an open page continues.

    Parameters
    ----------
    folder : Path
    say : callable
        Called with the sentences for the terminal.
    address : Address
    start : str
        Where the page begins, such as ``"#/live/finger.reduced"``.
    browser : bool
        Whether a browser is opened.

    Raises
    ------
    TurgorError
        If the folder does not exist, or no port can be bound.
    """
    if not folder.is_dir():
        raise TurgorError(f"there is no folder '{folder}'; name one with job files, or make it.")
    workspace = Workspace(folder.resolve())
    session = _session(workspace.folder)
    lock = FileLock(f"{session}.lock", timeout=0)
    try:
        lock.acquire()
    except Timeout:
        where = f"{read_json(session).get('where')}{start}"
        say(f"The studio of this folder runs already: {where}")
        _open(where, browser)
        return
    with lock:
        known = read_json(session)
        bound = _bound(address, int(str(known.get("port") or 0)))
        port = int(bound.getsockname()[1])
        access = access_to(address.host, port, str(known.get("token") or secrets.token_urlsafe(32)), address.names)
        where = f"http://{in_address(address.host)}:{port}/?token={access.token}"
        write_whole(session, json.dumps({"port": port, "token": access.token, "where": where}))
        session.chmod(0o600)
        where += start
        for sentence in _sentences(address, access, where):
            say(sentence)
        studio = Studio(workspace=workspace, worker=Worker(), slow=Worker(), live=Worker(), checking=Checking(Worker()))
        config = uvicorn.Config(
            studio_app(studio, access), log_level="warning", access_log=False, ws="websockets-sansio", lifespan="on"
        )
        _open(where, browser)
        uvicorn.Server(config).run(sockets=[bound])


def _sentences(address: Address, access: Access, where: str) -> Iterable[str]:
    yield f"turgor studio: {where}"
    if address.host not in LOOPBACK:
        yield (
            f"Warning: bound to {address.host or 'all addresses'}, so other machines can reach it, without encryption. "
            "Whoever has the address above, or reads it on the way, can run jobs as you. Bind to 127.0.0.1 and use a "
            f"tunnel of SSH instead, if you can. It answers to {', '.join(sorted(access.hosts))}; name others with "
            "--allow-host."
        )
    yield "Stop it with Ctrl-C; runs that it has started continue."


def _session(folder: Path) -> Path:
    """File of the token and port of a folder, of this user alone."""
    place = caches() / "studio"
    if not private(place):
        raise TurgorError(f"the folder '{place}' is not yours alone, so that a token in it is not secret.")
    return place / f"{hashlib.sha256(str(folder).encode()).hexdigest()[:16]}.json"


def _bound(address: Address, before: int) -> socket.socket:
    """Socket at the port of the last time, the stated one, or any that is free."""
    family = socket.AF_INET6 if ":" in address.host else socket.AF_INET
    stated = address.port != STUDIO.port
    errors = []
    for port in (address.port,) if stated else (before or address.port, address.port, 0):
        made = socket.socket(family, socket.SOCK_STREAM)
        if os.name == "posix":  # elsewhere it would let another program take the port
            made.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        try:
            made.bind((address.host, port))
            made.listen()  # whoever opens the printed address at once waits, and is not refused
        except OSError as error:
            made.close()
            errors.append(error)
        else:
            return made
    raise TurgorError(
        f"port {address.port} of '{address.host}' cannot be bound: {errors[0].strerror}.",
        command="Name another with --port, or 0 for a free one.",
    )


def _open(where: str, browser: bool) -> None:
    if browser:
        webbrowser.open(where)
