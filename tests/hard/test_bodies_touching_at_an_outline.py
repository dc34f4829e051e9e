"""Rollers side by side: each touches the other along its own outline, which nothing hides.

An outline is moved off its face before visibility is decided. Here that is into the other roller, however short the
way.
"""

from __future__ import annotations

import math

import cadquery as cq
import pytest

import hlr

RADIUS, LENGTH = 5.0, 20.0
FRONT = (0.0, -1.0, 0.0)


def roller(x, y=0.0, radius=RADIUS, turned=0.0, foot=0.0, length=LENGTH):
    """Upright; `turned` in degrees is where its seam, and so its mesh, begins."""
    return cq.Workplane().circle(radius).extrude(length).rotate((0, 0, 0), (0, 0, 1), turned).translate((x, y, foot))


def outlines(bodies, view=FRONT, **options):
    """Outlines between the middles of the first and the last body: whether visible, and heights of both ends."""
    drawing = hlr.draw([body.val() for body in bodies], view, **({"hidden": True, "scale": 1.0} | options))
    first, last = 1.0, 2.0 * RADIUS + 4.0
    found = [line for line in drawing.lines if line.kind == "outline" and first < line.points[0][0] < last]
    return [(line.visible, *sorted(round(float(p[1]), 2) for p in (line.points[0], line.points[-1]))) for line in found]


@pytest.mark.parametrize("turned", (0.0, 1.0, 13.0, 45.0, 90.0))
@pytest.mark.parametrize("both", (False, True))
def test_the_line_between_two_rollers_is_seen(turned, both):
    pair = [roller(0.0, turned=turned), roller(10.0, turned=turned if both else 0.0)]
    assert outlines(pair) == [(True, 0.0, LENGTH)]
    assert outlines(pair, hidden=False) == [(True, 0.0, LENGTH)]


@pytest.mark.parametrize("accuracy", (0.2, 0.05, 0.002))
@pytest.mark.parametrize("apart", (0.0, 1e-6, -1e-6, 1e-4))
def test_it_is_seen_at_any_accuracy_and_if_numbers_are_rounded(apart, accuracy):
    assert outlines([roller(0.0), roller(10.0 + apart)], accuracy=accuracy) == [(True, 0.0, LENGTH)]


@pytest.mark.parametrize("size", (0.01, 1000.0))
def test_it_is_seen_on_small_and_large_rollers(size):
    pair = [cq.Workplane(body.val().scale(size)) for body in (roller(0.0), roller(10.0))]
    assert outlines(pair, scale=1.0 / size) == [(True, 0.0, LENGTH)]


def test_a_thinner_and_shorter_roller():
    assert outlines([roller(0.0), roller(8.0, radius=3.0, foot=4.0, length=12.0)]) == [(True, 0.0, LENGTH)]


@pytest.mark.parametrize("degrees", (10.0, 33.0, 120.0))
def test_from_any_direction_square_to_the_line_of_centres(degrees):
    a = math.radians(degrees)
    pair = [roller(0.0), roller(10.0 * math.cos(a), 10.0 * math.sin(a))]
    assert outlines(pair, (math.sin(a), -math.cos(a), 0.0)) == [(True, 0.0, LENGTH)]


def test_what_is_before_it_hides_it():
    bar = cq.Workplane().box(30, 2, 6).translate((5, -8, 10))
    # The bar begins 5 mm to the left of the rollers, and both are drawn from the lower left corner on.
    found = outlines([roller(0.0), roller(10.0), bar])
    assert sorted(found) == [(False, 7.0, 13.0), (True, 0.0, 7.0), (True, 13.0, LENGTH)]


def test_a_roller_that_stands_in_the_other_has_its_outline_inside_it():
    found = outlines([roller(0.0), roller(9.0)])
    assert found and not any(visible for visible, *_ in found)


def test_a_roller_before_the_other_hides_its_outlines():
    behind = outlines([roller(0.0), roller(2.0, 10.0)])
    assert (False, 0.0, LENGTH) in behind


def test_three_in_a_row():
    row = [roller(10.0 * k) for k in range(3)]
    drawing = hlr.draw([body.val() for body in row], FRONT, hidden=True, scale=1.0)
    found = sorted(round(float(line.points[0][0]), 3) for line in drawing.lines if line.kind == "outline")
    assert found == [0.0, 10.0, 20.0, 30.0]
    assert all(line.visible for line in drawing.lines)


def lid(behind, from_height=-100.0):
    """A wide plate, and how far its near side is behind the middles of the rollers; no diagonal of it crosses them."""
    return cq.Workplane("XY").box(200.0, 2.0, 200.0).translate((45.0, behind + 1.0, from_height + 100.0))


def looked_at(bodies, view=FRONT):
    """The line between the rollers: whether visible, heights of both ends; and how many edges were compared anew."""
    drawing = hlr.draw([body.val() for body in bodies], view, hidden=True, scale=1.0)
    between = [line for line in drawing.lines if abs(line.points3[:, :2] - (RADIUS, 0.0)).max() < 0.1]
    found = [(line.visible, *sorted(round(float(z), 2) for z in line.points3[[0, -1], 2])) for line in between]
    return sorted(found), drawing.counters["freed_of_own_faces"]


@pytest.mark.parametrize("view", (FRONT, (0.0, -1.0, 0.1), (0.0, -1.0, -0.3)))
def test_what_a_lid_hides_from_farther_away_than_a_contact_is_not_compared_once_more(view):
    """Seen obliquely, the far corners of the lid lie behind the rollers."""
    pair = [roller(0.0), roller(10.0)]
    seen, compared = looked_at(pair, view)
    assert seen == [(True, 0.0, LENGTH)]
    for behind in (-22.0, -7.0):
        found, again = looked_at([*pair, lid(behind)], view)
        assert found == [(False, 0.0, LENGTH)] and again < compared
    assert looked_at([*pair, lid(20.0)], view) == (seen, compared)


@pytest.mark.parametrize("height", (0.5, 10.0, 19.5))
@pytest.mark.parametrize("behind", (-22.0, -7.0))
def test_a_lid_over_a_part_of_the_line(height, behind):
    found, _ = looked_at([roller(0.0), roller(10.0), lid(behind, height)])
    assert found == [(False, height, LENGTH), (True, 0.0, height)]
