"""Pictures as one html file that works offline: plotly with its library inside.

Enters: a `ToolPath` with its run, or a `ChainScene`. Leaves: the bytes of a file.
Plotly reads some markup in texts; every text from programs and lists is escaped.
"""

from __future__ import annotations

from html import escape
from typing import Any

import numpy as np
import plotly.graph_objects as go
from plotly.subplots import make_subplots

from ncscope.frames import Array
from ncscope.inspection import Inspection
from ncscope.trajectory import Trajectory
from ncscope.views.pictures.chain import ChainScene, Part
from ncscope.views.pictures.curves import FEW_BLOCKS, Curve, curves
from ncscope.views.pictures.path import ToolPath
from ncscope.views.pictures.reduce import polyline

SEGMENTS = 60_000
COLOURS = {
    "feed": "#1f5f9e",
    "rapid": "#d9730d",
    "limit": "#c62828",
    "base": "#9a9a9a",
    "linear": "#1f5f9e",
    "rotary": "#d9730d",
    "flange": "#2e7d32",
    "tool": "#111111",
}
TRIAD = ("#c62828", "#2e7d32", "#1565c0")
PART_WIDTHS = {"base": 1.5, "tool": 8, "linear": 7}
SCENE_HEIGHT, CURVE_HEIGHT = 720, 110
CAMERA = {"eye": {"x": 1.1, "y": -1.5, "z": 1.1}, "projection": {"type": "orthographic"}}


def path_page(result: Trajectory, inspection: Inspection, path: ToolPath, title: str) -> bytes:
    """The path to turn and zoom, and each axis over the blocks with a common scale."""
    rows = curves(result, inspection)
    count = int(result.end.sum())
    height = SCENE_HEIGHT + CURVE_HEIGHT * len(rows)
    figure = make_subplots(
        rows=1 + len(rows),
        cols=1,
        shared_xaxes=True,
        vertical_spacing=14 / height,
        row_heights=[SCENE_HEIGHT, *[CURVE_HEIGHT] * len(rows)],
        specs=[[{"type": "scene"}], *[[{"type": "xy"}]] * len(rows)],
    )
    for kind in ("rapid", "feed"):
        figure.add_trace(_path_line(result, path, kind), row=1, col=1)
    for triad in path.triads:
        for trace in _triad(triad.name, triad.origin, triad.axes, 0.13 * path.size):
            figure.add_trace(trace, row=1, col=1)
    for place, curve in enumerate(rows, start=2):
        for trace in _curve(curve, count):
            figure.add_trace(trace, row=place, col=1)
        figure.update_yaxes(title_text=text_of(curve.name), row=place, col=1)
    figure.update_xaxes(
        title_text="motion blocks in the order in which they run",
        tickformat=",d",
        dtick=1 if count <= FEW_BLOCKS else None,
        row=1 + len(rows),
    )
    return _page(figure, title, height + 120)


def chain_page(scene: ChainScene, title: str, note: str) -> bytes:
    """The chain of a machine to turn and zoom."""
    figure = go.Figure()
    for part in scene.parts:
        for trace in _part(part, scene.size):
            figure.add_trace(trace)
    lines = [
        f"{box.name}: {box.kind} {box.direction} {at} {box.remark} {box.side}"
        for box in scene.boxes
        for at in [f"at {box.point}" if box.point else ""]
    ]
    text = "<br>".join(text_of(line) for line in [note, "from the workpiece to the tool:", *lines])
    figure.add_annotation(
        text=text,
        xref="paper",
        yref="paper",
        x=0,
        y=1,
        showarrow=False,
        align="left",
        xanchor="left",
        yanchor="top",
        font={"size": 12},
    )
    return _page(figure, title, 860)


def _path_line(result: Trajectory, path: ToolPath, kind: str) -> Any:
    wanted = np.flatnonzero(path.rapid == (kind == "rapid"))
    line = polyline(path.start[wanted], path.end[wanted], SEGMENTS)
    lines = result.line[wanted][line.rows] if len(wanted) else np.empty(0)
    x, y, z = line.points.T.astype(np.float32)
    return go.Scatter3d(
        x=x,
        y=y,
        z=z,
        mode="lines",
        name=kind,
        customdata=lines.astype(np.int32),
        line={"color": COLOURS[kind], "width": 3, "dash": "dash" if kind == "rapid" else "solid"},
        hovertemplate=f"{kind}, line %{{customdata}}<br>X %{{x:.3f}} Y %{{y:.3f}} Z %{{z:.3f}}"
        "<extra></extra>",
    )


def _curve(curve: Curve, count: int) -> list[Any]:
    """One axis over the `count` blocks of the run, and its limits."""
    line = go.Scatter(
        x=curve.blocks,
        y=curve.values,
        name=text_of(curve.name),
        showlegend=False,
        line={"color": COLOURS["feed"], "width": 1.2},
        hovertemplate=text_of(curve.name) + " %{y:.4f}<extra>block %{x}</extra>",
    )
    limits = [
        go.Scatter(
            x=[1, max(count, 2)],
            y=[value, value],
            mode="lines",
            showlegend=False,
            line={"color": COLOURS["limit"], "width": 1.2, "dash": "dash"},
            hoverinfo="y",
        )
        for value in curve.limits
    ]
    return [line, *limits]


def _triad(name: str, origin: Array, axes: Array, length: float) -> list[Any]:
    found = []
    for letter, row, colour in zip("XYZ", axes, TRIAD, strict=True):
        x, y, z = np.array([origin, origin + length * row]).T
        label = text_of(name) if letter == "X" else ""
        found.append(
            go.Scatter3d(
                x=x,
                y=y,
                z=z,
                mode="lines+text",
                text=[label, letter],
                textposition="top center",
                textfont={"size": 11, "color": "#444444"},
                line={"color": colour, "width": 5},
                showlegend=False,
                hoverinfo="skip",
            )
        )
    return found


def _part(part: Part, size: float) -> list[Any]:
    """A part of the chain: its point, its line with the label, and how it turns."""
    label = text_of(part.label)
    found = []
    if part.point is not None:
        found.append(_point(part.point, COLOURS[part.kind], "" if len(part.line) else label))
    for line, text in ((part.line, label), (part.turn, "")):
        if line is None or len(line) == 0:
            continue
        found.append(_part_line(line, part.kind, text))
        if part.arrow and part.kind != "base":
            found.append(_head(line, COLOURS[part.kind], 0.05 * size))
    return found


def _point(point: Array, colour: str, text: str) -> Any:
    x, y, z = point[:, None]
    return go.Scatter3d(
        x=x,
        y=y,
        z=z,
        mode="markers+text",
        marker={"size": 5, "color": colour},
        text=[text],
        textposition="bottom center",
        showlegend=False,
        hoverinfo="x+y+z",
    )


def _part_line(line: Array, kind: str, text: str) -> Any:
    """A line (k, 3) in the colour of its kind, with a text at its end."""
    x, y, z = line.T
    return go.Scatter3d(
        x=x,
        y=y,
        z=z,
        mode="lines+text",
        text=[*[""] * (len(line) - 1), text],
        hoverinfo="skip",
        line={"color": COLOURS[kind], "width": PART_WIDTHS.get(kind, 4)},
        showlegend=False,
        textfont={"size": 14, "color": COLOURS[kind]},
    )


def _head(line: Array, colour: str, size: float) -> Any:
    way = line[-1] - line[-2]
    u, v, w = (size * way / np.linalg.norm(way))[:, None]
    x, y, z = line[-1][:, None]
    return go.Cone(
        x=x,
        y=y,
        z=z,
        u=u,
        v=v,
        w=w,
        anchor="tip",
        sizemode="raw",
        sizeref=1,
        showscale=False,
        colorscale=[[0, colour], [1, colour]],
        hoverinfo="skip",
    )


def _proportions(figure: Any) -> dict[str, float]:
    """True to scale, the longest edge 1.3, so that every machine and every part fits."""
    edges = []
    for c in "xyz":
        values = [t[c] for t in figure.data if t.type == "scatter3d" and len(t[c])]
        flat = np.concatenate(values) if values else np.zeros(1)
        edges.append(float(np.nanmax(flat) - np.nanmin(flat)))
    longest = max(*edges, 1e-9)
    return {c: 1.3 * max(edge / longest, 1e-3) for c, edge in zip("xyz", edges, strict=True)}


def text_of(text: str) -> str:
    """Text that plotly shows letter by letter: no markup, no template."""
    return escape(text).replace("%{", "% {")


def _page(figure: Any, title: str, height: int) -> bytes:
    axis = {"backgroundcolor": "#fafafa", "gridcolor": "#e3e3e3", "zerolinecolor": "#bbbbbb"}
    figure.update_layout(
        title={"text": text_of(title), "font": {"size": 16}},
        height=height,
        template="plotly_white",
        margin={"l": 70, "r": 20, "t": 60, "b": 50},
        legend={"orientation": "h", "y": 1.0},
        font={"family": "sans-serif"},
        scene={
            "aspectmode": "manual",
            "aspectratio": _proportions(figure),
            "camera": CAMERA,
            **{f"{c}axis": {"title": {"text": f"{c.upper()} mm"}, **axis} for c in "xyz"},
        },
    )
    html = figure.to_html(
        include_plotlyjs=True,
        include_mathjax=False,
        full_html=True,
        div_id="picture",
        config={"displaylogo": False, "responsive": True},
    )
    head = f'<head><meta charset="utf-8"><title>{escape(title)}</title>'
    return html.replace('<head><meta charset="utf-8" />', head, 1).encode()
