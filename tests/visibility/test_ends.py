"""Where an edge turns behind its own face, with something else in front of it; outlines beside other outlines."""

from __future__ import annotations

from types import SimpleNamespace

import cadquery as cq
import numpy as np
import pytest

import hlr
from hlr.measure import measured
from hlr.source import open_source
from hlr.visibility import ends
from hlr.visibility.segments import HIDDEN, VISIBLE, Segments

ACCURACY = 0.5
"""Coarse: a chord of the rim below is 6 mm long, twelve accuracies."""

VIEW = (0, -1, 0.6)


def keeps(model, view=VIEW):
    source = open_source(model)
    drawing = hlr.draw(source, view, accuracy=ACCURACY)
    reached = measured(source, drawing, samples=4000)
    assert reached.labels.longest <= ACCURACY, reached.labels
    assert reached.changes.worst <= ACCURACY
    assert reached.lost.worst <= ACCURACY
    return drawing


@pytest.mark.parametrize("x", [13.5, 15.0, 16.5, 18.0])
def test_what_is_in_front_of_the_last_chord_hides_it_up_to_its_own_border(x):
    """The lower rim of a cylinder turns behind it on a chord; a post in front covers part of that chord."""
    can = cq.Workplane("XY").circle(20).extrude(12)
    post = cq.Workplane("XY").box(2.0, 2.0, 30).translate((x, -30, 0))
    keeps(cq.Assembly().add(can, name="can").add(post, name="post"), (0.3, -1, 0.6))


@pytest.mark.parametrize("inside", [0.6, 0.9, 1.2])
def test_an_outline_close_behind_another_is_hidden(inside):
    """Less than two accuracies away: moved out of its own facets by more than that, it would be seen beside it."""
    front = cq.Workplane("XY").circle(20).extrude(40)
    back = cq.Workplane("XY").circle(20.0 - inside).extrude(40).rotate((0, 0, 20), (0, 1, 20), 0.5)
    drawing = keeps(cq.Assembly().add(front, name="front").add(back.translate((0, 60, 0)), name="back"), (0, -1, 0))
    outlines = [x for x in drawing.lines if x.kind == "outline" and drawing.parts[x.part].name.endswith("back")]
    assert outlines and not any(x.visible for x in outlines)


def segments(pieces):
    """Of (edge, t0, t1, state)."""
    edge, t0, t1, state = zip(*pieces, strict=True)
    return Segments(
        np.array(edge, np.int32),
        np.array(t0, float),
        np.array(t1, float),
        np.array(state, np.uint8),
        np.zeros(0, np.int8),
        {},
        {},
    )


@pytest.mark.parametrize(
    ("asked", "expected"),
    [
        (True, [(1, 0.0, 0.25, VISIBLE), (1, 0.25, 0.6, HIDDEN), (1, 0.6, 1.0, HIDDEN)]),
        (False, [(1, 0.0, 0.6, VISIBLE), (1, 0.6, 1.0, HIDDEN)]),
    ],
)
def test_a_chord_is_seen_as_its_probe_up_to_the_outline(asked, expected):
    """Edge 1 turns behind its face at 0.6; something hides its probe, edge 3, from 0.25 on. Only edge 1 is drawn."""
    known = [(0, 0.0, 1.0, VISIBLE), (1, 0.0, 1.0, HIDDEN), (2, 0.0, 1.0, HIDDEN)]
    found = ends._parted(
        segments([*known, (3, 0.0, 0.25, VISIBLE), (3, 0.25, 1.0, HIDDEN)]),
        np.array([0, 1, 2, 3, 5]),
        own=np.array([1], np.int32),
        at=np.array([0.6]),
        low=np.array([VISIBLE], np.uint8),
        high=np.array([HIDDEN], np.uint8),
        probe=np.array([3], np.int32),
        asked=np.array([asked]),
        probes=np.array([3], np.int32),
    )
    drawn = list(zip(found.edge.tolist(), found.t0.tolist(), found.t1.tolist(), found.state.tolist(), strict=True))
    assert drawn == [known[0], *expected, known[2]]


V, H = VISIBLE, HIDDEN


@pytest.mark.parametrize("backward", [False, True])
@pytest.mark.parametrize(
    ("states", "met", "expected"),
    [
        ([[V], [H], [H], [H], [V]], [], [V, V, V, V, V]),
        ([[V], [H], [H], [H], [H]], [], [V, H, H, H, H]),
        ([[V], [H], [H], [H], [H]], [4], [V, V, V, V, H]),
        ([[H], [H], [H], [H], [V]], [0], [H, V, V, V, V]),
        ([[H], [H], [H], [H], [H]], [0, 4], [H, H, H, H, H]),
        # What counts is the end toward the run: hidden here, visible there.
        ([[V, H], [H], [H], [H], [V]], [], [V, H, H, H, H, V]),
        ([[V], [H], [H], [H], [V, H]], [], [V, V, V, V, V, H]),
    ],
)
def test_a_face_does_not_hide_its_own_dented_border(states, met, expected, backward):
    """Edges 1 and 3 of a chain of five are doubtful, and so is 2 between them; another chain follows."""
    ends_of = np.array([[i, i + 1] for i in range(5)] + [[10, 11]], np.int32)
    order = np.arange(5)[::-1] if backward else np.arange(5)
    chains = SimpleNamespace(
        offsets=np.array([0, 5, 6], np.int32),
        edges=np.append(order, 5).astype(np.int32),
        reversed=np.array([backward] * 5 + [False]),
    )
    pieces = []
    for edge, known in enumerate([*states, [H]]):
        at = np.linspace(0.0, 1.0, len(known) + 1)
        pieces += [(edge, at[i], at[i + 1], state) for i, state in enumerate(known)]
    scene = SimpleNamespace(edges=ends_of, chains=chains)
    found = ends._undented(scene, np.array([1, 3]), np.array(met, int), segments(pieces))
    assert found.state.tolist() == [*expected, H]
