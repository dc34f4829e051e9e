"""What is made of the kernel's answer: contacts counted, lines on surfaces, and silhouettes that are hidden anyway."""

from types import SimpleNamespace

import numpy as np
import pytest

from hlr.image.image import OwnFaces
from hlr.visibility import segments
from hlr.visibility.segments import DIVING, HIDDEN, VISIBLE, WITHIN

STATES = [VISIBLE, WITHIN, HIDDEN, DIVING, WITHIN, DIVING]
EDGES = [0, 0, 1, 1, 3, 3]


@pytest.fixture
def solve(monkeypatch):
    """solve(tight, hidden, contact) on a kernel that always answers the same; .given: the groups it was told of."""
    given = []

    def groups(triangle, edge, **columns):
        given.append(columns)

    def visibility(*arguments, **steps):
        return SimpleNamespace(
            edge=np.array(EDGES, np.int32),
            t0=np.array([0.0, 0.5, 0.0, 0.25, 0.0, 0.75]),
            t1=np.array([0.5, 1.0, 0.25, 1.0, 0.75, 1.0]),
            state=np.array(STATES, np.uint8),
            facing=np.array([1, -1], np.int8),
            counters={"seeds": 7},
            seconds={"scan": 0.5},
        )

    monkeypatch.setattr(segments._kernel, "visibility", visibility)
    monkeypatch.setattr(segments._kernel, "Groups", groups)

    def call(tight=(False, False), hidden=None, contact=True):
        silhouettes = None if hidden is None else SimpleNamespace(hidden=np.array(hidden), own=OwnFaces.none())
        scene = SimpleNamespace(
            groups=SimpleNamespace(tight=np.array(tight)), edge_group=np.array([0, 1, 1, 0]), silhouettes=silhouettes
        )
        scene.triangle_group, scene.mesh = "triangle_group", lambda: "mesh"
        plan = SimpleNamespace(delta=np.array([3, 4]), cap=np.array([5, 6]), contact=contact)
        for name in ("role", "cull", "sound", "crossings", "piercings", "pyramid"):
            setattr(plan, name, name)
        return segments.solve(scene, plan, np.zeros((2, 3)))

    call.given = given
    return call


def test_the_answer_is_handed_on(solve):
    # As the kernel numbers them.
    assert (segments.VISIBLE, segments.HIDDEN, segments.WITHIN, segments.DIVING) == (0, 1, 2, 3)
    found = solve()
    assert found.edge.tolist() == EDGES and found.state.tolist() == STATES
    assert found.t0.tolist() == [0.0, 0.5, 0.0, 0.25, 0.0, 0.75] and found.t1.tolist()[-2:] == [0.75, 1.0]
    assert found.facing.tolist() == [1, -1] and found.seconds == {"scan": 0.5}
    # Those hidden by less than the tolerance, on the way to hidden or not.
    assert found.counters == {"seeds": 7, "contacts": 4}


def test_the_cap_counts_only_where_contact_does(solve):
    solve(), solve(contact=False)
    assert [given["cap"].tolist() for given in solve.given] == [[5, 6], [0, 0]]
    assert solve.given[0]["delta"].tolist() == [3, 4]


def test_a_line_on_a_surface_is_never_nearly_hidden(solve):
    # Edges 0 and 3 are of group 0, 1 of group 1.
    assert solve((True, False)).state.tolist() == [VISIBLE, VISIBLE, HIDDEN, DIVING, VISIBLE, VISIBLE]
    assert solve((False, True)).state.tolist() == [VISIBLE, WITHIN, HIDDEN, VISIBLE, WITHIN, DIVING]
    assert solve((True, True)).counters["contacts"] == 4


def test_silhouettes_that_are_hidden_come_where_their_edges_are(solve):
    found = solve(hidden=[False, False, True, False])
    assert found.edge.tolist() == [0, 0, 1, 1, 2, 3, 3]
    assert found.t0.tolist() == [0.0, 0.5, 0.0, 0.25, 0.0, 0.0, 0.75]
    assert found.t1.tolist() == [0.5, 1.0, 0.25, 1.0, 1.0, 0.75, 1.0]
    assert found.state.tolist() == [*STATES[:4], HIDDEN, *STATES[4:]]
    assert (found.edge.dtype, found.state.dtype) == (np.int32, np.uint8)
    # Pieces of one edge stay in their order, however many there are.
    for hidden in ([True] * 4, [True, False, False, True]):
        found = solve(hidden=hidden)
        for edge in (0, 1, 3):
            mine = found.edge == edge
            kernel = np.array(EDGES) == edge
            assert found.state[mine].tolist() == np.array(STATES)[kernel].tolist() + [HIDDEN] * hidden[edge]


def test_no_hidden_silhouettes_change_nothing(solve):
    for hidden in (None, [False] * 4):
        assert solve(hidden=hidden).edge.tolist() == EDGES
