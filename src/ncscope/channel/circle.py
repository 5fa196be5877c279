"""G02 and G03: from end point, centre or radius to an arc; G161 to G165 say what the words mean.

An arc is written in programmed values. Coordinate systems, scale and mirror act on its points as
on any others, so a mirror turns its sense without a rule of its own.
Source: TF5200 programming manual, circular and helical interpolation, radius programming, G161 to
G165; P-CHAN-00059, P-CHAN-00060, P-CHAN-00171, P-CHAN-00172.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from ncscope.channel.draft import Draft
from ncscope.compilation import compiled
from ncscope.diagnostics import Span
from ncscope.frames import Array
from ncscope.motion.arc import (
    SAME_POINT,
    Arc,
    Point,
    centre_of_radius,
    distance,
    fitting_centre,
)

if TYPE_CHECKING:
    from ncscope.channel.words import Words
    from ncscope.machine import ChannelSettings

CIRCULAR = ("G02", "G03")
CENTRE_LETTERS = "IJK"
"""The centre word of the channel axes 0, 1 and 2."""
LARGEST = 1e150
"""mm from which an arc cannot be computed."""
GOOD, TOO_LARGE, AT_START, SHIFTED, SHIFTED_TOO_FAR, RADII_DIFFER, FULL_CIRCLE, TOO_FAR_APART = (
    range(8)
)
"""What is to be said of an arc."""
Word = tuple[float, Span]


@dataclass(frozen=True, slots=True)
class _Circle:
    """A circular block: plane axes, end points in the plane, and its words."""

    axes: tuple[int, int]
    start: Point
    end: Point
    clockwise: bool
    span: Span


def modes(draft: Draft, words: Words) -> None:
    """G161, G162: centre absolute or from the start point. G164, G165: centre correction off, on.
    G163=50, and R in circular motion: the radius of this and the following arcs."""
    for number, word in words.gfunctions.items():
        if number in (161, 162):
            draft.modal(centre_absolute=number == 161)
        elif number in (164, 165):
            draft.modal(centre_fits=number == 165)
        elif number == 163:
            _stored_radius(draft, words, word.span)
    if draft.modes.motion in CIRCULAR and "R" in words.addresses:
        _store(draft, words.addresses["R"])


def _stored_radius(draft: Draft, words: Words, span: Span) -> None:
    if 163 in words.values:
        _store(draft, (words.values[163], span))
    elif "R" in words.addresses:
        _store(draft, words.addresses["R"])
        if draft.modes.motion not in CIRCULAR:
            del words.addresses["R"]
    elif draft.modes.radius is None:
        draft.fail("20147", span, "G163 needs the radius", "write for example G163=50")


def _store(draft: Draft, word: Word) -> None:
    value, span = word
    if value == 0.0:
        draft.fail("20036", span, "the radius of an arc cannot be 0")
    draft.modal(radius=value * draft.modes.length_factor)


def centre_words(draft: Draft, words: Words) -> dict[int, Word]:
    """The words I, J, K by channel axis; taken out of the block."""
    return {
        axis: words.addresses.pop(letter)
        for axis, letter in enumerate(CENTRE_LETTERS)
        if letter in words.addresses
    }


def arc(draft: Draft, words: Words, centre: dict[int, Word], target: Array, span: Span) -> Arc:
    """The arc of a circular block from the present position to `target` (n,), programmed values.

    Fails where centre, radius and end point describe no arc.
    """
    if draft.state.coordinates.point_to_point:
        what = "arcs are not allowed while #PTP is active"
        draft.fail("21530", span, what, "write #PTP OFF before the arc, or G00 or G01")
    circle = _circle(draft, target, span)
    radius_word = words.addresses.pop("R", None)
    pitch = _outside_plane(draft, words, centre, circle)
    if centre and radius_word is not None:
        what = "an arc has a centre (I, J, K) or a radius (R), not both"
        draft.fail("21024", radius_word[1], what)
    if centre:
        draft.modal(radius=None)
        found = _about_centre(draft, circle, centre)
    else:
        found = _with_radius(draft, circle, radius_word[1] if radius_word else span)
    if pitch is not None:
        found = _with_turns(draft, found, pitch, words, target)
    memory = remembered(found, circle.start, draft.modes.centre_absolute)
    draft.state = draft.state.changed(circle=memory)
    return found


def _circle(draft: Draft, target: Array, span: Span) -> _Circle:
    state = draft.state
    first, second, _ = state.main_axes
    if max(first, second) >= len(state.axes):
        has = " ".join(state.axis_names)
        draft.fail("20010", span, f"the plane of the arc needs two axes; the channel has {has}")
    scale = state.coordinates.contour.scale
    if scale.get(first, 1.0) != scale.get(second, 1.0):
        what = "an arc needs the same scale factor (#SCALE) for both axes of its plane"
        draft.fail("N2020", span, what)
    start = state.position.program
    points = [(float(p[first]), float(p[second])) for p in (start, target)]
    if not all(abs(v) < LARGEST for point in points for v in point):
        draft.fail("21883", span, "the arc is too large to be computed")
    return _Circle((first, second), points[0], points[1], state.modal.motion == "G02", span)


def _outside_plane(
    draft: Draft, words: Words, centre: dict[int, Word], circle: _Circle
) -> Word | None:
    """The word of the third axis: the pitch of a helix, an error without a motion of this axis."""
    third = draft.state.main_axes[2]
    word = centre.pop(third, None)
    if word is not None and third not in words.axes:
        letter, plane = CENTRE_LETTERS[third], draft.modes.plane
        own = " and ".join(CENTRE_LETTERS[axis] for axis in circle.axes)
        hint = f"the centre is given with {own}; {letter} is the pitch of a helix"
        draft.fail("20961", word[1], f"{letter} is not in the plane of G{plane}", hint)
    return word


def _about_centre(draft: Draft, circle: _Circle, centre: dict[int, Word]) -> Arc:
    span = next(iter(centre.values()))[1]
    first, second = (
        (draft.length(axis, centre[axis][0]) if axis in centre else 0.0)
        + (0.0 if draft.modes.centre_absolute else at)
        for axis, at in zip(circle.axes, circle.start, strict=True)
    )
    given, fits = (first, second), draft.modes.centre_fits
    settings = draft.machine.settings
    verdict, *middle = about_centre(*circle.start, *circle.end, *given, fits, *limits_of(settings))
    found = Arc.through(
        circle.axes, circle.start, circle.end, (middle[0], middle[1]), circle.clockwise
    )
    _judge(draft, verdict, found, given, span)
    return found


def _judge(draft: Draft, verdict: int, found: Arc, given: Point, span: Span) -> None:
    """Says what is wrong with an arc about the given centre."""
    settings, radius = draft.machine.settings, found.start_radius
    if verdict == TOO_LARGE:
        draft.fail("21883", span, "the arc is too large to be computed")
    if verdict == AT_START:
        hint = "with G161 the centre is absolute, with G162 it counts from the start point"
        draft.fail("20036", span, "the centre of the arc is its start point", hint)
    if verdict == RADII_DIFFER:
        what = f"start radius {radius:.4f} mm, end radius {found.end_radius:.4f} mm"
        hint = "give the centre more exactly, or let G165 correct it"
        draft.fail("21758", span, f"the radii of the arc differ too much: {what}", hint)
    moved = f"{math.dist(given, found.centre):.4f} mm"
    what = f"the centre is {moved} from one that fits start and end (radius {radius:.4f} mm)"
    hint = f"limits: {settings.centre_shift:g} mm and {settings.centre_shift_share:.1%} of radius"
    if verdict == SHIFTED_TOO_FAR:
        draft.fail("20035", span, what, hint)
    if verdict == SHIFTED:
        draft.warn("N2030", span, what, hint)


def limits_of(settings: ChannelSettings) -> tuple[float, float, float, float]:
    """How far a centre may be off, and by how much the radii may differ with G164: mm, and parts
    of the radius (P-CHAN-00059, P-CHAN-00060, P-CHAN-00171, P-CHAN-00172)."""
    shift = settings.centre_shift, settings.centre_shift_share
    return *shift, settings.radius_difference, settings.radius_difference_share


@compiled
def about_centre(x0, y0, x1, y1, cx, cy, fits, shift, shift_share, difference, difference_share):
    """What is to be said of an arc about a centre, and the centre that counts.

    G165 (fits): the centre is moved so that start and end lie on one circle, within two limits.
    G164: it stays, and start and end radius may differ within two limits.
    """
    if not (abs(cx) < LARGEST and abs(cy) < LARGEST):
        return TOO_LARGE, cx, cy
    first = distance(x0, y0, cx, cy)
    if first < SAME_POINT:
        return AT_START, cx, cy
    if not fits:
        apart = abs(distance(x1, y1, cx, cy) - first)
        good = apart <= max(difference, difference_share * first, SAME_POINT)
        return GOOD if good else RADII_DIFFER, cx, cy
    mx, my = fitting_centre(x0, y0, x1, y1, cx, cy)
    moved, radius = distance(cx, cy, mx, my), distance(x0, y0, mx, my)
    far, wide = moved > shift, moved > shift_share * radius
    if (far and wide) or radius < SAME_POINT:
        return SHIFTED_TOO_FAR, mx, my
    return SHIFTED if far or wide else GOOD, mx, my


@compiled
def with_radius(x0, y0, x1, y1, radius, clockwise):
    """What is to be said of an arc with a radius, and its centre."""
    if distance(x0, y0, x1, y1) < SAME_POINT:
        return FULL_CIRCLE, 0.0, 0.0
    if not abs(radius) < LARGEST:
        return TOO_LARGE, 0.0, 0.0
    possible, cx, cy = centre_of_radius(x0, y0, x1, y1, radius, clockwise)
    return GOOD if possible else TOO_FAR_APART, cx, cy


def _with_radius(draft: Draft, circle: _Circle, span: Span) -> Arc:
    radius = draft.modes.radius
    if radius is None:
        hint = "write I and J (I and K, J and K) for the centre, or R for the radius"
        draft.fail("20036", circle.span, "the arc has no centre and no radius", hint)
    verdict, *centre = with_radius(*circle.start, *circle.end, radius, circle.clockwise)
    if verdict == FULL_CIRCLE:
        hint = "give the centre with I, J, K"
        draft.fail("20034", span, "a full circle cannot be given by its radius", hint)
    if verdict == TOO_LARGE:
        draft.fail("21883", span, "the arc is too large to be computed")
    if verdict == TOO_FAR_APART:
        chord = distance(*circle.start, *circle.end)
        what = f"start and end are {chord:.4f} mm apart, farther than twice the radius"
        draft.fail("20033", span, what, f"the radius has to be {chord / 2:.4f} mm or more")
    middle = centre[0], centre[1]
    return Arc.through(circle.axes, circle.start, circle.end, middle, circle.clockwise)


def _with_turns(draft: Draft, found: Arc, pitch: Word, words: Words, target: Array) -> Arc:
    """A helix of several turns: as many full turns as bring the pitch nearest to the given one."""
    third = draft.state.main_axes[2]
    per_turn = abs(draft.length(third, pitch[0]))
    if per_turn == 0.0:
        draft.fail("20036", pitch[1], "the pitch of a helix cannot be 0")
    way = abs(float(target[third] - draft.state.position.program[third]))
    turns = way / per_turn - abs(found.sweep_rad) / math.tau
    if turns > MOST_TURNS:
        draft.fail("21883", pitch[1], f"the helix has more than {MOST_TURNS} turns")
    more = max(0, round(turns)) * math.tau
    return replace(found, sweep_rad=found.sweep_rad + math.copysign(more, found.sweep_rad))


MOST_TURNS = 100_000


def remembered(found: Arc, start: Point, absolute: bool) -> tuple[float, float, float, float]:
    """V.G.I, V.G.J, V.G.K and V.G.R: the corrected centre, as the centre words count now."""
    values = [0.0, 0.0, 0.0, found.start_radius]
    for axis, middle, at in zip(found.axes, found.centre, start, strict=True):
        values[axis] = middle if absolute else middle - at
    return values[0], values[1], values[2], values[3]
