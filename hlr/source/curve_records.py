"""The curves of B-rep edges as flat records that the kernel evaluates without OpenCASCADE.

All curves are affine forms, so that a placement, a mirror image or a scale moves their vectors and nothing else:

    LINE        p + t a                        p, a, 0
    ELLIPSE     p + cos t a + sin t b          p, a, b; circles as well
    PARABOLA    p + t^2 a + t b                p, a, b
    HYPERBOLA   p + cosh t a + sinh t b        p, a, b
    SPLINE      B-spline                       degree, poles, rational, flat knots, then x y z w per pole;
                                               rational 2: places of another curve, which it follows closely

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
    """(n+1,) running sums from 0: where each of n consecutive groups begins."""
    result = np.zeros(len(counts) + 1, dtype=np.int64)
    np.cumsum(counts, out=result[1:])
    if result[-1] >= 2**31:
        raise MemoryError("more than 2^31 items in one table")
    return result.astype(np.int32)


def pack_curves(records: Sequence[Record]) -> Curves:
    """Records of single curves as one."""
    return Curves(
        kind=np.array([r[0] for r in records], np.uint8),
        range=np.array([(r[1], r[2]) for r in records], np.float64).reshape(-1, 2),
        offsets=offsets_of([len(r[3]) for r in records]),
        values=np.concatenate([np.zeros(0), *[r[3] for r in records]]),
    )


def concatenate_curves(one: Curves, other: Curves) -> Curves:
    """The records of one, then those of the other."""
    return Curves(
        kind=np.concatenate([one.kind, other.kind]),
        range=np.concatenate([one.range, other.range]),
        offsets=np.concatenate([one.offsets, other.offsets[1:] + one.offsets[-1]]).astype(np.int32),
        values=np.concatenate([one.values, other.values]),
    )
