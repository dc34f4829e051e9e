"""How much of one set of lines is covered by another."""

from dataclasses import replace

import numpy as np

from hlr.compare.matching.match import Rule, divided_by, partners
from hlr.compare.reading.sides import side_of
from support.drawings import drawing, line

RULE = Rule(0.1, 0.1)


def pieces(*points, point_at=None):
    """Of one line; with `point_at` a piece without a length stands at the end of this one."""
    found = side_of(drawing([line(points)]), 0.1).pieces
    if point_at is None:
        return found
    found = found.take(np.sort(np.append(np.arange(len(found)), point_at)))
    start = found.start.copy()
    start[point_at + 1] = found.end[point_at + 1]
    return replace(found, start=start)


def test_pieces_without_a_length_cover_nothing_and_lack_nothing():
    """Lines that are cut twice at one place have such pieces."""
    one, other = pieces((0, 0), (5, 0), (10, 0), point_at=0), pieces((0, 0.01), (6, 0.01), (10, 0.01), point_at=1)
    assert 0.0 in one.lengths and 0.0 in other.lengths
    with np.errstate(all="raise"):
        for a, b in ((one, other), (other, one)):
            both, bare = divided_by(a, b, RULE)
            assert not len(bare) and both.lengths.sum() == 10.0
            assert (partners(a, b, RULE)[0] >= 0).tolist() == (a.lengths > 0.0).tolist()
