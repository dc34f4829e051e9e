"""Each triangle is there twice, once each way round, and some have no area: a mesh "made two-sided" by its exporter.

So every edge is used by four triangles and none is a contour; nothing is closed or open (KitchenPot.obj of CoACD:
11,632 of 11,638 triangles, besides 28 of no area and 62 open edges). Drawn like the mesh before it was spoilt.
"""

from __future__ import annotations

import numpy as np
import pytest
from hard.brep import same

import hlr
from support.at_size import AT_SIZE
from support.expected import agrees, by_oracle, wrong_by_rays
from support.meshes import BOX_EDGES, BOX_QUADS, box, sphere, split


def tub():
    """A box without its lid: open, seen into."""
    points, _ = box((0, 0, 0), (30, 20, 12))
    return points, split(BOX_QUADS[:5])


def spoilt(mesh):
    points, triangles = mesh
    flat = np.array([[0, 0, 1], [2, 3, 3]], np.int32)
    return points, np.concatenate([triangles, triangles[:, ::-1], flat]).astype(np.int32)


@pytest.mark.parametrize("view", ["iso", "front", (1, -2, 3), (-1, 0.4, -0.5)])
def test_it_is_drawn_as_before(view, picture):
    sound, drawing = hlr.draw(tub(), view, **AT_SIZE), hlr.draw(spoilt(tub()), view, **AT_SIZE)
    same(sound, drawing)
    agrees(drawing, by_oracle(drawing, *tub(), BOX_EDGES))
    if view == "iso":
        picture(drawing)


def test_its_outlines_too():
    bowl = sphere(10, 48, 16, top=0.3)
    sound, drawing = hlr.draw(bowl, (1, -2, 1), **AT_SIZE), hlr.draw(spoilt(bowl), (1, -2, 1), **AT_SIZE)
    same(sound, drawing)
    judged, wrong = wrong_by_rays(drawing, *bowl)
    assert judged and not wrong


def test_the_defects_are_named():
    found = hlr.info(spoilt(tub()))
    assert found.parts[0].defects == ("10 duplicated triangles", "open: 4 border edges")
    assert "2 degenerate triangles" in found.notes[0].text
