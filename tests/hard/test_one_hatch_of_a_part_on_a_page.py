"""Several sections on a page: a part has the same hatch in all of them (ISO 128), though it is large in one and small
in another, and touches other parts in each.
"""

from __future__ import annotations

import cadquery as cq
import numpy as np
import pytest

import hlr
from hlr.compare import compare

Hatch = tuple[float, float]
"""Degrees, and millimetres from line to line."""


def pump() -> cq.Assembly:
    """The lid touches the pin and the body at the front; at the left, the foot and the body."""
    bore = cq.Workplane().circle(10).extrude(60, both=True)
    parts = {
        "body": cq.Workplane().box(60, 40, 40).cut(bore),
        "pin": cq.Workplane().circle(10).extrude(30, both=True),
        "lid": cq.Workplane().box(60, 40, 6).translate((0, 0, 23)).cut(bore),
        "foot": cq.Workplane().box(8, 8, 8).translate((26, 0, 30)),
    }
    assembly = cq.Assembly()
    for name, shape in parts.items():
        assembly.add(shape, name=name)
    return assembly


def hatches(drawing: hlr.Drawing) -> dict[str, dict[str, Hatch]]:
    """By part and view."""
    strokes: dict[tuple[str, str], list[np.ndarray]] = {}
    for line in drawing.lines:
        if line.kind == "hatch":
            view, part = drawing.parts[line.part].name.split("/")
            strokes.setdefault((part, view), []).append(line.points[[0, -1]])
    found: dict[str, dict[str, Hatch]] = {}
    for (part, view), ends in strokes.items():
        way = np.ptp(np.array(ends), axis=1)[0] * np.sign(ends[0][1] - ends[0][0])
        across = np.array([-way[1], way[0]]) / np.linalg.norm(way)
        apart = np.diff(np.unique((np.array(ends)[:, 0] @ across).round(4)))
        angle = float(np.degrees(np.arctan2(way[1], way[0]))) % 180.0
        found.setdefault(part, {})[view] = round(angle, 3), round(float(apart[apart > 0.01].min()), 2)
    return found


@pytest.fixture(scope="module")
def drawing() -> hlr.Drawing:
    return hlr.draw_arranged(pump(), section={"front": 0.0, "left": 26.0, "top": 10.0}, page="A3")


def test_each_part_has_one(drawing):
    found = hatches(drawing)
    assert {part: len(views) for part, views in found.items()} == {"body": 3, "pin": 2, "lid": 2, "foot": 2}
    assert all(len(set(views.values())) == 1 for views in found.values())


def test_parts_that_touch_have_different_ones(drawing):
    found = {part: next(iter(views.values())) for part, views in hatches(drawing).items()}
    for one, other in (("body", "pin"), ("body", "lid"), ("pin", "lid"), ("lid", "foot")):
        assert found[one] != found[other]


@pytest.mark.parametrize(
    ("view", "place", "elsewhere"), [("front", 0.0, -9.5), ("left", 26.0, 16.5), ("top", 10.0, 28.0)]
)
def test_a_section_by_itself_is_the_same_as_on_the_page(drawing, view, place, elsewhere):
    """It has other hatches, in the same places; a section elsewhere has other places."""
    scale = drawing.sheet.views[0].scale
    found = compare(drawing, hlr.draw(pump(), view, section=place, scale=scale, page="A3"))
    assert found.same and bool(found.rehatched) == (view != "front")
    other = compare(drawing, hlr.draw(pump(), view, section=elsewhere, scale=scale, page="A3"))
    assert not other.same and any(each.line_class == "hatch" for each in other.differences)


@pytest.mark.parametrize(("view", "place"), [("front", 0.0), ("left", 26.0), ("top", 10.0)])
def test_the_only_section_of_a_page_has_the_hatch_that_it_has_by_itself(view, place):
    page = hlr.draw_arranged(pump(), section={view: place}, page="A3")
    alone = hlr.draw(pump(), view, section=place, scale=page.sheet.views[0].scale, page="A3")
    strokes = []
    for found in (page, alone):
        ends = np.array([line.points[[0, -1]] for line in found.lines if line.kind == "hatch"])
        strokes.append(ends - ends.reshape(-1, 2).min(axis=0))
    assert np.allclose(*strokes, atol=1e-6)
