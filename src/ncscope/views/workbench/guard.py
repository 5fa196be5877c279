"""Who may talk to the server: a check of every request and socket before anything else sees it.

The page runs with the rights of the user, and any web page in the same browser can send requests
to this address. So Host and Origin must be one of our own addresses, word by word (an Origin that
equals the Host proves nothing when a foreign name resolves to this machine), and the browser must
hold the token of this run, which only the terminal shows.
"""

from __future__ import annotations

import hmac
from collections.abc import Awaitable, Callable, MutableMapping
from dataclasses import dataclass
from http.cookies import CookieError, SimpleCookie
from typing import Any
from urllib.parse import parse_qsl, urlencode

Scope = MutableMapping[str, Any]
Receive = Callable[[], Awaitable[MutableMapping[str, Any]]]
Send = Callable[[MutableMapping[str, Any]], Awaitable[None]]
App = Callable[[Scope, Receive, Send], Awaitable[None]]

LOOPBACK = ("127.0.0.1", "localhost", "[::1]")
FOREIGN_SITES = ("cross-site", "same-site")
POLICY = (
    "default-src 'self'; script-src 'self' 'unsafe-inline' 'unsafe-eval'; "
    "style-src 'self' 'unsafe-inline'; img-src 'self' data: blob:; font-src 'self' data:; "
    "object-src 'none'; base-uri 'none'; form-action 'self'; frame-ancestors 'none'"
)
"""NiceGUI needs inline scripts and eval; what the page loads stays on this machine all the same."""
HEADERS = (
    (b"content-security-policy", POLICY.encode()),
    (b"x-content-type-options", b"nosniff"),
    (b"referrer-policy", b"no-referrer"),
    (b"cross-origin-opener-policy", b"same-origin"),
    (b"cross-origin-resource-policy", b"same-origin"),
)


@dataclass(frozen=True)
class Guard:
    """The outermost ASGI layer. `names`: host names of our own, as in a URL; `token`: of this run.

    A page opened with `?token=` gets a cookie and is sent on to the address without the token.
    """

    app: App
    port: int
    token: str
    names: tuple[str, ...] = LOOPBACK

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        if scope["type"] == "lifespan":
            await self.app(scope, receive, send)
            return
        headers = _headers(scope)
        reason = self._refusal(scope, headers)
        if reason:
            await _refuse(scope, send, 403, reason)
        elif self._token_in_query(scope):
            await _send_on(scope, send, self._cookie())
        elif not self._knows_token(headers):
            reason = "open the address that ncscope workbench shows in the terminal"
            await _refuse(scope, send, 403, reason)
        else:
            await self.app(scope, receive, _with_headers(send))

    @property
    def cookie_name(self) -> str:
        """Cookies are shared by all ports of a host; the name keeps two servers apart."""
        return f"ncscope_{self.port}"

    def _refusal(self, scope: Scope, headers: dict[str, list[str]]) -> str:
        hosts = {f"{name}:{self.port}" for name in self.names}
        if self.port == 80:
            hosts |= set(self.names)
        if len(headers.get("host", [])) != 1 or headers["host"][0].lower() not in hosts:
            return "unknown host"
        origins = headers.get("origin", [])
        if any(origin.lower() not in {f"http://{host}" for host in hosts} for origin in origins):
            return "foreign origin"
        if scope["type"] == "websocket" and not origins:
            return "a socket without an origin"
        if any(site.lower() in FOREIGN_SITES for site in headers.get("sec-fetch-site", [])):
            return "a request from another site"
        return ""

    def _token_in_query(self, scope: Scope) -> bool:
        if scope["type"] != "http" or scope["method"] != "GET":
            return False
        given = dict(_query(scope)).get("token", "")
        return hmac.compare_digest(given.encode(), self.token.encode())

    def _knows_token(self, headers: dict[str, list[str]]) -> bool:
        for line in headers.get("cookie", []):
            try:
                morsel = SimpleCookie(line).get(self.cookie_name)
            except CookieError:
                continue
            if morsel and hmac.compare_digest(morsel.value.encode(), self.token.encode()):
                return True
        return False

    def _cookie(self) -> str:
        return f"{self.cookie_name}={self.token}; Path=/; HttpOnly; SameSite=Strict"


def _headers(scope: Scope) -> dict[str, list[str]]:
    found: dict[str, list[str]] = {}
    for name, value in scope["headers"]:
        found.setdefault(name.decode("latin-1").lower(), []).append(value.decode("latin-1"))
    return found


def _query(scope: Scope) -> list[tuple[str, str]]:
    return parse_qsl(scope["query_string"].decode("latin-1"), keep_blank_values=True)


async def _refuse(scope: Scope, send: Send, status: int, reason: str) -> None:
    if scope["type"] == "websocket":
        await send({"type": "websocket.close", "code": 1008})
        return
    await _answer(send, status, [(b"content-type", b"text/plain; charset=utf-8")], reason)


async def _send_on(scope: Scope, send: Send, cookie: str) -> None:
    """To the same page without the token, so that it is in no history and no screenshot."""
    rest = urlencode([(k, v) for k, v in _query(scope) if k != "token"])
    path = "/" + scope["path"].lstrip("/\\")
    target = path + (f"?{rest}" if rest else "")
    headers = [(b"location", target.encode("ascii", "replace")), (b"set-cookie", cookie.encode())]
    await _answer(send, 303, headers, "")


async def _answer(send: Send, status: int, headers: list[tuple[bytes, bytes]], text: str) -> None:
    headers = [*headers, (b"cache-control", b"no-store"), *HEADERS]
    await send({"type": "http.response.start", "status": status, "headers": headers})
    await send({"type": "http.response.body", "body": text.encode()})


def _with_headers(send: Send) -> Send:
    async def wrapped(message: MutableMapping[str, Any]) -> None:
        if message["type"] == "http.response.start":
            message["headers"] = [*message.get("headers", []), *HEADERS]
        await send(message)

    return wrapped
