"""Every G function: its modal group, the control's id for two of a group, and what it does here.

`effect` is `motion`, `modal`, `contour`, `offset`, `call`, `quiet` (no effect on positions, noted
once) or `refused` (moves positions; stops the program by name).
Source: TF5200 programming manual; P-CHAN-00063 modal groups.
"""

from __future__ import annotations

from typing import NamedTuple


class GFunction(NamedTuple):
    """group: modal group or None. double_id: diagnostic for two functions of the group."""

    group: str | None
    double_id: str | None
    effect: str
    purpose: str


def _rows() -> dict[int, GFunction]:
    table: dict[int, GFunction] = {}

    def add(numbers: str, group: str | None, double_id: str | None, effect: str, purpose: str):
        for number in numbers.split():
            table[int(number)] = GFunction(group, double_id, effect, purpose)

    # fmt: off
    add("0 1", "motion", "20108", "motion", "linear motion, rapid or with feed")
    add("2 3", "motion", "20108", "motion", "circular motion")
    add("4", "motion", "20108", "quiet", "dwell")
    add("33 63 331 332", "motion", "20108", "motion", "thread cutting and tapping")
    add("74", "motion", "20108", "motion", "homing")
    add("98 99", "motion", "20108", "modal", "software limits from the program")
    add("160", None, None, "offset", "take axes into or out of a zero offset group")
    add("301 302", "corner", "20130", "motion", "chamfer and rounding")
    add("303", None, None, "refused", "circle in space")
    add("8 9 900 901 193 293", None, None, "quiet", "acceleration and feed at block limits")
    add("40", "radius", "20113", "modal", "cutter radius compensation off")
    add("41 42", "radius", "20113", "modal", "cutter radius compensation")
    add("5 10 11 12 13 25 26 138 139 140 141 236 237 238 239", None, None, "quiet",
        "behaviour of the cutter radius compensation")
    add("17 18 19", "plane", "20111", "modal", "working plane")
    add("20", "mirror", "20112", "contour", "mirror off")
    add("21 22 23 351", "mirror", "20112", "contour", "mirror")
    add("51", "diameter", "20115", "modal", "diameter programming")
    add("52", "diameter", "20115", "modal", "diameter programming off")
    add("53 54 55 56 57 58 59 159", "zero", "20116", "offset", "zero offset")
    add("60 61 260 261 359 360", "exact stop", "20117", "quiet", "exact stop and contouring")
    add("166 167", "override", None, "quiet", "override fixed at 100 %")
    add("68", "rotation", None, "contour", "contour rotation")
    add("69", "rotation", None, "contour", "contour rotation off")
    add("70 71", "unit", "20118", "modal", "inches or millimetres")
    add(" ".join(map(str, [*range(80, 90), *range(800, 840)])), "cycle", "20119", "call",
        "implicit subprogram call")
    add("90 91", "absolute", "20120", "modal", "absolute or relative values")
    add("92", None, None, "offset", "reference point offset")
    add("93 94 95 194", "feed", "20121", "quiet", "meaning of F")
    add("96 97 196", "speed", "20122", "quiet", "meaning of S")
    add("112 115 116 117 127 128 129 130 131 132 133 134 135 136 137 230 231 232 233 333 334 "
        "335 336 337 338 339", None, None, "quiet", "dynamics, weights and feedforward")
    add("100", "measuring", "20123", "motion", "measuring run")
    add("106", None, None, "motion", "measuring run goes on to its target")
    add("107 108 310", "measuring", "20123", "refused", "measuring run")
    add("101 102", "measuring", "20123", "offset", "measured offset")
    add("150", "spline", None, "quiet", "spline off")
    add("151", "spline", None, "modal", "spline")
    add("161 162", "centre", "20127", "modal", "circle centre absolute or relative")
    add("163", "radius value", None, "modal", "radius programming")
    add("164 165", "correction", "20128", "modal", "circle centre correction")
    add("200 201", "manual", "20129", "motion", "manual mode")
    add("202", "manual", "20129", "motion", "manual mode off")
    add("66", None, None, "quiet", "cycle synchronisation")
    # fmt: on
    return table


GFUNCTIONS = _rows()

WEIGHTED = frozenset(
    n for n, g in GFUNCTIONS.items() if g.purpose == "dynamics, weights and feedforward"
)
"""Functions whose axis words are weights or factors, not positions."""
