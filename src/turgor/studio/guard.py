"""Guard: who may talk to the studio. Only pages that it has sent itself, on this machine.

Any web page that a user opens may send requests to a server on his machine, and a name that such a page owns may be
made to point here (DNS rebinding). So the name in each request must be one of this server, a page that sends it must be
of this server, and a cookie must show that it was opened with the token of the first address.
"""

import secrets
from collections.abc import Iterable, MutableMapping
from dataclasses import dataclass
from urllib.parse import parse_qs, urlsplit

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

#: Methods that change nothing, which a browser sends without the page that they come from.
SAFE = frozenset({"GET", "HEAD"})


@dataclass(frozen=True, slots=True, kw_only=True)
class Access:
    """What a request must show.

    Parameters
    ----------
    token : str
        Secret of the first address; a cookie afterwards.
    hosts : frozenset of str
        Names with ports under which the server is known, such as ``"127.0.0.1:8765"``.
    """

    token: str
    hosts: frozenset[str]

    @property
    def cookie(self) -> str:
        """Name of the cookie: cookies do not know ports, so that servers on two ports need two names."""
        return f"turgor_studio_{min(self.hosts).rpartition(':')[2]}"


def access_to(host: str, port: int, token: str = "", names: Iterable[str] = ()) -> Access:
    """Return the access to a server at an address, also under further names.

    Examples
    --------
    >>> sorted(access_to("127.0.0.1", 8765, "secret").hosts)
    ['127.0.0.1:8765', '[::1]:8765', 'localhost:8765']
    """
    known = {"127.0.0.1", "localhost", "[::1]", *names}
    if host not in ("", "0.0.0.0", "::", "::1"):
        known.add(host)
    return Access(token=token or secrets.token_urlsafe(32), hosts=frozenset(f"{name}:{port}" for name in known))


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
            response = RedirectResponse(scope["path"], status_code=303)
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
        origin = headers.get("origin")
        if origin is None:
            safe = scope["type"] == "http" and scope["method"] in SAFE
            return "" if safe else "The request does not say which page sends it (Origin).\n"
        return "" if urlsplit(origin).netloc.lower() in self.access.hosts else "Another page sent this request.\n"

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
