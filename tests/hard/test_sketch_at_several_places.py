"""A sketch of CadQuery that stands at several places, or in which something is selected.

Drawn were its faces at the origin, once, wherever they stand; and with a selection, as after `vertices` or `push`,
nothing but what was selected. A workplane with sketches on its stack was refused. What CadQuery itself extrudes of a
sketch is all of its faces at all of its places, and that is what is drawn.
"""

from __future__ import annotations

import cadquery as cq
import pytest
from hard.brep import like, ring, walk

import hlr
from support.at_size import AT_SIZE
from support.expected import expect

PLACES = [(20.0, 0.0), (40.0, 10.0)]


def rings():
    return [
        ((a[0] + x, a[1] + y, 5.0), (b[0] + x, b[1] + y, 5.0)) for x, y in PLACES for r in (3, 1) for a, b in ring(r)
    ]


def washers():
    """Two washers on a plane at a height of 5."""
    plane = cq.Workplane(origin=(0, 0, 5)).pushPoints(PLACES)
    return plane.sketch().circle(3).circle(1, mode="s")


SOURCES = {
    "the sketch": washers,
    "with a selection": lambda: washers().push([(0, 0)]),
    "a workplane": lambda: washers().finalize(),
    "in a list": lambda: [washers()],
    "placed": lambda: cq.Workplane(origin=(0, 0, 5)).pushPoints(PLACES).placeSketch(washers().reset()),
}


@pytest.mark.parametrize("view", ["iso", "top", (2, 1, -1.3)])
@pytest.mark.parametrize("made", ["the sketch", "with a selection", "placed"])
def test_it_is_drawn_at_all_its_places(made, view, picture):
    drawing = hlr.draw(SOURCES[made](), view, **AT_SIZE)
    like(drawing, expect(drawing, rings()))
    if view == "iso" and made == "the sketch":
        picture(drawing)


@pytest.mark.parametrize("selected", ["vertices", "edges", "faces"])
def test_a_selection_changes_nothing(selected):
    sketch = cq.Sketch().rect(10, 6)
    drawing = hlr.draw(getattr(sketch, selected)(), "top", **AT_SIZE)
    like(drawing, expect(drawing, walk([(-5, -3, 0), (5, -3, 0), (5, 3, 0), (-5, 3, 0), (-5, -3, 0)])))


def test_a_sketch_is_one_part():
    assert [part.name for part in hlr.draw(washers(), "top").parts] == ["part"]


def test_edges_of_a_sketch_without_faces():
    drawing = hlr.draw(cq.Sketch().segment((0, 0), (10, 0)).segment((10, 5)), "top", **AT_SIZE)
    like(drawing, expect(drawing, walk([(0, 0, 0), (10, 0, 0), (10, 5, 0)])))
