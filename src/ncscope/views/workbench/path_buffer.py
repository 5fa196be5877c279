"""The path of a run as one binary answer that the browser uses without copying.

Container: 8 bytes magic, u32 length of the header, JSON header, then arrays, each at a multiple of
8 bytes, little endian. The header has for every array its dtype, shape and offset from the start
of the container.

Points and axis positions have one row for the start of every stretch and one for each row of the
trajectory: row i in stretch s comes from i + s and goes to i + s + 1. A new stretch starts where
the axes stand, seen in its own coordinates. `end` says which rows are the ends of moves.
"""

from __future__ import annotations

import struct
from typing import Any

import numpy as np
import orjson
from numpy.typing import NDArray

from ncscope.frames import Array
from ncscope.trajectory import Stretch, Trajectory

MAGIC = b"NCPATH01"
RAPID = 10_000.0
"""mm or degrees per minute taken for rapid moves and moves without F: only for the playback."""
SLACK = 512
"""Room for offsets that get longer when the header is written for good."""
SHORTEST = 1e-3
"""Seconds that every block takes at least in the playback."""


def pack(result: Trajectory, pole_distance: Array) -> bytes:
    """The container for a run. pole_distance (rows,): degrees, see `Inspection`."""
    points, axes = _rows(result)
    low, high = _bounds(points)
    origin = (low + high) / 2
    time = _times(result, points, axes)
    labels, systems = _systems(result)
    names = list(dict.fromkeys(s.file for s in result.stretches))
    arrays: dict[str, NDArray[Any]] = {
        "point": (points - origin).astype("<f4"),
        "axes": axes.astype("<f4"),
        "time": time.astype("<f8"),
        "line": result.line.astype("<u4"),
        "motion": _motion(result).astype("u1"),
        "end": result.end.astype("u1"),
        "pole": pole_distance.astype("<f4"),
        "stretch_first": _firsts(result).astype("<u4"),
        "stretch_file": np.array([names.index(s.file) for s in result.stretches], "<u2"),
        "stretch_system": systems.astype("<u2"),
        "stretch_model": _model_indices(result).astype("<i4"),
        "stretch_length": np.array([s.coordinates.tool.length for s in result.stretches], "<f4"),
    }
    header = {
        "axes": list(result.axes),
        "files": names,
        "systems": labels,
        "origin": origin.tolist(),
        "low": low.tolist(),
        "high": high.tolist(),
    }
    return _container(header, arrays)


def _rows(result: Trajectory) -> tuple[Array, Array]:
    """Tool tips (rows, 3) in the MCS and axis positions (rows, n), mm and degrees."""
    count = len(result) + len(result.stretches)
    points, axes = np.zeros((count, 3)), np.full((count, len(result.axes)), np.nan)
    row = 0
    for s in result.stretches:
        columns = [result.axes.index(a) for a in s.axes]
        main = min(3, len(s.axes))
        stop = row + len(s) + 1
        points[row, :main] = s.coordinates.mcs_from_axes(s.start)[:main]
        points[row + 1 : stop, :main] = s.mcs[:, :main]
        axes[row, columns] = s.start
        axes[row + 1 : stop, columns] = s.acs
        row = stop
    return points, axes


def _times(result: Trajectory, points: Array, axes: Array) -> Array:
    """Seconds (rows,) until the end of each row, from the feed alone."""
    total, parts, row = 0.0, [], 0
    for s in result.stretches:
        stop = row + len(s) + 1
        tip = np.sqrt(sum(np.diff(column) ** 2 for column in points[row:stop].T))
        swing = np.zeros(len(s))
        for column in axes[row:stop].T:
            np.fmax(swing, np.abs(np.diff(column)), out=swing)
        way = np.where(tip > 1e-9, tip, swing)
        feed = np.where((s.motion == 0) | ~(s.feed > 0), RAPID, s.feed)
        fast = np.where(s.motion == 0, np.maximum(swing, tip), way)
        seconds = np.maximum(SHORTEST, np.nan_to_num(fast) * 60.0 / feed)
        parts.append(total + np.cumsum(seconds))
        total = float(parts[-1][-1]) if len(s) else total
        row = stop
    return np.concatenate(parts) if parts else np.empty(0)


def _bounds(points: Array) -> tuple[Array, Array]:
    """Smallest and largest coordinates (3,), mm; column by column, which is faster."""
    if not len(points):
        return np.zeros(3), np.zeros(3)
    columns = [points[:, k] for k in range(3)]
    return np.array([c.min() for c in columns]), np.array([c.max() for c in columns])


def _systems(result: Trajectory) -> tuple[list[str], NDArray[np.int64]]:
    """Labels of the coordinate systems that were active, and the index of each stretch."""
    labels: dict[str, int] = {}
    found = []
    for s in result.stretches:
        level = s.coordinates.top
        zero = [o.name for k, o in s.coordinates.levels[0].offsets if k == "zero"]
        label = level.name if len(s.coordinates.levels) > 1 else (zero[0] if zero else "MCS")
        if len(s.coordinates.levels) > 1 and level.origin:
            label += f" ({level.origin})"
        found.append(labels.setdefault(label, len(labels)))
    return list(labels), np.array(found, dtype=np.int64)


def models(result: Trajectory) -> list[Any]:
    """Every kinematics that was active, once, in the order of the run."""
    found = {id(m): m for s in result.stretches if (m := _model(s)) is not None}
    return list(found.values())


def _model(s: Stretch) -> Any:
    active = s.coordinates.kinematics
    return None if active is None else active.model


def _model_indices(result: Trajectory) -> NDArray[np.int64]:
    """For every stretch the index in `models`, -1 without a kinematics."""
    places = {id(model): i for i, model in enumerate(models(result))}
    found = [-1 if (m := _model(s)) is None else places[id(m)] for s in result.stretches]
    return np.array(found, dtype=np.int64)


def _firsts(result: Trajectory) -> NDArray[np.int64]:
    counts = [len(s) for s in result.stretches]
    return np.cumsum([0, *counts], dtype=np.int64)[:-1]


def _motion(result: Trajectory) -> NDArray[np.int8]:
    if not result.stretches:
        return np.empty(0, np.int8)
    return np.concatenate([s.motion for s in result.stretches])


def _container(header: dict[str, Any], arrays: dict[str, NDArray[Any]]) -> bytes:
    places: dict[str, Any] = {}
    text = b""
    for _ in range(2):  # the second time with the true length of the header
        at = _aligned(len(MAGIC) + 4 + len(text) + SLACK)
        for name, array in arrays.items():
            places[name] = {"dtype": array.dtype.str, "shape": array.shape, "offset": at}
            at = _aligned(at + array.nbytes)
        text = orjson.dumps({**header, "arrays": places})
    out = bytearray(at)
    out[: len(MAGIC)] = MAGIC
    struct.pack_into("<I", out, len(MAGIC), len(text))
    out[len(MAGIC) + 4 : len(MAGIC) + 4 + len(text)] = text
    for name, array in arrays.items():
        first = places[name]["offset"]
        place = np.ndarray(array.shape, array.dtype, out, first)
        place[...] = array
    return bytes(out)


def _aligned(offset: int) -> int:
    return (offset + 7) // 8 * 8
