"""What V.A reads of the axes as they are configured, and V.G of the running program.

Source: TF5200 programming manual, variables.
"""

from __future__ import annotations

from collections.abc import Callable

from ncscope.channel.draft import Draft
from ncscope.channel.rows import Reference, Row, axis_rows

# --- axes --------------------------------------------------------------------------------------


def limit(side: int) -> Callable[[Draft, Reference], float]:
    """A software limit of the axis list; fails where none is configured."""

    def read(draft: Draft, ref: Reference) -> float:
        limits = draft.state.axes[ref.axis].limits
        if limits is None:
            name = draft.state.axis_names[ref.axis]
            draft.fail("20097", ref.span, f"no software limits are configured for axis {name}")
        return draft.shown(ref.axis, limits[side])

    return read


def reference(draft: Draft, ref: Reference) -> float:
    """Reference position of an axis in units of the program. Source: P-AXIS-00152."""
    return draft.shown(ref.axis, draft.state.axes[ref.axis].reference)


def axis_mode(draft: Draft, ref: Reference) -> float:
    """4 for a modulo axis, else 1."""
    return 1.0 if draft.state.axes[ref.axis].modulo_range is None else 4.0


def modulo_value(draft: Draft, ref: Reference) -> float:
    """Degrees of one turn of a modulo axis, 0 for any other."""
    limits = draft.state.axes[ref.axis].modulo_range
    return 0.0 if limits is None else limits[1] - limits[0]


# --- the program -------------------------------------------------------------------------------


def _is_given(draft: Draft, ref: Reference) -> float:
    held = draft.state.running.parameters
    if held is None:
        draft.fail("21544", ref.span, f"{ref.text} has a meaning in cycles only")
    return float(ref.numbers[0] in held)


def _unlike(why: str) -> Callable[[Draft, Reference], float]:
    """A variable that a control has, and that is another one in every run."""

    def read(draft: Draft, ref: Reference) -> float:
        draft.refuse(ref.span, f"{ref.text} ({why})")

    return read


def _program_name(draft: Draft, ref: Reference) -> str:
    return draft.state.running.file.rpartition("/")[2]


PROGRAM_ROWS: dict[str, Row] = {
    "V.G.@P[].VALID": Row(_is_given, None, "1 where the call of the cycle gave @P"),
    "V.G.TIMER": Row(_unlike("the clock of the control"), None, "refused: a clock"),
    "V.G.TIMER[]": Row(_unlike("the clock of the control"), None, "refused: a clock"),
    "V.G.RANDOM": Row(_unlike("another value at each run"), None, "refused: a random number"),
    "V.G.PROG_LEVEL": Row(
        lambda d, r: float(d.state.running.level), None, "depth of calls, 0 in the main program"
    ),
    "V.G.PROG_NAME": Row(_program_name, None, "name of the running program"),
    "V.G.FILE_NAME": Row(lambda d, r: d.state.running.file, None, "file of the running program"),
    "V.G.CS_ACTIVE": Row(
        lambda d, r: float(len(d.state.coordinates.levels) > 1),
        None,
        "1 while a coordinate system is active",
    ),
    "V.G.CS_COUNT": Row(
        lambda d, r: float(len(d.state.coordinates.levels) - 1),
        None,
        "number of active coordinate systems",
    ),
    **axis_rows("V.A.-SWE", Row(limit(0), None, "negative software limit")),
    **axis_rows("V.A.+SWE", Row(limit(1), None, "positive software limit")),
    **axis_rows("V.A.-SWE_MDS", Row(limit(0), None, "negative software limit of the list")),
    **axis_rows("V.A.+SWE_MDS", Row(limit(1), None, "positive software limit of the list")),
    **axis_rows("V.A.REF", Row(reference, None, "reference position")),
    **axis_rows("V.A.MODE", Row(axis_mode, None, "1 linear, 4 modulo")),
    **axis_rows("V.A.MODULO_VALUE", Row(modulo_value, None, "size of the modulo range")),
}
"""Rows of the variable table."""
