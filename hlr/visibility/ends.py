"""Where an edge of the model turns behind its own curved face: at the end of that face's outline, not at a mesh node.

The kernel counts on the mesh, whose contour leaves an edge at a node; the true outline leaves it on a chord beside
that node. A change of visibility at the end of that very chord is the contour's: it moves to the outline, or a gap as
long as half a chord would be left between the two lines.

::

    kernel    visible      | hidden                 the edge's chords -----+-----+-----
    moved     visible |      hidden                 | node    x end of the outline
              ---+----x----+----
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import numpy.typing as npt

from hlr.scene.scene import Scene
from hlr.source.model import Floats, Ints
from hlr.view.camera import Camera
from hlr.visibility.segments import VISIBLE, WITHIN, Segments

NONE = 255
"""No state: the edge is not drawn."""


def at_outlines(scene: Scene, camera: Camera, segments: Segments) -> Segments:
    """The segments with the changes next to an outline's end moved there."""
    found = scene.silhouettes
    if found is None:
        return segments
    segments = _undented(scene, found.dents, segments)
    if len(found.meeting_edge) == 0:
        return segments
    # One meeting per edge: where both faces of an edge fold, the two ends are one.
    met, first = np.unique(found.meeting_edge, return_index=True)
    at = np.full(len(scene.edges), np.nan)
    at[met] = _on_paper(scene, camera, met, found.meeting_at[first])
    chains = scene.chains
    place = np.flatnonzero(~np.isnan(at[chains.edges])).astype(np.int32)
    begin = np.searchsorted(segments.edge, np.arange(len(scene.edges) + 1))
    pieces = np.diff(begin)[chains.edges[place]]

    def beyond(step: int) -> npt.NDArray[np.uint8]:
        """The state of the chord before or after, at its end toward this one."""
        at = _neighbours(scene, place, step)
        edge = chains.edges[at]
        piece = np.where(chains.reversed[at] ^ (step < 0), begin[edge + 1] - 1, begin[edge])
        known = segments.state[np.minimum(piece, len(segments.state) - 1)]
        return np.where(begin[edge + 1] > begin[edge], known, NONE)

    left, right = beyond(-1), beyond(1)
    own, backward = chains.edges[place], chains.reversed[place]
    low, high = np.where(backward, right, left), np.where(backward, left, right)
    piece = begin[own]
    # Without culling the chord dives under its own face's triangles a little before the node.
    one, two = segments.state[piece], segments.state[np.minimum(piece + 1, len(segments.state) - 1)]
    within = (at[own] > 0.0) & (at[own] < 1.0)
    dives = (pieces == 2) & within & ((one == low) | (one >= WITHIN)) & ((two == high) | (two >= WITHIN))
    whole = ((pieces == 1) | dives) & (left != NONE) & (right != NONE) & (left != right)
    own, low, high, piece, within, dives = (x[whole] for x in (own, low, high, piece, within, dives))
    states, t0, t1 = segments.state.copy(), segments.t0.copy(), segments.t1.copy()
    states[piece] = np.where(at[own] > 0.0, low, high)
    t1[piece[dives]] = at[own[dives]]
    t0[piece[dives] + 1] = at[own[dives]]
    states[piece[dives] + 1] = high[dives]
    # An edge that stands in several chains is parted once.
    parted = np.zeros(len(own), bool)
    parted[np.unique(own, return_index=True)[1]] = True
    parted &= within & ~dives
    own, high, piece = own[parted], high[parted], piece[parted]
    t1[piece] = at[own]
    order = np.argsort(np.concatenate([segments.edge, own]), kind="stable")
    return replace(
        segments,
        edge=np.concatenate([segments.edge, own.astype(segments.edge.dtype)])[order],
        t0=np.concatenate([t0, at[own]])[order],
        t1=np.concatenate([t1, np.ones(len(own))])[order],
        state=np.concatenate([states, high])[order],
    )


def _undented(scene: Scene, dents: Ints, segments: Segments) -> Segments:
    """A face turned toward the viewer does not hide its own border, though its triangles there may be turned away.

    Runs of such chords between visible ends become visible; what something else hides goes on beyond them.
    """
    chains = scene.chains
    doubtful = np.zeros(len(scene.edges), bool)
    doubtful[dents] = True
    begin = np.searchsorted(segments.edge, np.arange(len(scene.edges) + 1))
    dented = doubtful[chains.edges]
    # What lies between two of them is beside them.
    dented[1:-1] |= dented[:-2] & dented[2:]
    place = np.flatnonzero(dented).astype(np.int32)
    if len(place) == 0:
        return segments
    owner = np.searchsorted(chains.offsets, place, side="right") - 1
    head = np.ones(len(place), bool)
    head[1:] = (np.diff(place) > 1) | (np.diff(owner) > 0)
    run = np.cumsum(head) - 1
    first, last = place[head], place[np.append(head[1:], True)]
    seen = np.ones(len(first), bool)
    for at, step in ((first, -1), (last, 1)):
        beyond = _neighbours(scene, at, step)
        edge = chains.edges[beyond]
        final = chains.reversed[beyond] ^ (step < 0)
        piece = np.minimum(np.where(final, begin[edge + 1] - 1, begin[edge]), len(segments.state) - 1)
        seen &= (begin[edge + 1] > begin[edge]) & (segments.state[piece] == VISIBLE) & (beyond != at)
    mended = np.zeros(len(scene.edges), bool)
    mended[chains.edges[place[seen[run]]]] = True
    return replace(segments, state=np.where(mended[segments.edge], np.uint8(VISIBLE), segments.state))


def _neighbours(scene: Scene, place: Ints, step: int) -> Ints:
    """Places in the chains `step` further on: round the end of a closed chain, else not beyond the end."""
    chains = scene.chains
    owner = np.searchsorted(chains.offsets, place, side="right") - 1
    first, last = chains.offsets[owner], chains.offsets[owner + 1] - 1
    a, b = (scene.edges[chains.edges[k]] for k in (first, last))
    start = np.where(chains.reversed[first], a[:, 1], a[:, 0])
    end = np.where(chains.reversed[last], b[:, 0], b[:, 1])
    moved = place + step
    round_ = first + (moved - first) % (last - first + 1)
    return np.asarray(np.where(start == end, round_, np.clip(moved, first, last)))


def _on_paper(scene: Scene, camera: Camera, edges: Ints, t: Floats) -> Floats:
    """Parameters along edges in space, as parameters of their images."""
    if camera.eye is None:
        return t
    a, b = (camera.ahead(scene.points[scene.edges[edges, k]]) for k in (0, 1))
    return np.asarray(t * b / (t * b + (1.0 - t) * a))
