"""Guard: who may talk to the studio. Only pages that it has sent itself, on this machine.

Any web page that a user opens may send requests to a server on his machine, and a name that such a page owns may be
made to point here (DNS rebinding). So the name in each request must be one of this server, a page that sends it must be
of this server, and a cookie must show that it was opened with the token of the first address.
"""

import re
import secrets
from collections.abc import Iterable, MutableMapping
from dataclasses import dataclass
from urllib.parse import parse_qs

from starlette.responses import PlainTextResponse, RedirectResponse
from starlette.types import ASGIApp, Message, Receive, Scope, Send

#: What a page may load: what this server sends, and pictures that the page makes itself.
POLICY = (
    "default-src 'self'; connect-src 'self' {sockets}; img-src 'self' data: blob:; object-src 'none'; base-uri 'none'; "
    "form-action 'self'; frame-src 'self'; frame-ancestors 'self'"
)

#: What a page of a run may do: its own scripts, in an origin of its own, and nothing from this server.
REPORT_POLICY = (
    "sandbox allow-scripts allow-downloads; default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; "
    "img-src data: blob:; font-src data:"
)

#: A port at the end of a name.
_PORT = re.compile(r":\d+$")

#: Methods that change nothing, which a browser sends without the page that they come from.
SAFE = frozenset({"GET", "HEAD"})


#: Addresses that stand for all of this machine, under which no browser reaches it.
EVERY = ("", "0.0.0.0", "::")


@dataclass(frozen=True, slots=True, kw_only=True)
class Access:
    """What a request must show.

    Parameters
    ----------
    token : str
        Secret of the first address; a cookie afterwards.
    hosts : frozenset of str
        Names with ports under which the server is known, such as ``"127.0.0.1:8765"``.
    port : int
    """

    token: str
    hosts: frozenset[str]
    port: int

    @property
    def cookie(self) -> str:
        """Name of the cookie: cookies do not know ports, so that servers on two ports need two names."""
        return f"turgor_studio_{self.port}"


def access_to(host: str, port: int, token: str = "", names: Iterable[str] = ()) -> Access:
    """Return the access to a server at an address, also under further names, which may have a port of their own.

    Examples
    --------
    >>> sorted(access_to("127.0.0.1", 8765, "secret", ["localhost:9000"]).hosts)
    ['127.0.0.1:8765', '[::1]:8765', 'localhost:8765', 'localhost:9000']
    """
    known = ["127.0.0.1", "localhost", "[::1]", *names, *([] if host in EVERY else [in_address(host)])]
    hosts = frozenset((name if _PORT.search(name) else f"{name}:{port}").lower() for name in known)
    return Access(token=token or secrets.token_urlsafe(32), hosts=hosts, port=port)


def in_address(host: str) -> str:
    """Return a host as it stands in an address: IPv6 in brackets, this machine for all of its addresses.

    Examples
    --------
    >>> in_address("::1"), in_address("0.0.0.0"), in_address("lab.example")
    ('[::1]', '127.0.0.1', 'lab.example')
    """
    if host in EVERY:
        return "127.0.0.1"
    return f"[{host}]" if ":" in host else host


class Guard:
    """Refuses requests that do not come from a page of this server, and says what its pages may load."""

    def __init__(self, app: ASGIApp, access: Access) -> None:
        self.app = app
        self.access = access

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Answer a request: pass it on, set the cookie, or refuse it."""
        if scope["type"] == "lifespan":
            await self.app(scope, receive, send)
            return
        headers = {key.decode("latin-1").lower(): value.decode("latin-1") for key, value in scope["headers"]}
        reason = self._refusal(scope, headers)
        if not reason and self._has_token(scope):
            response = RedirectResponse(f"/{scope['path'].lstrip('/')}", status_code=303)
            response.set_cookie(self.access.cookie, self.access.token, httponly=True, samesite="strict", path="/")
            await response(scope, receive, self._with_policy(scope, send))
        elif not reason and self._has_cookie(headers):
            await self.app(scope, receive, self._with_policy(scope, send))
        elif scope["type"] == "websocket":
            await receive()
            await send({"type": "websocket.close", "code": 1008})  # before it is accepted: a 403
        else:
            text = reason or "Open the address that `turgor studio` printed: this one lacks its token.\n"
            await PlainTextResponse(text, status_code=403)(scope, receive, self._with_policy(scope, send))

    def _refusal(self, scope: Scope, headers: MutableMapping[str, str]) -> str:
        if headers.get("host", "").lower() not in self.access.hosts:
            return f"The host '{headers.get('host', '')[:80]}' is none of {', '.join(sorted(self.access.hosts))}.\n"
        if headers.get("sec-fetch-site") in ("cross-site", "same-site") and headers.get("sec-fetch-mode") != "navigate":
            return "Another page sent this request.\n"  # one of another port sends the cookie, too: ports are one site
        origin = headers.get("origin")
        if origin is None:
            safe = scope["type"] == "http" and scope["method"] in SAFE
            return "" if safe else "The request does not say which page sends it (Origin).\n"
        scheme, _, host = origin.lower().partition("://")
        return "" if scheme == "http" and host in self.access.hosts else "Another page sent this request.\n"

    def _has_token(self, scope: Scope) -> bool:
        if scope["type"] != "http" or scope["method"] != "GET":
            return False
        given = parse_qs(scope["query_string"].decode("latin-1")).get("token", [""])[0]
        return secrets.compare_digest(given.encode(), self.access.token.encode())

    def _has_cookie(self, headers: MutableMapping[str, str]) -> bool:
        pairs = [part.strip().partition("=") for part in headers.get("cookie", "").split(";")]
        given = next((value for name, _, value in pairs if name == self.access.cookie), "")
        return secrets.compare_digest(given.encode(), self.access.token.encode())

    def _with_policy(self, scope: Scope, send: Send) -> Send:
        hosts = sorted(host for host in self.access.hosts if not host.startswith("["))  # a policy takes no IPv6 address
        sockets = " ".join(f"ws://{host}" for host in hosts)
        more = {
            b"content-security-policy": POLICY.format(sockets=sockets).encode(),
            b"x-content-type-options": b"nosniff",
            b"referrer-policy": b"no-referrer",
            b"cross-origin-opener-policy": b"same-origin",
            b"cross-origin-resource-policy": b"same-origin",
            b"cache-control": b"no-store",
        }

        async def sent(message: Message) -> None:
            if message["type"] == "http.response.start":
                given = {name.lower() for name, _ in message["headers"]}
                message["headers"] = [*message["headers"], *((k, v) for k, v in more.items() if k not in given)]
            await send(message)

        return sent if scope["type"] == "http" else send
