"""One block taken apart, and the way back: axis positions to programmed values under its state.

Enters: what a run left at a block. Leaves: the layers from the programmed word to the axes, or
the coordinates of given axis positions. Both ask the `Coordinates` of the block.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np

from ncscope.coordinates import Coordinates, Layer
from ncscope.frames import Array


class Visit(NamedTuple):
    """One block that was executed: its chain, programmed values (n,), axis positions before it
    and behind it (n,)."""

    coordinates: Coordinates
    axes: tuple[str, ...]
    file: str
    block: int | None
    program: Array
    start: Array
    position: Array


@dataclass(frozen=True)
class Explanation:
    """The layers between the programmed word and the axes for one block."""

    file: str
    line: int
    block: int | None
    axes: tuple[str, ...]
    layers: tuple[Layer, ...]

    def as_dict(self) -> dict[str, Any]:
        """The form of `explain --format json`."""
        return {
            "file": self.file,
            "line": self.line,
            "block": self.block,
            "layers": [
                {
                    "name": layer.name,
                    "origin": layer.origin,
                    "change": dict(zip(self.axes, map(float, layer.change), strict=True)),
                    "values": dict(zip(self.axes, map(float, layer.values), strict=True)),
                }
                for layer in self.layers
            ],
        }


@dataclass(frozen=True)
class Whereabouts:
    """Where given axis positions are under the state of one block; mm and degrees, (n,) each.

    axes: names. assumed: axes that were not given and stand where the block left them.
    direction: unit vector tip -> flange in the MCS, None without a kinematics.
    """

    file: str
    line: int
    block: int | None
    axes: tuple[str, ...]
    assumed: tuple[str, ...]
    pcs: Array
    wcs: Array
    mcs: Array
    acs: Array
    direction: Array | None

    def as_dict(self) -> dict[str, Any]:
        """The form of `where --format json`; the machine system has the three main axes only."""
        named = {"pcs": self.pcs, "wcs": self.wcs, "mcs": self.mcs[:3], "acs": self.acs}
        return {
            "file": self.file,
            "line": self.line,
            "block": self.block,
            "assumed": list(self.assumed),
            **{
                name: dict(zip(self.axes, map(float, values), strict=False))
                for name, values in named.items()
            },
            "direction": None if self.direction is None else self.direction.tolist(),
        }


def whereabouts(at: Visit, line: int, axes: Mapping[str, float]) -> Whereabouts:
    """Where these axis positions are under the state of a block; mm and degrees by axis name.

    Axes that are not named stand where the block left them. Raises KeyError for an unknown axis.
    """
    unknown = [name for name in axes if name not in at.axes]
    if unknown:
        has = " ".join(at.axes)
        raise KeyError(f"axis {unknown[0]} is not in the channel at line {line}; it has {has}")
    position = np.array(at.position, dtype=float)
    for name, value in axes.items():
        position[at.axes.index(name)] = value
    chain = at.coordinates
    program = chain.to_program(position)
    mcs = chain.to_mcs(program)
    assumed = tuple(a for a in at.axes if a not in axes)
    return Whereabouts(
        at.file, line, at.block, at.axes, assumed, program, chain.wcs_from_mcs(mcs), mcs,
        position, chain.direction(position),
    )  # fmt: skip
