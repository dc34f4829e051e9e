"""Small drawings made by hand."""

import math
from dataclasses import replace

import numpy as np

from hlr.drawing.curve import Arc, Bezier
from hlr.drawing.drawing import Accuracy, Drawing, DrawnPart, DrawnView
from hlr.drawing.line import Line
from hlr.drawing.notes import Note
from hlr.drawing.page import centred

ISO = DrawnView(
    "iso",
    "orthographic",
    (0.5773502691896258, -0.5773502691896258, 0.5773502691896258),
    (0.7071067811865475, 0.7071067811865475, 0.0),
    (-0.4082482904638631, 0.4082482904638631, 0.8164965809277261),
)


def line(points, kind="sharp", visible=True, *, part=0, edge=None, face=None):
    points = np.array(points, dtype=float)
    points3 = np.column_stack([points, np.zeros(len(points))])
    return Line(kind, visible, part, edge, face, points, points3)


def arc(centre, major, minor, angles, turn=0.0, **of):
    c, s = math.cos(turn), math.sin(turn)
    axes = np.array([[major * c, major * s], [-minor * s, minor * c]])
    curve = Arc(np.array(centre, float), axes, np.array(angles, float))
    return replace(line(curve.at(curve.angles), **of), curve=curve)


def bezier(degree, points, **of):
    curve = Bezier(degree, np.array(points, float))
    return replace(line(curve.points[[0, -1]], **of), curve=curve)


def part(name="box", color=None):
    return DrawnPart(name, color, np.eye(4))


def drawing(lines, accuracy=0.05, parts=None, **changes):
    used = max((entry.part for entry in lines), default=0)
    made = Drawing(
        source="box.step",
        view=ISO,
        scale=1.0,
        origin=(0.0, 0.0),
        accuracy=Accuracy(None, accuracy, 0.02, 0.1),
        unit=1.0,
        up_axis=((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)),
        parts=tuple(parts or (part(f"part {i}") for i in range(used + 1))),
        lines=tuple(lines),
    )
    return replace(made, **changes)


def on_page():
    """The sample in the middle of an A4 sheet."""
    made = sample()
    return replace(made, page=centred("A4", 297.0, 210.0, made.bounds))


def sample():
    """Every line class, visible and hidden; two parts, one with a name that XML and JSON must escape."""
    lines = [
        line([[0, 0], [40, 0], [40, 30], [0, 30], [0, 0]], edge=1),
        line([[5, 5], [5, 25]], edge=2, visible=False),
        line([[5, 25], [35, 25]], edge=2, visible=False),
        line([[20 + 8 * np.cos(t), 15 + 8 * np.sin(t)] for t in np.linspace(0, 2 * np.pi, 25)], "outline", face=3),
        line([[10, 2], [30.125, 2.0625]], "smooth", part=1, edge=4),
        line([[10, 28], [30, 28]], "seam", part=1, edge=5),
        line([[-0.5, 12], [-10, 15]], "boundary", part=1),
        line([[12, 12], [28, 18.4]], "intersection", part=1),
        line([[12, 18], [28, 12]], "outline", visible=False, part=1, face=2),
        line([[2, 2], [9, 2]], "smooth", visible=False, part=1, edge=6),
    ]
    return drawing(
        lines,
        parts=[part(), part('M6 <bolt> & "nut" ü\x07', (1.0, 0.5, 0.0))],
        notes=(Note("not-meshed", "part 3 could not be read"),),
        counters={"segments": np.int64(10)},
        timings={"source": 0.5, "total": 0.75},
    )
