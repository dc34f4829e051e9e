"""What the kernel is told of an image and a plan, and what it makes of contacts, lines on surfaces, hidden outlines."""

from types import SimpleNamespace

import numpy as np
import pytest

from hlr import _kernel
from hlr.visibility import segments
from hlr.visibility.segments import DIVING, HIDDEN, VISIBLE, WITHIN
from support.visibility.wire import mesh_with_wire

ANSWER = SimpleNamespace(
    edge=np.array([0, 0, 3], np.int32),
    t0=np.array([0.0, 0.5, 0.25]),
    t1=np.array([0.5, 1.0, 1.0]),
    state=np.array([VISIBLE, WITHIN, HIDDEN], np.uint8),
    counters={"seeds": 7},
    seconds={"scan": 0.5},
)


@pytest.fixture
def solve(monkeypatch):
    """solve(hidden, contact) on a kernel that always answers the same; .arguments, .steps: what it was told."""
    told, steps = [], []
    monkeypatch.setattr(
        segments._kernel, "visibility", lambda *given, **wanted: told.append(given) or steps.append(wanted) or ANSWER
    )

    def call(hidden=None, contact=True):
        silhouettes = None if hidden is None else SimpleNamespace(hidden=hidden, own=())
        image = SimpleNamespace(silhouettes=silhouettes, mesh=lambda: "mesh")
        plan = SimpleNamespace(visibility_input="input", contact=contact)
        for name in ("crossings", "piercings", "pyramid"):
            setattr(plan, name, name)
        return segments.solve(image, plan, np.zeros((2, 3)))

    call.arguments, call.steps = told, steps
    return call


def test_the_answer_is_handed_on(solve):
    found = solve().found
    assert found.edge.tolist() == [0, 0, 3] and found.state.tolist() == [VISIBLE, WITHIN, HIDDEN]
    assert found.t0.tolist() == [0.0, 0.5, 0.25] and found.t1.tolist() == [0.5, 1.0, 1.0]
    assert found.counters == {"seeds": 7} and found.seconds == {"scan": 0.5}


def test_the_kernel_is_told_the_plan_and_its_steps(solve):
    solve(), solve(contact=False)
    assert [given[2] for given in solve.arguments] == ["input", "input"]
    steps = {"crossings": "crossings", "piercings": "piercings", "pyramid": "pyramid", "arithmetic": "exact"}
    assert solve.steps == [{"contact": True, **steps}, {"contact": False, **steps}]


def test_the_kernel_is_told_which_outlines_are_hidden(solve):
    hidden = np.array([False, True])
    solve(hidden), solve(None)
    assert solve.arguments[0][4] is hidden and solve.arguments[1][4] is None


# A square of two triangles, and a wire half of which lies 1 behind it; the view is along z.
POINTS = np.array([[0, 0, 0], [4, 0, 0], [4, 4, 0], [0, 4, 0], [2, 2, 1], [6, 2, 1], [0, 0, -64], [0, 0, 64]], float)
TRIANGLES = np.array([[0, 1, 2], [0, 2, 3]], np.int32)
WIRE = 5


def seen(tight=False, hidden=None, depth=1.5, contact=True):
    """The pieces of the wire and of `hidden` edges: edge and state. tight: the wire runs on the square's surface."""
    mesh, _ = mesh_with_wire(POINTS, TRIANGLES, (4, 5))
    given = _kernel.VisibilityInput.of(
        np.zeros(2, np.int32),
        np.array([0] * WIRE + [1], np.int32),
        np.array([0] * WIRE + [1], np.uint8),
        cull=np.zeros(2, bool),
        sound=np.ones(2, bool),
        delta=np.full(2, depth),
        cap=np.full(2, 100.0),
        tight=np.array([False, tight]),
        drawn=[],
    )
    return _kernel.visibility(mesh, POINTS, given, None, hidden, contact=contact)


def test_states_are_numbered_as_the_kernel_has_them():
    assert (VISIBLE, HIDDEN, WITHIN, DIVING) == (0, 1, 2, 3)
    assert seen().state.tolist() == [WITHIN, VISIBLE] and seen(depth=0.5).state.tolist() == [HIDDEN, VISIBLE]


def test_nothing_touches_where_contact_is_off():
    assert seen(contact=False).state.tolist() == [HIDDEN, VISIBLE]


def test_a_line_on_a_surface_is_never_nearly_hidden():
    assert seen().counters["contacts"] == seen(tight=True).counters["contacts"] == 1
    assert seen(tight=True).state.tolist() == [VISIBLE, VISIBLE]
    assert seen(tight=True, depth=0.5).state.tolist() == [HIDDEN, VISIBLE]


def test_hidden_outlines_come_where_their_edges_are():
    found = seen(hidden=np.array([False, True, False, False, True, False]))
    assert found.edge.tolist() == [1, 4, WIRE, WIRE] and found.state.tolist() == [HIDDEN, HIDDEN, WITHIN, VISIBLE]
    assert found.t0.tolist()[:3] == [0.0, 0.0, 0.0] and found.t1.tolist()[:2] == [1.0, 1.0]
    assert (found.edge.dtype, found.state.dtype) == (np.int32, np.uint8)
    none = seen(hidden=np.zeros(6, bool))
    assert none.edge.tolist() == seen().edge.tolist() == [WIRE, WIRE]
    with pytest.raises(ValueError, match="hidden"):
        seen(hidden=np.zeros(5, bool))


def test_pieces_that_do_not_fit_are_refused():
    edge, ends, state, facing = np.array([0, 1], np.int32), np.ones(2), np.ones(2, np.uint8), np.zeros(2, np.int8)
    assert _kernel.Visibility(edge, 0 * ends, ends, state, facing).state.tolist() == [HIDDEN, HIDDEN]
    with pytest.raises(ValueError, match="t1"):
        _kernel.Visibility(edge, ends, ends[:1], state, facing)
    with pytest.raises(ValueError, match="edge"):
        _kernel.Visibility(edge[::-1].copy(), ends, ends, state, facing)
