"""Kernel against oracle on one scene, interval by interval; and making a failing scene small."""

from __future__ import annotations

from collections.abc import Callable

from visibility import adapter, oracle
from visibility.scenes import Edge, Scene

TOLERANCE = 1e-12
"""Parameters are exact fractions there and correctly rounded quotients here."""


def is_point(scene: Scene, edge: Edge) -> bool:
    """Seen end-on: nothing to draw."""
    a, b = scene.segment(edge)
    return a[:2] == b[:2]


def difference(scene: Scene, *, solids: bool = False, threads: int = 1) -> str | None:
    """The first edge on which kernel and oracle differ, in words; None where they agree."""
    found = adapter.visibility(scene, threads, solids=solids)
    if found.counters.get("contradictions"):
        return f"the kernel contradicts itself: {found.counters}"
    triangles = scene.triangles()
    for edge in scene.edges():
        got = found.pieces.get(edge, [])
        if is_point(scene, edge):
            if got:
                return f"edge {edge} is a point in the image, kernel {got}"
            continue
        want = oracle.states(oracle.intervals(scene.segment(edge), triangles))
        if not agree(got, want):
            shown = [f"{t0}..{t1} {'hidden' if hidden else 'visible'}" for t0, t1, hidden in want]
            return f"edge {edge} {scene.segment(edge)}: kernel {got}, oracle {shown}"
    return None


def agree(got: list[adapter.Piece], want: list[tuple[oracle.Fraction, oracle.Fraction, bool]]) -> bool:
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
    if scene.solids:
        fewer = [scene.without_solid(number) for number in sorted(set(scene.solids))]
    else:
        fewer = [scene.without_face(number) for number in range(len(scene.faces))]
    wires = scene.wires
    lines = [Scene(scene.points, scene.faces, wires[:i] + wires[i + 1 :], scene.solids) for i in range(len(wires))]
    return fewer + lines


def _compact(scene: Scene) -> Scene:
    """Drop unused points; the order of the rest, and so every edge's direction, stays."""
    used = sorted({i for face in scene.faces for i in face} | {i for wire in scene.wires for i in wire})
    new = {old: number for number, old in enumerate(used)}
    return Scene(
        tuple(scene.points[i] for i in used),
        tuple((new[i], new[j], new[k]) for i, j, k in scene.faces),
        tuple((new[i], new[j]) for i, j in scene.wires),
        scene.solids,
    )
