"""What fuzzing the kernel found, each made as small as it goes."""

from __future__ import annotations

import itertools

import numpy as np

from hlr import _kernel
from support.visibility.wire import mesh_with_wire

VISIBLE, HIDDEN, WITHIN = 0, 1, 2


def states_behind_a_valley(own: float, other: float) -> list[int]:
    """A straight wire behind a valley of two slopes, nearest to it in the middle: 2 there, 6 at the ends.

    own, other: contact tolerances of the wire's part and of the valley's; for the pair the larger one counts.
    """
    points = [[0, -10, 0], [0, 10, 0], [10, -10, 4], [10, 10, 4], [20, -10, 0], [20, 10, 0], [2, 0, 6], [18, 0, 6]]
    points += [[0, 0, -640], [0, 0, 640]]  # the kernel caps the tolerance at a fraction of the depth of all points
    triangles = np.array([[0, 2, 1], [1, 2, 3], [2, 4, 3], [3, 4, 5]], np.int32)
    mesh, wire = mesh_with_wire(np.array(points, float), triangles, (6, 7))
    given = _kernel.VisibilityInput.of(
        np.ones(4, np.int32),
        np.array([1] * wire + [0], np.int32),
        np.ones(wire + 1, np.uint8),
        cull=np.zeros(2, bool),
        sound=np.ones(2, bool),
        delta=np.array([own, other]),
        cap=np.full(2, 100.0),
        tight=np.zeros(2, bool),
        drawn=[],
    )
    found = _kernel.visibility(mesh, np.array(points, float), given)
    return [min(int(state), WITHIN) for edge, state in zip(found.edge, found.state, strict=True) if edge == wire]


def test_a_wire_within_the_contact_tolerance() -> None:
    assert states_behind_a_valley(3.0, 3.0) == [HIDDEN, WITHIN, HIDDEN]
    assert states_behind_a_valley(3.0, 0.0) == [HIDDEN, WITHIN, HIDDEN]


def test_the_larger_tolerance_of_two_parts_counts_for_both() -> None:
    assert states_behind_a_valley(0.0, 3.0) == [HIDDEN, WITHIN, HIDDEN]


def lines_around_a_square(missing: int) -> list[list[list[float]]]:
    """A square, walked from its first corner to the same, of which one side was clipped away; the second is hidden."""
    flat = np.array([[0, 0], [10, 0], [10, 10], [0, 10]], float)
    drawn = [side for side in range(4) if side != missing]
    nothing = np.zeros(0, np.int32)
    edges = np.array([[0, 1], [1, 2], [2, 3], [3, 0]], np.int32)
    walks = _kernel.Walks(
        np.array([0, 4], np.int32),
        np.arange(4, dtype=np.int32),
        np.zeros(4, bool),
        np.zeros(1, np.uint8),
        np.zeros(1, np.int32),
    )
    space = np.column_stack([flat, np.zeros(4)])
    mesh = _kernel.Mesh(space, np.zeros((0, 3), np.int32), edges, np.zeros(5, np.int32), nothing)
    one = np.zeros(1)
    given = _kernel.VisibilityInput.of(
        nothing,
        np.zeros(4, np.int32),
        np.zeros(4, np.uint8),
        cull=one == 1,
        sound=one == 1,
        delta=one,
        cap=one,
        tight=one == 1,
        drawn=[True] * 6,
    )
    found = _kernel.Visibility(
        np.array(drawn, np.int32),
        np.zeros(3),
        np.ones(3),
        np.array([int(side == 1) for side in drawn], np.uint8),
        np.zeros(0, np.int8),
    )
    chains = _kernel.Chains(
        walks,
        given,
        mesh,
        nothing,
        nothing,
        np.ones(1, bool),
        found,
    )
    cut = _kernel.Cut(
        _kernel.Camera((0.0, 0.0, -1.0), (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), None, 1.0),
        mesh,
        found,
        chains,
        np.zeros(1, np.uint8),
        _kernel.LineTolerances(
            accuracy=0.1,
            short=0.1,
            flip=0.1,
            stub=1.0,
            width=0.05,
            under=0.3,
            thin_paper=0.01,
            thin_model=0.01,
            chord=0.1,
            closed=0.1,
            contact=0.1,
        ),
        True,
    )
    lines, _ = cut.finished()
    held = lines.columns()
    points, offsets = held["points"].tolist(), held["offsets"].tolist()
    return sorted(points[i:j] for i, j in itertools.pairwise(offsets))


def test_a_clipped_side_in_the_middle_stays_away() -> None:
    assert lines_around_a_square(2) == [[[0, 0], [10, 0]], [[0, 10], [0, 0]], [[10, 0], [10, 10]]]


def test_a_clipped_side_at_the_end_stays_away() -> None:
    assert lines_around_a_square(3) == [[[0, 0], [10, 0]], [[10, 0], [10, 10]], [[10, 10], [0, 10]]]
