"""A line that in the image lies exactly on the border of a face: is it beside the face, before it or behind it?

A rule that moves the line to one side answers differently for left and right borders, so a part and its mirror image
are drawn differently. Behind, it counts as visible, for the eye sees it beside the border; it is there once.
"""

from __future__ import annotations

import numpy as np
import pytest

import hlr
from support.at_size import AT_SIZE
from support.expected import agrees, expect
from support.meshes import as_parts, face, merged, moved

MIRRORS = [np.diag([x, y, 1.0]) for x in (1, -1) for y in (1, -1)]
TURNS = [np.eye(3), np.array([[0.8, -0.6, 0], [0.6, 0.8, 0], [0, 0, 1]])]
"""The second one turns by 3 : 4 : 5: collinear still, but not to the last bit."""

SCREEN = [(-10, -10, 0), (10, -10, 0), (10, 10, 0), (-10, 10, 0)]


def sides(corners):
    return [(corners[i], corners[i - 1]) for i in range(len(corners))]


@pytest.mark.slow
@pytest.mark.parametrize("how", [merged, as_parts])
@pytest.mark.parametrize("mirror", MIRRORS)
@pytest.mark.parametrize("turn", TURNS)
@pytest.mark.parametrize("depth", [-7.0, 7.0])
@pytest.mark.parametrize("reach", [-1, 1])
def test_a_face_whose_side_lies_on_the_border_of_another(picture, how, mirror, turn, depth, reach):
    # The other face shares the border x = 10 in the image, longer at one end, shorter at the other; it reaches to the
    # inside of the screen (-1) or away from it.
    other = [(10, -15, depth), (10, 5, depth), (10 + 6 * reach, 5, depth), (10 + 6 * reach, -15, depth)]
    m = turn @ mirror
    model = how(*(moved(face(*c), lambda p: p @ m.T) for c in (SCREEN, other)))
    drawing = hlr.draw(model, "top", **AT_SIZE)
    at = lambda *lines: [tuple(m @ p for p in line) for line in lines]  # noqa: E731
    inner, outer = 10 + 6 * reach, 10
    if reach == 1:
        agrees(drawing, expect(drawing, at(*sides(SCREEN), *sides(other))))
    elif depth > 0:
        # In front: it covers the screen's border at y = -10 between its own sides.
        lower = [((-10, -10, 0), (inner, -10, 0))]
        unseen = [((inner, -10, 0), (outer, -10, 0))]
        rest = [s for s in sides(SCREEN) if not (s[0][1] == s[1][1] == -10)]
        agrees(drawing, expect(drawing, at(*rest, *lower, *sides(other)), at(*unseen)))
    else:
        seen = [((inner, -15, depth), (outer, -15, depth)), ((outer, -15, depth), (outer, -10, depth))]
        seen += [((inner, -15, depth), (inner, -10, depth))]
        unseen = [((inner, -10, depth), (inner, 5, depth)), ((inner, 5, depth), (outer, 5, depth))]
        agrees(drawing, expect(drawing, at(*sides(SCREEN), *seen), at(*unseen)))
        if m is TURNS[0] @ MIRRORS[0] or (how is merged and np.array_equal(m, np.eye(3))):
            picture(drawing)


@pytest.mark.parametrize("mirror", MIRRORS)
def test_between_two_screens_that_meet_in_the_image_nothing_is_seen(mirror):
    # Left and right of x = 0, at different depths: the line behind lies on both borders at once, and is drawn visible,
    # for it lies on the visible border of a screen; the border itself is there once.
    left = [(-10, -10, 5), (0, -10, 5), (0, 10, 5), (-10, 10, 5)]
    right = [(0, -10, 0), (10, -10, 0), (10, 10, 0), (0, 10, 0)]
    behind = [(0, -5, -5), (0, 5, -5), (4, 0, -5)]
    drawing = hlr.draw(
        merged(*(moved(face(*c), lambda p: p @ mirror) for c in (left, right, behind))), "top", **AT_SIZE
    )
    seen, unseen = [*sides(left), *sides(right)], [s for s in sides(behind) if s[0][0] or s[1][0]]
    flip = lambda lines: [tuple(mirror @ p for p in line) for line in lines]  # noqa: E731
    agrees(drawing, expect(drawing, flip(seen), flip(unseen)))
