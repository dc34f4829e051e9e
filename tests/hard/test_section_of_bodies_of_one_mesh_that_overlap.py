"""A section of one mesh of several bodies that overlap or stand on one another, as an STL file of an assembly has them.

Cut together, a post in a plate had one cut face with it. Its border was a trapezoid instead of a square, and of a post
whose bottom lies on the plane a film was left.
"""

from __future__ import annotations

import numpy as np
import pytest
import trimesh

from support.sections import measured_area, outlines_of, section

PLATE, POST = (0, 0, 0, 30, 20, 10), (18, 6, 6, 26, 14, 20)
"""The lower and the upper corner of a block."""


def block(x0, y0, z0, x1, y1, z1):
    return trimesh.creation.box(bounds=[(x0, y0, z0), (x1, y1, z1)])


def together(*meshes):
    whole = trimesh.util.concatenate(meshes)
    return np.asarray(whole.vertices), np.asarray(whole.faces)


def plan(drawing):
    """The visible straight lines of a view from above, by their ends in the model."""
    found = set()
    for line in drawing.visible:
        if line.kind != "hatch":
            assert len(line.points) == 2
            found.add(tuple(sorted(tuple(np.round(line.points3[k, :2], 6).tolist()) for k in (0, 1))))
    return found


def rectangle(x0, y0, x1, y1):
    a, b, c, d = (x0, y0), (x1, y0), (x1, y1), (x0, y1)
    return {tuple(sorted(side)) for side in ((a, b), (b, c), (c, d), (d, a))}


@pytest.mark.parametrize("height", [7.0, 8.3, 9.4])
def test_each_has_the_border_of_its_own_cut_face(height, picture):
    drawing = section(together(block(*PLATE), block(*POST)), "top", height)
    assert plan(drawing) == rectangle(0, 0, 30, 20) | rectangle(18, 6, 26, 14)
    assert measured_area(drawing) == pytest.approx(600.0, rel=0.1)
    picture(drawing)


def test_of_a_post_that_stands_on_the_plane_nothing_is_left():
    drawing = section(together(block(*PLATE), block(*POST)), "top", POST[2])
    assert plan(drawing) == rectangle(0, 0, 30, 20)


def test_a_hollow_stays_a_hollow_of_its_own_body():
    hollow = block(4, 4, 2, 12, 16, 8)
    hollow.invert()
    drawing = section(together(block(*PLATE), hollow, block(*POST)), "top", 7.0)
    assert plan(drawing) == rectangle(0, 0, 30, 20) | rectangle(4, 4, 12, 16) | rectangle(18, 6, 26, 14)
    assert measured_area(drawing) == pytest.approx(600.0 - 96.0, rel=0.1)


def test_where_the_plane_steps_it_is_so_as_well():
    both = section(together(block(*PLATE), block(*POST)), "top", (4.0, (15.0, 9.4)))
    alone = section(together(block(*PLATE)), "top", (4.0, (15.0, 9.4)))
    post = {line for line in outlines_of(both) - outlines_of(alone) if line[0]}
    assert len(post) == 4
    assert outlines_of(alone) <= outlines_of(both)
