"""Where an edge of the model turns behind its own curved face: at the end of that face's outline, not at a mesh node.

The kernel counts on the mesh, whose contour leaves an edge at a node; the true outline leaves it between two nodes. The
change of visibility moves from the node to there, or a gap as long as half a chord would be left between the two lines.

::

    kernel    visible      | hidden                 the edge's chords -----+-----+-----
    moved     visible |      hidden                 | node    x end of the outline
              ---+----x----+----
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from hlr.scene.scene import Scene
from hlr.view.camera import Camera
from hlr.visibility.segments import HIDDEN, VISIBLE, Segments


def at_outlines(scene: Scene, camera: Camera, segments: Segments) -> Segments:
    """The segments with the changes next to an outline's end moved there."""
    found = scene.silhouettes
    if found is None or len(found.meeting_edge) == 0:
        return segments
    chains = scene.chains
    # One meeting per edge: where both faces of an edge fold, the two ends are one.
    met, first = np.unique(found.meeting_edge, return_index=True)
    at = np.full(len(scene.edges), np.nan)
    at[met] = _on_paper(scene, camera, met, found.meeting_at[first])
    place = np.flatnonzero(~np.isnan(at[chains.edges]))
    owner = np.repeat(np.arange(len(chains.kind)), np.diff(chains.offsets))
    inner = (place > chains.offsets[owner[place]]) & (place + 1 < chains.offsets[owner[place] + 1])
    place = place[inner]
    begin = np.searchsorted(segments.edge, np.arange(len(scene.edges) + 1))
    count = np.diff(begin)
    before, own, after = (chains.edges[place + k] for k in (-1, 0, 1))
    drawn = (count[before] > 0) & (count[own] == 1) & (count[after] > 0)
    place, before, own, after = place[drawn], before[drawn], own[drawn], after[drawn]

    def state(edge: np.ndarray, step: int, last: bool) -> np.ndarray:
        """Of an edge's last or first piece, as it is walked."""
        backward = chains.reversed[place + step]
        return segments.state[np.where(backward ^ last, begin[edge + 1] - 1, begin[edge])]

    left, right = state(before, -1, True), state(after, 1, False)
    changes = (left != right) & (np.minimum(left, right) == VISIBLE) & (np.maximum(left, right) == HIDDEN)
    place, own, left, right = place[changes], own[changes], left[changes], right[changes]
    # An edge that stands in several chains is changed once.
    _, once = np.unique(own, return_index=True)
    own, left, right, backward = own[once], left[once], right[once], chains.reversed[place[once]]
    inside = (at[own] > 0.0) & (at[own] < 1.0)
    own, left, right, backward = own[inside], left[inside], right[inside], backward[inside]
    low, high = np.where(backward, right, left), np.where(backward, left, right)
    piece = begin[own]
    t1, states = segments.t1.copy(), segments.state.copy()
    t1[piece], states[piece] = at[own], low
    order = np.argsort(np.concatenate([segments.edge, own]), kind="stable")
    return replace(
        segments,
        edge=np.concatenate([segments.edge, own.astype(segments.edge.dtype)])[order],
        t0=np.concatenate([segments.t0, at[own]])[order],
        t1=np.concatenate([t1, np.ones(len(own))])[order],
        state=np.concatenate([states, high])[order],
    )


def _on_paper(scene: Scene, camera: Camera, edges: np.ndarray, t: np.ndarray) -> np.ndarray:
    """Parameters along edges in space, as parameters of their images."""
    if camera.eye is None:
        return t
    a, b = (camera.ahead(scene.points[scene.edges[edges, k]]) for k in (0, 1))
    return np.asarray(t * b / (t * b + (1.0 - t) * a))
