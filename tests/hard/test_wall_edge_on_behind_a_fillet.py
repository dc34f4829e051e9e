"""A post on a flange, filleted at its root and rounded at its end, seen from the flange.

The side of the post is seen edge-on. Fillet, side and rounded end are all turned away: the surface comes toward the
viewer by steps, and nowhere turns over. The post has a circle in the image all the same, behind the flange: seen from
its end, that circle is visible. It was missing. Seen on parts of the NIST, whose lines of a hundred millimetres were.
"""

from __future__ import annotations

import cadquery as cq
import numpy as np
import pytest

import hlr
from support.at_size import AT_SIZE

FLANGE, THICK, POST, HIGH, ROOT, END = 20.0, 5.0, 8.0, 20.0, 2.0, 1.0
ACCURACY = 0.02
ALONG, FROM_BELOW = (0, 0, 1), (0, 0, -1)


def filleted(post):
    """A post on its flange."""
    part = cq.Workplane().circle(FLANGE).extrude(THICK).union(post.translate((0, 0, THICK)))
    root = cq.selectors.BoxSelector((-12, -12, THICK - 0.1), (12, 12, THICK + 0.1))
    return part.edges(root).fillet(ROOT).faces(">Z").edges().fillet(END)


def ways(drawing, visible):
    """Model coordinates along and across of the points of lines, line by line."""
    return [np.asarray(line.points3)[:, :2] for line in drawing.lines if line.visible == visible]


def test_the_circle_of_the_post_is_hidden_behind_the_flange(picture):
    part = filleted(cq.Workplane().circle(POST).extrude(HIGH))
    drawing = hlr.draw(part, FROM_BELOW, accuracy=ACCURACY, **AT_SIZE)
    assert [radii(way) for way in ways(drawing, True)] == [pytest.approx((FLANGE, FLANGE), abs=ACCURACY)]
    (hidden,) = ways(drawing, False)
    assert radii(hidden) == pytest.approx((POST, POST), abs=ACCURACY)
    assert np.array_equal(hidden[0], hidden[-1])
    picture(drawing)


def test_it_is_visible_from_the_end():
    """From there the rounded end is the nearer border of the side: one circle, and not a second one of the fillet."""
    part = filleted(cq.Workplane().circle(POST).extrude(HIGH))
    drawing = hlr.draw(part, ALONG, accuracy=ACCURACY, **AT_SIZE)
    found = sorted(radii(way) for way in ways(drawing, True))
    assert found == [pytest.approx((r, r), abs=ACCURACY) for r in (POST, FLANGE)]
    assert ways(drawing, False) == []


def test_a_square_post_has_four_sides_and_four_corners():
    """Planes and quarters of cylinders, whose outlines meet end to end."""
    square = cq.Workplane().rect(2 * POST, 2 * POST).extrude(HIGH).edges("|Z").fillet(3.0)
    drawing = hlr.draw(filleted(square), FROM_BELOW, accuracy=ACCURACY, **AT_SIZE)
    hidden = ways(drawing, False)
    round_it = 8 * (POST - 3.0) + 2 * np.pi * 3.0
    assert sum(long(way) for way in hidden) == pytest.approx(round_it, abs=0.02 * round_it)
    assert np.abs(np.concatenate(hidden)).max() == pytest.approx(POST, abs=ACCURACY)
    ends = np.concatenate([way[[0, -1]] for way in hidden])
    apart = np.linalg.norm(ends[:, None] - ends[None], axis=2) + 9.0 * np.eye(len(ends))
    assert apart.min(axis=1).max() < ACCURACY


@pytest.mark.parametrize("wall, count", [("cone", 1), ("cylinder", 0)])
def test_in_perspective_a_cone_around_the_eye_is_such_a_wall(wall, count):
    """The side of a post that widens with the distance is seen edge-on; that of a cylinder is turned away."""
    eye = 80.0
    wider = POST * (1.0 + HIGH / (eye + THICK)) if wall == "cone" else POST
    post = cq.Workplane(cq.Solid.makeCone(POST, wider, HIGH) if wall == "cone" else cq.Solid.makeCylinder(POST, HIGH))
    looking = hlr.Perspective(eye=(0, 0, -eye), target=(0, 0, 0))
    drawing = hlr.draw(filleted(post), perspective=looking, accuracy=ACCURACY, **AT_SIZE)
    assert len(ways(drawing, False)) == count
    for way in ways(drawing, False):
        far = np.hypot(*way.T)
        assert np.ptp(far) < ACCURACY and POST < far.min() < far.max() < wider


def radii(way):
    far = np.hypot(*way.T)
    return far.min(), far.max()


def long(way):
    return float(np.linalg.norm(np.diff(way, axis=0), axis=1).sum())
