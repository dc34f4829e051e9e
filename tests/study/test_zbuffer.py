"""Hidden lines by a z-buffer, on shapes whose lines are known."""

import numpy as np
import pytest

from hlr.lab.study.watch import Watch
from hlr.lab.study.zbuffer import hidden_lines
from hlr.pipeline.session import Session
from hlr.request.options import Options
from support.at_size import AT_SIZE

CORNERS = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)], float)
QUADS = ((0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3))


def boxes(*places):
    """(vertices, faces) of boxes given by their lower corner and size."""
    points = np.concatenate([np.asarray(low) + CORNERS * np.asarray(size) for low, size in places])
    faces = [
        [8 * i + q[k] for k in corners] for i in range(len(places)) for q in QUADS for corners in ((0, 1, 2), (0, 2, 3))
    ]
    return points, np.array(faces)


def drawn(model, view, pixels):
    options = Options(accuracy=0.01, **AT_SIZE)
    session = Session(model, [view], options)
    draft = session.drafts()[0]
    return hidden_lines(draft.image, session.plan(draft, draft.image).visibility_input.role, pixels, Watch())


def length(ink, visible):
    pieces = ink.segments(ink.visible == visible)
    return np.hypot(pieces[:, 2] - pieces[:, 0], pieces[:, 3] - pieces[:, 1]).sum()


@pytest.mark.parametrize("pixels", [64, 500, 2048])
def test_a_box_shows_nine_edges_and_hides_three(pixels):
    ink = drawn(boxes(((0, 0, 0), (10, 10, 10))), "iso", pixels)
    edge = 10 * np.sqrt(2 / 3)
    pixel = 20 / pixels
    # What is uncertain is a sample or two where a hidden edge comes out at a corner.
    assert length(ink, True) == pytest.approx(9 * edge, abs=12 * pixel)
    assert length(ink, False) == pytest.approx(3 * edge, abs=12 * pixel)
    assert length(ink, True) + length(ink, False) == pytest.approx(12 * edge)


@pytest.mark.parametrize("pixels", [200, 1600])
def test_an_edge_ends_behind_a_box_within_a_pixel(pixels):
    # From the front (seen along y), a lath behind a box: its upper edge is hidden from x = 4 to 6.
    ink = drawn(boxes(((4, 0, 0), (2, 1, 10)), ((0, 5, 5), (10, 1, 1))), "front", pixels)
    at_top = [
        ink.points[a:b]
        for a, b, v in zip(ink.offsets, ink.offsets[1:], ink.visible, strict=False)
        if v and (abs(ink.points[a:b, 1] - 6) < 1e-9).all()
    ]
    ends = sorted({round(float(x), 6) for points in at_top for x in points[:, 0]})
    pixel = 10 / pixels
    assert ends[0] == 0 and ends[-1] == 10
    assert any(abs(x - 4) <= pixel for x in ends) and any(abs(x - 6) <= pixel for x in ends)
    assert not any(4 + pixel < x < 6 - pixel for x in ends)


@pytest.mark.slow
def test_detail_below_a_pixel_is_not_seen():
    # A post of 0.02 before the lath's edge: 64 pixels do not know it, 8192 do.
    model = boxes(((5, 0, 0), (0.02, 1, 10)), ((0, 5, 5), (10, 1, 1)))
    coarse, fine = (length(drawn(model, "front", pixels), False) for pixels in (64, 8192))
    exactly = 0.02 * 2 + 10 * 2 + 2 + 0.02 * 2
    assert fine > 20 and abs(fine - exactly) < abs(coarse - exactly) + 0.5
