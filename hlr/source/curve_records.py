"""Records of curves: the flat arrays in which edges and fitted curves go to and from the kernel.

All curves are affine forms: a placement, a mirror image or a scale changes their vectors and nothing else.

    LINE        p + t a                        p, a, 0
    ELLIPSE     p + cos t a + sin t b          p, a, b; circles as well
    PARABOLA    p + t^2 a + t b                p, a, b
    HYPERBOLA   p + cosh t a + sinh t b        p, a, b
    SPLINE      B-spline                       degree, poles, rational, flat knots, then x y z w per pole;
                                               rational 2: an approximation of a curve of another kind

Bezier curves become B-splines, periodic B-splines are unrolled as far as the edge goes, offset curves are approximated.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from hlr.common.types import Floats, Ints
from hlr.source.model import Curves

NONE, LINE, ELLIPSE, PARABOLA, HYPERBOLA, SPLINE = range(6)


Record = tuple[int, float, float, Floats]
"""(kind, first, last, values) of one curve."""

UNKNOWN: Record = (NONE, 0.0, 0.0, np.zeros(0))


def offsets_of(counts: Ints | list[int]) -> Ints:
    """(n+1,) int32 running sums of counts, from 0: the offsets of n consecutive groups."""
    result = np.zeros(len(counts) + 1, dtype=np.int64)
    np.cumsum(counts, out=result[1:])
    if result[-1] >= 2**31:
        raise MemoryError("more than 2^31 items in one table")
    return result.astype(np.int32)


def pack_curves(records: Sequence[Record]) -> Curves:
    """Single records as one set of arrays."""
    return Curves(
        kind=np.array([r[0] for r in records], np.uint8),
        range=np.array([(r[1], r[2]) for r in records], np.float64).reshape(-1, 2),
        offsets=offsets_of([len(r[3]) for r in records]),
        values=np.concatenate([np.zeros(0), *[r[3] for r in records]]),
    )


def concatenate_curves(first: Curves, second: Curves) -> Curves:
    """The records of the first set, then those of the second."""
    if not len(first.kind):
        return second
    return Curves(
        kind=np.concatenate([first.kind, second.kind]),
        range=np.concatenate([first.range, second.range]),
        offsets=np.concatenate([first.offsets, second.offsets[1:] + first.offsets[-1]]).astype(np.int32),
        values=np.concatenate([first.values, second.values]),
    )
