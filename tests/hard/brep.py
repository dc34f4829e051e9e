"""Curves, boxes and judging that the B-rep cases have in common."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from itertools import pairwise, product
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from hlr import Drawing
from support.at_size import AT_SIZE
from support.expected import Edge3, Ink, differences, doubled, expect, ink
from support.referee import exchange, judge, referee, reference

Floats = npt.NDArray[np.float64]

CHORDS = 360
"""Of a full circle: off by a 25,000th of the radius, far below any accuracy."""
QUICK = 4000
"""Fineness of the ray referee's own mesh, diagonals per deflection."""
TANGENT = 2.0
"""Millimetres per metre of ink along which lines that touch tangentially may run within one another's ink."""


def walk(points: npt.ArrayLike) -> list[Edge3]:
    """The straight pieces of a polyline (n, 3)."""
    return list(pairwise(np.asarray(points, float)))


def arc(centre: Sequence[float], u: Sequence[float], v: Sequence[float], start: float = 0, end: float = 360):
    """Pieces of centre + u cos t + v sin t between two angles in degrees."""
    t = np.radians(np.linspace(start, end, max(2, int(np.ceil(CHORDS * abs(end - start) / 360)) + 1)))[:, None]
    return walk(np.asarray(centre) + np.cos(t) * np.asarray(u, float) + np.sin(t) * np.asarray(v, float))


def ring(radius: float, z: float = 0.0, start: float = 0, end: float = 360) -> list[Edge3]:
    """A horizontal circle about the z axis, or an arc of it."""
    return arc((0, 0, z), (radius, 0, 0), (0, radius, 0), start, end)


def box_edges(
    low: Sequence[float], high: Sequence[float], direction: Sequence[float]
) -> tuple[list[Edge3], list[Edge3]]:
    """Visible and hidden edges of a box by itself: hidden where both faces are turned away or edge-on.

    Of those that coincide with a visible one, none needs to be drawn; `differences` knows.
    """
    seen: list[Edge3] = []
    unseen: list[Edge3] = []
    for axis in range(3):
        b, c = (axis + 1) % 3, (axis + 2) % 3
        for i, j in product((0, 1), repeat=2):
            ends = [[0.0] * 3, [0.0] * 3]
            for k, end in enumerate(ends):
                end[axis], end[b], end[c] = (low, high)[k][axis], (low, high)[i][b], (low, high)[j][c]
            facing = direction[b] * (2 * i - 1) > 0 or direction[c] * (2 * j - 1) > 0
            (seen if facing else unseen).append((ends[0], ends[1]))
    return seen, unseen


def like(
    drawing: Drawing,
    expected: Ink,
    *,
    either: Sequence[Edge3] = (),
    without: Sequence[str] = (),
    ends: float = 0.0,
    step: float = 0.5,
    touching: float = 0.0,
) -> None:
    """`expected.agrees` for curves: where they touch tangentially they share some ink, known to be `touching` long.

    either: pieces that may be there or not, visible or hidden, where the visibility itself is a matter of tolerance: a
    rim that runs into a generator tangentially, lines upon a surface there.
    """
    assert expected.visible.size + expected.hidden.size, "nothing is expected: the comparison would be empty"
    drawn, tolerance = ink(drawing, without), drawing.accuracy.used
    told = [t for t in differences(expected, drawn, tolerance, step, ends) if "missing" in t]
    doubtful = expect(drawing, either).visible
    allowed = Ink(*(np.concatenate([one, doubtful]) for one in (expected.visible, expected.hidden)))
    told += [t for t in differences(allowed, drawn, tolerance, step, ends) if "should not" in t]
    assert not told, "\n".join(told)
    once(drawing, touching)


def once(drawing: Drawing, touching: float = 0.0) -> None:
    """Assert that no line lies on another, but for tangential touch, known to be `touching` long."""
    assert doubled(drawing) <= touching + TANGENT * sum(ink(drawing).lengths()) / 1000


def same(one: Drawing, other: Drawing, accuracies: float = 2.0) -> None:
    """Assert that two drawings put the same ink on paper: each may be off by its accuracy."""
    used = max(one.accuracy.used, other.accuracy.used)
    told = differences(ink(one), ink(other), accuracies * used)
    assert not told, "\n".join(told)


def kinds(drawing: Drawing) -> set[tuple[str, bool]]:
    """The kinds of lines that are there, and whether visible."""
    return {(line.kind, line.visible) for line in drawing.lines}


def turn(vector: Sequence[float], axis: Sequence[float], degrees: float) -> tuple[float, float, float]:
    """A vector rotated about an axis through the origin."""
    k = np.asarray(axis, float) / np.linalg.norm(axis)
    v, t = np.asarray(vector, float), np.radians(degrees)
    x, y, z = v * np.cos(t) + np.cross(k, v) * np.sin(t) + k * (k @ v) * (1 - np.cos(t))
    return float(x), float(y), float(z)


def compound(*shapes: Any) -> Any:
    """Several cadquery shapes as one."""
    import cadquery as cq

    return cq.Compound.makeCompound(list(shapes))


class Rays:
    """The ray referee of one shape: it meshes the shape by itself, with OpenCASCADE's default triangulator."""

    def __init__(self, shape: Any, fineness: float = QUICK) -> None:
        from OCP.BRepBuilderAPI import BRepBuilderAPI_Copy

        own = BRepBuilderAPI_Copy(getattr(shape, "wrapped", shape), True, False).Shape()
        self.model = reference.from_shape(own, fineness)
        self._referee = referee.Referee(self.model)

    @classmethod
    def of_file(cls, path: Path, fineness: float = QUICK) -> Rays:
        """The same for a file."""
        return cls(reference.read_shape(path), fineness)

    @property
    def accuracy(self) -> float:
        """What to ask of the drawing, at scale 1."""
        return self.model.accuracy

    def faults(self, drawing: Drawing) -> list[str]:
        """What is drawn wrong or missing, in words; refuses a drawing in which there was nothing to judge."""
        from hlr.drawing.saving import render

        judged = self._referee.judge("model", "hlr", exchange.parse(render(drawing, "json")))
        assert judged.verdict is not None and judged.verdict.judged, "nothing was judged"
        return [str(judged.row), *judged.why()] if judged.row.bad else []

    def wrong(self, drawing: Drawing) -> int:
        """Samples of lines that are called visible or hidden and are not, missing ones aside."""
        from hlr.drawing.saving import render

        caster = judge.RayCaster(self.model)
        return judge.judge(exchange.parse(render(drawing, "json")), caster).wrong


def faultless(source: Any, shape: Any, views: Iterable[Any], fineness: float = QUICK) -> Iterator[Drawing]:
    """The drawings of a source, each found without fault by rays cast against `shape`."""
    import hlr

    rays = Rays(shape, fineness)
    for drawing in hlr.draw_views(source, list(views), hlr.Options(accuracy=rays.accuracy, **AT_SIZE)):
        faults = rays.faults(drawing)
        assert not faults, f"{drawing.view.name} {drawing.view.direction}:\n" + "\n".join(faults[:10])
        yield drawing
