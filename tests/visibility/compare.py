"""Kernel against oracle on one scene, interval by interval; and making a failing scene small."""

from __future__ import annotations

import itertools
from collections.abc import Callable
from dataclasses import replace
from fractions import Fraction

from support.visibility import adapter, oracle
from support.visibility.adapter import Way
from support.visibility.oracle import ONE, ZERO
from support.visibility.scenes import Edge, Scene

TOLERANCE = 1e-12
"""Parameters are exact fractions there and correctly rounded quotients here."""


def is_point(scene: Scene, edge: Edge) -> bool:
    """Seen end-on: nothing to draw."""
    a, b = scene.segment(edge)
    return a[:2] == b[:2]


NAMES = ("visible", "hidden", "within")
State = tuple[Fraction, Fraction, int]


def difference(scene: Scene, way: Way, threads: int = 1) -> str | None:
    """The first edge on which kernel and oracle differ, in words; None where they agree."""
    if way.parts:
        scene = scene.apart()
    found = adapter.visibility(scene, way, threads)
    if found.counters.get("contradictions"):
        return f"the kernel contradicts itself: {found.counters}"
    for edge in scene.edges():
        got = found.pieces.get(edge, [])
        if is_point(scene, edge):
            if got:
                return f"edge {edge} is a point in the image, kernel {got}"
            continue
        want = expected(scene, edge, way)
        if not agree(got, want):
            shown = [f"{t0}..{t1} {NAMES[state]}" for t0, t1, state in want]
            return f"edge {edge} {scene.segment(edge)}: kernel {got}, oracle {shown}"
    return None


def expected(scene: Scene, edge: Edge, way: Way) -> list[State]:
    """What the oracle says, in the kernel's states.

    Within: hidden, but not if the edge were nearer to the viewer by the bias. A part that can be trusted keeps its
    distance from its own edges: they share its vertices, and what they touch they touch exactly.
    """
    segment, triangles = scene.segment(edge), scene.triangles()
    plain = oracle.hidden_parts(segment, triangles)
    moved = plain
    if way.bias:
        own = scene.part_of(edge) if way.trusted else None
        near = [t for t, part in zip(triangles, scene.parts, strict=True) if part == own]
        far = [t for t, part in zip(triangles, scene.parts, strict=True) if part != own]
        (ax, ay, az), (bx, by, bz) = segment
        shifted = ((ax, ay, az - way.bias), (bx, by, bz - way.bias))
        moved = oracle.hidden_parts(segment, near) + oracle.hidden_parts(shifted, far)
    ends = sorted({ZERO, ONE, *itertools.chain(*plain, *moved)})
    result: list[State] = []
    for t0, t1 in itertools.pairwise(ends):
        hidden, still = (any(low <= t0 and t1 <= high for low, high in found) for found in (plain, moved))
        state = adapter.VISIBLE if not hidden else adapter.HIDDEN if still else adapter.WITHIN
        if result and result[-1][2] == state:
            result[-1] = (result[-1][0], t1, state)
        else:
            result.append((t0, t1, state))
    return result


def agree(got: list[adapter.Piece], want: list[State]) -> bool:
    return len(got) == len(want) and all(
        abs(g[0] - float(w[0])) <= TOLERANCE and abs(g[1] - float(w[1])) <= TOLERANCE and g[2] == w[2]
        for g, w in zip(got, want, strict=True)
    )


def shrink(scene: Scene, failing: Callable[[Scene], bool]) -> Scene:
    """Leave out whatever the failure does not need, one thing at a time, until nothing more can go."""
    while True:
        for smaller in _smaller(scene):
            if failing(smaller):
                scene = smaller
                break
        else:
            return _compact(scene)


def _smaller(scene: Scene) -> list[Scene]:
    if scene.closed:
        fewer = [scene.without_part(number) for number in sorted(set(scene.parts))]
    else:
        fewer = [scene.without_face(number) for number in range(len(scene.faces))]
    wires = scene.wires
    return fewer + [replace(scene, wires=wires[:i] + wires[i + 1 :]) for i in range(len(wires))]


def _compact(scene: Scene) -> Scene:
    """Drop unused points; the order of the rest, and so every edge's direction, stays."""
    used = sorted({i for face in scene.faces for i in face} | {i for wire in scene.wires for i in wire})
    new = {old: number for number, old in enumerate(used)}
    return replace(
        scene,
        points=tuple(scene.points[i] for i in used),
        faces=tuple((new[i], new[j], new[k]) for i, j, k in scene.faces),
        wires=tuple((new[i], new[j]) for i, j in scene.wires),
    )
