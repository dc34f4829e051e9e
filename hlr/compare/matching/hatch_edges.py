"""Whether an edge lies between two places of a section: then they may belong to two hatched areas."""

from __future__ import annotations

import numpy as np

from hlr.compare.lines.pieces import Array, Floats, Index, Pieces
from hlr.compare.matching.hatch_lines import hatches_of
from hlr.compare.matching.near import pairs


def edges_of(pieces: Pieces) -> Pieces:
    """The visible lines of a drawing, but for hatches."""
    return pieces.take(~hatches_of(pieces) & (pieces.visible != 0))


def divided_by_edges(start: Floats, end: Floats, edges: Pieces, slack_mm: float) -> Array:
    """(n,) whether an edge crosses the way from each start (n, 2) to its end (n, 2).

    slack_mm: edges reach so much farther at both ends, since files round
    """
    crossed = np.zeros(len(start), bool)
    if not len(start) or not len(edges):
        return crossed
    ways = _as_pieces(start, end)
    beside = _within(edges, np.minimum(start, end).min(axis=0), np.maximum(start, end).max(axis=0), slack_mm)
    short = beside.divided(float(ways.lengths.max()) + slack_mm)
    for way, edge in pairs(ways, short, slack_mm):
        crossed[way[_cross(ways, short, way, edge, slack_mm)]] = True
    return crossed


def _cross(ways: Pieces, edges: Pieces, i: Index, j: Index, slack_mm: float) -> Array:
    """(n,) whether the way of each pair crosses its edge."""
    d, e, off = (ways.end - ways.start)[i], (edges.end - edges.start)[j], edges.start[j] - ways.start[i]
    long = np.hypot(*e.T)
    turn = d[:, 0] * e[:, 1] - d[:, 1] * e[:, 0]
    some = turn != 0.0
    safe = np.where(some, turn, 1.0)
    along_way = (off[:, 0] * e[:, 1] - off[:, 1] * e[:, 0]) / safe
    along_edge = (off[:, 0] * d[:, 1] - off[:, 1] * d[:, 0]) / safe * long
    on_way = (along_way >= 0.0) & (along_way <= 1.0)
    return np.asarray(some & on_way & (along_edge >= -slack_mm) & (along_edge <= long + slack_mm))


def _within(edges: Pieces, low: Floats, high: Floats, slack_mm: float) -> Pieces:
    """The edges that may reach into a rectangle."""
    above = np.maximum(edges.start, edges.end) >= low - slack_mm
    below = np.minimum(edges.start, edges.end) <= high + slack_mm
    return edges.take(np.asarray((above & below).all(axis=1)))


def _as_pieces(start: Floats, end: Floats) -> Pieces:
    """Each way as a line, without class and part."""
    unknown = np.full(len(start), -1)
    traits = unknown, unknown, unknown, unknown, unknown, np.zeros(len(start), np.int64)
    return Pieces(start, end, end - start, np.arange(len(start)), *traits)
