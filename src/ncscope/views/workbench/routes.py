"""The questions that the page asks over HTTP, each about one session.

    GET  /api/<session>/files                 programs and machines of the folder
    POST /api/<session>/open                  {program, machine, clamp, skip, sample}
    POST /api/<session>/stop
    GET  /api/<session>/result/<revision>     axes, files, diagnostics, messages, machine
    GET  /api/<session>/path/<revision>       the binary path, see path_buffer
    GET  /api/<session>/move/<revision>/<row> one move with its layers
    GET  /api/<session>/line/<revision>/<line>  a line without moves
    GET  /api/<session>/text?key=             the text of a file; its version in a header
    POST /api/<session>/edit?key=             {version, changes: [[start, end, insert]]} or {text}
    POST /api/<session>/save?key=
    POST /api/<session>/jog                   {id, axes, length} or {id, tip, direction, length}

Text goes as text/plain or inside JSON, never as HTML. The handlers are plain functions, so that
they run beside the event loop.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from typing import Any

import orjson
from starlette.requests import Request
from starlette.responses import Response
from starlette.routing import Route

from ncscope.channel.draft import Message
from ncscope.diagnostics import Diagnostic, Severity
from ncscope.execution import Options
from ncscope.inspection import pole_distance
from ncscope.kinematics import KinematicsError
from ncscope.views.records import diagnostic_record
from ncscope.views.workbench.buffers import Buffer, Change, OutOfStep
from ncscope.views.workbench.events import events
from ncscope.views.workbench.files import Refused
from ncscope.views.workbench.machines import jog_forward, jog_inverse, machine_view, model_view
from ncscope.views.workbench.moves import line_view, move_view
from ncscope.views.workbench.path_buffer import models, pack
from ncscope.views.workbench.running import Outcome
from ncscope.views.workbench.session import Session, Sessions

MOST_DIAGNOSTICS = 2000
MOST_MESSAGES = 2000
MOST_BODY = 64_000_000
"""Bytes of a request: a whole text of a large program."""

Answer = Callable[[Session, dict[str, Any], Any], Any]
"""Session, path parameters and query, and the JSON body, to a JSON value or a Response."""


class Wrong(Exception):
    """A request that the page would not send."""


def routes(sessions: Sessions) -> list[Route]:
    """All routes on these sessions."""

    def route(method: str, path: str, answer: Answer) -> Route:
        async def endpoint(request: Request) -> Response:
            from starlette.concurrency import run_in_threadpool

            session = sessions.by_key.get(request.path_params["session"])
            if session is None:
                return _json({"error": "this page is no longer known; load it anew"}, 410)
            body = await _body(request) if method == "POST" else None
            parameters = {**request.query_params, **request.path_params}
            return await run_in_threadpool(_answered, answer, session, parameters, body)

        return Route("/api/{session}" + path, endpoint, methods=[method])

    return [
        route("GET", "/files", _files),
        route("POST", "/open", _open),
        route("POST", "/stop", _stop),
        route("GET", "/result/{revision:int}", _result),
        route("GET", "/path/{revision:int}", _path),
        route("GET", "/move/{revision:int}/{row:int}", _move),
        route("GET", "/line/{revision:int}/{line:int}", _line),
        route("GET", "/text", _text),
        route("POST", "/edit", _edit),
        route("POST", "/save", _save),
        route("POST", "/jog", _jog),
    ]


async def _body(request: Request) -> bytes:
    parts, size = [], 0
    async for part in request.stream():
        size += len(part)
        if size > MOST_BODY:
            return b"too large"
        parts.append(part)
    return b"".join(parts)


def _answered(
    answer: Answer, session: Session, parameters: dict[str, Any], body: bytes | None
) -> Response:
    try:
        value = answer(session, parameters, orjson.loads(body) if body else {})
    except (Refused, KinematicsError) as refused:
        return _json({"error": str(refused)}, 422)
    except OutOfStep:
        return _json({"error": "the text has another version"}, 409)
    except LookupError as missing:
        return _json({"error": str(missing.args[0]) if missing.args else "not found"}, 404)
    except (Wrong, ValueError, TypeError, AttributeError):
        return _json({"error": "the request cannot be understood"}, 400)
    return value if isinstance(value, Response) else _json(value)


def _json(value: Any, status: int = 200) -> Response:
    content = orjson.dumps(value, option=orjson.OPT_SERIALIZE_NUMPY)
    headers = {"cache-control": "no-store"}
    return Response(content, status, headers, "application/json")


# --- the questions ---------------------------------------------------------------------------


def _files(session: Session, given: dict[str, Any], body: Any) -> Any:
    found = session.folder.listing()
    return {"programs": found.programs, "machines": found.machines, "cut": found.cut}


def _open(session: Session, given: dict[str, Any], body: Any) -> Any:
    session.open(_string(body, "program"), _string(body, "machine"), _options(session, body))
    return session.state.as_dict()


def _stop(session: Session, given: dict[str, Any], body: Any) -> Any:
    session.stop()
    return {}


def _result(session: Session, given: dict[str, Any], body: Any) -> Any:
    outcome = _outcome(session, given)
    result = outcome.trajectory
    return {
        "ok": result.ok,
        "moves": len(result),
        "axes": result.axes,
        "files": outcome.files,
        "machine": machine_view(outcome.machine),
        "models": [model_view(outcome.machine, model) for model in models(outcome.drawn)],
        "diagnostics": [
            _diagnostic(d) for d in (*outcome.found, *result.diagnostics)[:MOST_DIAGNOSTICS]
        ],
        "events": events(outcome.trajectory, outcome.inspection),
        "messages": [_message(m) for m in result.messages[:MOST_MESSAGES]],
    }


def _path(session: Session, given: dict[str, Any], body: Any) -> Any:
    outcome = _outcome(session, given)
    content = pack(outcome.drawn, pole_distance(outcome.drawn))
    headers = {"cache-control": "no-store", "content-encoding": "identity"}
    return Response(content, 200, headers, "application/octet-stream")


def _move(session: Session, given: dict[str, Any], body: Any) -> Any:
    return move_view(_outcome(session, given).trajectory, given["row"])


def _line(session: Session, given: dict[str, Any], body: Any) -> Any:
    return line_view(_outcome(session, given).trajectory, given["line"])


def _text(session: Session, given: dict[str, Any], body: Any) -> Any:
    buffer = session.buffer(given["key"], fresh="fresh" in given)
    headers = {
        "cache-control": "no-store",
        "x-version": str(buffer.version),
        "x-changed": str(int(buffer.changed)),
        "x-line-end": "crlf" if buffer.line_end == "\r\n" else "lf",
    }
    return Response(buffer.text.encode(), 200, headers, "text/plain; charset=utf-8")


def _edit(session: Session, given: dict[str, Any], body: Any) -> Any:
    key = given["key"]
    try:
        if "text" in body:
            return _buffer(session.replace_text(key, _string(body, "text")))
        changes = [Change(int(a), int(b), str(text)) for a, b, text in body["changes"]]
        return _buffer(session.edit(key, int(body["version"]), changes))
    except UnicodeEncodeError as error:
        raise Refused(f"the character {error.object[error.start]!r} is not in Latin-1") from None


def _save(session: Session, given: dict[str, Any], body: Any) -> Any:
    return _buffer(session.save(given["key"]))


def _jog(session: Session, given: dict[str, Any], body: Any) -> Any:
    outcome = session.outcome
    if outcome is None:
        raise Refused("there is no machine yet")
    id, length = int(body["id"]), _number(body.get("length", 0.0))
    axes = _numbers(body.get("axes", []))
    if "tip" not in body:
        return jog_forward(outcome.machine, id, axes, length)
    tip, direction = _numbers(body["tip"]), _numbers(body["direction"])
    return jog_inverse(outcome.machine, id, tip, direction, length, axes)


# --- values ----------------------------------------------------------------------------------


def _outcome(session: Session, given: dict[str, Any]) -> Outcome:
    outcome = session.result(given["revision"])
    if outcome is None:
        raise LookupError("there is a newer result")
    return outcome


def _options(session: Session, body: Any) -> Options:
    clamp = body.get("clamp")
    skip = frozenset(int(level) for level in body.get("skip", []))
    return replace(session.options, clamp=None if clamp is None else int(clamp), skip=skip)


def _buffer(buffer: Buffer) -> dict[str, Any]:
    return {"version": buffer.version, "changed": buffer.changed}


def _message(message: Message) -> dict[str, Any]:
    """A text of the program, with the line that wrote it."""
    span = message.span
    place = {"source": span.source.name, "line": span.line} if span else {}
    return {"file": message.file, "text": message.text, **place}


def _diagnostic(item: Diagnostic) -> dict[str, Any]:
    """The record of jsonl with the length of the marked text and what would be right."""
    span = item.span
    return {
        **diagnostic_record(item),
        "length": max(1, span.end - span.start) if span else 0,
        "hint": item.hint,
        "error": item.severity is Severity.ERROR,
        "notes": [
            {"message": text, "file": other.source.name, "line": other.line}
            for text, other in item.notes
        ],
    }


def _string(body: Any, name: str) -> str:
    value = body.get(name, "")
    if not isinstance(value, str):
        raise Wrong
    return value


def _number(value: Any) -> float:
    number = float(value)
    if not math.isfinite(number):
        raise Wrong
    return number


def _numbers(values: Any) -> list[float]:
    return [_number(v) for v in values[:32]]
