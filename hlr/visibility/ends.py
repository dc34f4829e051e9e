"""Where an edge of the model turns behind its own curved face: at the end of that face's outline, not at a mesh node.

The kernel counts on the mesh, whose contour leaves an edge at a node; the true outline leaves it on a chord beside
that node. A change of visibility at an end of that very chord is the contour's: it moves to the outline, or a gap as
long as half a chord would be left between the two lines. What else hides the chord before the outline's end is told by
its probe: the same chord, moved so that its own face does not hide it.

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
from hlr.visibility.segments import DIVING, HIDDEN, VISIBLE, WITHIN, Segments

NONE = 255
"""No state: the edge is not drawn."""

SEEN = np.empty(4, np.int8)
SEEN[[VISIBLE, WITHIN, DIVING, HIDDEN]] = [0, 1, 2, 3]
"""How much hides what has a state."""


def at_outlines(scene: Scene, camera: Camera, segments: Segments) -> Segments:
    """The segments with the changes next to an outline's end moved there; those of probes are taken out."""
    found = scene.silhouettes
    if found is None:
        return segments
    segments = _undented(scene, found.dents, found.meeting_edge, segments)
    if len(found.meeting_edge) == 0:
        return segments
    # One meeting per edge: where both faces of an edge fold, the two ends are one.
    met, first = np.unique(found.meeting_edge, return_index=True)
    at = np.full(len(scene.edges), np.nan)
    at[met] = _on_paper(scene, camera, met, found.meeting_at[first])
    probe = np.zeros(len(scene.edges), np.int32)
    probe[met] = found.meeting_probe[first]
    chains, cull = scene.chains, scene.groups.cull[scene.edge_group]
    place = np.flatnonzero(~np.isnan(at[chains.edges])).astype(np.int32)
    begin = np.searchsorted(segments.edge, np.arange(len(scene.edges) + 1)).astype(np.int64)

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
    pieces = begin[own + 1] - begin[own]
    one, last = (segments.state[np.clip(begin[own + k] - k, 0, len(segments.state) - 1)] for k in (0, 1))
    # The mesh's contour hides from a node on; only without culling the chord dives under its own face's triangles a
    # little before that. What else changes on the chord itself is the doing of something else.
    turns = (one != low) | (last != high) | (~cull[own] & (pieces == 2))
    turns &= (pieces > 0) & (left != NONE) & (right != NONE) & (left != right)
    # An edge that stands in several chains is parted once.
    own, first = np.unique(own[turns], return_index=True)
    low, high = low[turns][first], high[turns][first]
    # Where nothing is culled a face may be seen from inside, and the probe has been moved into its body.
    return _parted(segments, begin, own, at[own], low, high, probe[own], cull[own], found.meeting_probe)


def _parted(
    segments: Segments,
    begin: npt.NDArray[np.int64],
    own: Ints,
    at: Floats,
    low: npt.NDArray[np.uint8],
    high: npt.NDArray[np.uint8],
    probe: Ints,
    asked: npt.NDArray[np.bool_],
    probes: Ints,
) -> Segments:
    """Chords `own` (k,) as their probes are seen, up to `at`; beyond that, as what follows them there.

    low, high (k,): the states beyond both ends. asked (k,): whether the probe is: else the chord goes on as what is
    before it. probes: all of them
    """
    front_low = SEEN[low] < SEEN[high]
    begins, ends = np.where(front_low, 0.0, at), np.where(front_low, at, 1.0)
    count = np.where(asked, begin[probe + 1] - begin[probe], 0)
    which = np.repeat(np.arange(len(own)), count)
    piece = np.arange(len(which)) + np.repeat(begin[probe] - np.cumsum(count) + count, count)
    blind = np.flatnonzero(count == 0)
    edge = np.concatenate([own[which], own[blind], own])
    t0 = np.concatenate([np.maximum(segments.t0[piece], begins[which]), begins[blind], np.where(front_low, at, 0.0)])
    t1 = np.concatenate([np.minimum(segments.t1[piece], ends[which]), ends[blind], np.where(front_low, 1.0, at)])
    front, back = np.where(front_low, low, high), np.where(front_low, high, low)
    state = np.concatenate([segments.state[piece], front[blind], back])
    gone = np.zeros(len(begin) - 1, bool)
    gone[own] = True
    gone[probes] = True
    old, new = ~gone[segments.edge], t1 > t0
    edge = np.concatenate([segments.edge[old], edge[new].astype(segments.edge.dtype)])
    t0, t1 = np.concatenate([segments.t0[old], t0[new]]), np.concatenate([segments.t1[old], t1[new]])
    order = np.lexsort((t0, edge))
    state = np.concatenate([segments.state[old], state[new]])[order]
    return replace(segments, edge=edge[order], t0=t0[order], t1=t1[order], state=state)


def _undented(scene: Scene, dents: Ints, met: Ints, segments: Segments) -> Segments:
    """A face turned toward the viewer does not hide its own border, though its triangles there may be turned away.

    Runs of such chords between visible ends become visible; what something else hides goes on beyond them. One end may
    be a chord at which an outline ends, `met`: beyond that the face is turned away.
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
    ends = []
    meets = np.zeros(len(scene.edges), bool)
    meets[met] = True
    for at, step in ((first, -1), (last, 1)):
        beyond = _neighbours(scene, at, step)
        edge = chains.edges[beyond]
        final = chains.reversed[beyond] ^ (step < 0)
        piece = np.minimum(np.where(final, begin[edge + 1] - 1, begin[edge]), len(segments.state) - 1)
        there = (begin[edge + 1] > begin[edge]) & (beyond != at)
        visible = there & (segments.state[piece] == VISIBLE)
        ends.append((visible, visible | (there & meets[edge])))
    seen = (ends[0][0] & ends[1][1]) | (ends[0][1] & ends[1][0])
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
