"""A wheel of many wedges, each a part of its own: all of them meet at the axis, so no two may have the same hatch."""

from __future__ import annotations

import cadquery as cq
import numpy as np
import pytest

import hlr
from support.at_size import AT_SIZE

RADIUS = 60.0


def wheel(number: int) -> cq.Assembly:
    """Wedges that get smaller by a little, so that they have an order."""
    found = cq.Assembly()
    for k in range(number):
        ends = [2.0 * np.pi * (k + j) / number for j in (0, 1)]
        corners = [((RADIUS - k) * np.cos(end), (RADIUS - k) * np.sin(end)) for end in ends]
        found.add(cq.Workplane().polyline([(0.0, 0.0), *corners]).close().extrude(20), name=f"wedge {k:02}")
    return found


def hatches(drawing: hlr.Drawing) -> dict[str, tuple[float, float]]:
    """By part: degrees, and millimetres from line to line."""
    strokes: dict[str, list[np.ndarray]] = {}
    for line in drawing.lines:
        if line.kind == "hatch":
            strokes.setdefault(drawing.parts[line.part].name, []).append(line.points[[0, -1]])
    found = {}
    for part, lines in strokes.items():
        ends = np.array(lines)
        longest = ends[np.hypot(*(ends[:, 1] - ends[:, 0]).T).argmax()]
        way = (longest[1] - longest[0]) / np.hypot(*(longest[1] - longest[0]))
        apart = np.diff(np.unique((ends[:, 0] @ [-way[1], way[0]]).round(3)))
        angle = float(np.degrees(np.arctan2(way[1], way[0]))) % 180.0
        found[part] = round(angle, 1), round(float(apart[apart > 0.01].min()), 2)
    return found


@pytest.mark.parametrize("number", [9, 12, 16])
def test_each_has_a_hatch_of_its_own(number: int) -> None:
    found = hatches(hlr.draw(wheel(number), "top", section=10.0, **AT_SIZE))
    assert len(found) == number
    assert len(set(found.values())) == number


def test_picture(picture):
    picture(hlr.draw(wheel(12), "top", section=10.0, **AT_SIZE))
