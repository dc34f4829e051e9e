"""NaN and infinity in some corners: the triangles there are left out, the rest is drawn, and a note says so.

One NaN makes a bounding box NaN, and everything that is scaled by it.
"""

from __future__ import annotations

import numpy as np
import pytest

import hlr
from support.at_size import AT_SIZE
from support.expected import agrees, by_oracle, expect
from support.meshes import BOX_EDGES, as_parts, box, box_lines, merged

POINTS, TRIANGLES = box((-10, -10, -10), (10, 10, 10))
BAD = [np.nan, np.inf, -np.inf]


@pytest.mark.parametrize("bad", BAD)
@pytest.mark.parametrize("corner", range(8))
def test_the_triangles_at_a_bad_corner_are_left_out(picture, bad, corner):
    points = POINTS.copy()
    points[corner, corner % 3] = bad
    keep = TRIANGLES[[corner not in t for t in TRIANGLES]]
    drawing = hlr.draw((points, TRIANGLES), (2, -1, 1.5), **AT_SIZE)
    count = len(TRIANGLES) - len(keep)
    assert f"{count} triangles with coordinates that are no numbers were left out." in map(str, drawing.notes)
    # Where one half of a face is gone, its diagonal is a border.
    used = {tuple(sorted((t[i], t[i - 1]))) for t in keep.tolist() for i in range(3)}
    uses = [sum(set(e) <= set(t) for t in keep.tolist()) for e in used]
    edges = [e for e, n in zip(used, uses, strict=True) if n == 1 or e in BOX_EDGES]
    agrees(drawing, by_oracle(drawing, POINTS, keep, edges))
    if corner == 7 and bad == np.inf:
        picture(drawing)


@pytest.mark.parametrize("bad", BAD)
def test_a_part_with_nothing_left_does_not_spoil_the_others(bad):
    other = box((0, 0, 0), (1, 1, 1))
    other[0][:] = bad
    good = box((-5, -5, -5), (5, 5, 5))
    drawing = hlr.draw(as_parts(good, other), "front", **AT_SIZE)
    agrees(drawing, expect(drawing, [line for line in box_lines((-5, -5, -5), (5, -5, 5)) if line[0] is not line[1]]))
    assert any("no numbers" in note.text for note in drawing.notes)
    assert any("no triangles" in note.text for note in drawing.notes)


@pytest.mark.parametrize("bad", BAD)
def test_nothing_but_bad_corners_is_refused(bad):
    with pytest.raises(hlr.SourceError, match="no triangle whose coordinates are all numbers"):
        hlr.draw((np.full_like(POINTS, bad), TRIANGLES), **AT_SIZE)


def test_a_bad_corner_that_no_triangle_uses_is_not_worth_a_word():
    points = np.concatenate([POINTS, [(np.nan, 0, 0)]])
    drawing = hlr.draw((points, TRIANGLES), "iso", **AT_SIZE)
    assert drawing.notes == ()
    agrees(drawing, by_oracle(drawing, *merged((POINTS, TRIANGLES)), BOX_EDGES))
