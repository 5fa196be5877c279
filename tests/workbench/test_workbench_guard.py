"""Every request and socket has to name our own address and to know the token of the run."""

from __future__ import annotations

import asyncio

import pytest

from ncscope.views.workbench.guard import Guard

PORT = 8123
TOKEN = "secret-of-this-run"
COOKIE = f"ncscope_{PORT}={TOKEN}"
OWN = {"host": f"127.0.0.1:{PORT}", "cookie": COOKIE}


def ask(
    headers: dict[str, str], *, kind: str = "http", path: str = "/", query: str = "", method="GET"
) -> tuple[bool, list[dict]]:
    """Whether the request reached the application, and what was sent back."""
    reached, sent = [], []

    async def app(scope, receive, send) -> None:
        reached.append(scope)
        if kind == "http":
            await send({"type": "http.response.start", "status": 200, "headers": []})
            await send({"type": "http.response.body", "body": b""})

    async def send(message) -> None:
        sent.append(message)

    scope = {
        "type": kind,
        "path": path,
        "query_string": query.encode(),
        "headers": [(k.encode(), v.encode()) for k, v in headers.items()],
        **({"method": method} if kind == "http" else {}),
    }
    asyncio.run(Guard(app, PORT, TOKEN)(scope, None, send))  # type: ignore[arg-type]
    return bool(reached), sent


@pytest.mark.parametrize("host", ["127.0.0.1", "localhost", "[::1]", "LOCALHOST"])
def test_own_addresses_pass(host: str) -> None:
    assert ask({**OWN, "host": f"{host}:{PORT}"})[0]


@pytest.mark.parametrize(
    "headers",
    [
        {**OWN, "host": f"evil.example:{PORT}"},
        {**OWN, "host": "127.0.0.1"},
        {**OWN, "host": "127.0.0.1:80"},
        {**OWN, "host": f"127.0.0.1.evil.example:{PORT}"},
        {"cookie": COOKIE},
        {**OWN, "origin": "http://evil.example"},
        {**OWN, "origin": "null"},
        {**OWN, "origin": f"https://127.0.0.1:{PORT}"},
        {**OWN, "host": f"evil.example:{PORT}", "origin": f"http://evil.example:{PORT}"},
        {**OWN, "sec-fetch-site": "cross-site"},
        {**OWN, "sec-fetch-site": "same-site"},
        {"host": OWN["host"]},
        {"host": OWN["host"], "cookie": f"ncscope_{PORT}=guess"},
        {"host": OWN["host"], "cookie": f"ncscope_1={TOKEN}"},
    ],
)
@pytest.mark.parametrize("method", ["GET", "POST", "OPTIONS"])
def test_foreign_requests_are_refused(headers: dict[str, str], method: str) -> None:
    reached, sent = ask(headers, method=method)
    assert not reached
    assert sent[0]["status"] == 403


def test_sockets_need_an_own_origin() -> None:
    origin = f"http://127.0.0.1:{PORT}"
    assert ask({**OWN, "origin": origin}, kind="websocket")[0]
    for headers in (
        OWN,
        {**OWN, "origin": "http://evil.example"},
        {"host": OWN["host"], "origin": origin},
    ):
        reached, sent = ask(headers, kind="websocket")
        assert not reached
        assert sent == [{"type": "websocket.close", "code": 1008}]


def test_a_token_in_the_address_becomes_a_cookie() -> None:
    reached, sent = ask({"host": OWN["host"]}, path="/", query=f"program=a%26b&token={TOKEN}")
    headers = dict(sent[0]["headers"])
    assert not reached
    assert sent[0]["status"] == 303
    assert headers[b"location"] == b"/?program=a%26b"
    assert headers[b"set-cookie"] == f"{COOKIE}; Path=/; HttpOnly; SameSite=Strict".encode()


def test_the_way_on_stays_on_this_server() -> None:
    _, sent = ask({"host": OWN["host"]}, path="//evil.example/", query=f"token={TOKEN}")
    assert dict(sent[0]["headers"])[b"location"] == b"/evil.example/"


@pytest.mark.parametrize("query", ["token=", "token=guess", "token=secret-of-this-run2", ""])
def test_another_token_is_refused(query: str) -> None:
    assert ask({"host": OWN["host"]}, query=query)[1][0]["status"] == 403


def test_answers_carry_the_policy() -> None:
    _, sent = ask(OWN)
    headers = dict(sent[0]["headers"])
    assert b"default-src 'self'" in headers[b"content-security-policy"]
    assert headers[b"x-content-type-options"] == b"nosniff"
