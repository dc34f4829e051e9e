"""Parts that are sunk into others by little: one line is drawn where they meet, not two side by side, and not none.

The sunk part's own edge lies behind the wall by a few accuracies. Seen at right angles to the wall it is drawn, as if
the parts touched; seen at a slant it is hidden. The line in which the surfaces meet runs beside it on paper, nearer
than ink is wide. Seen in an engine and a motor, in which parts are sunk by 0.05 to 0.15 mm on paper: doubled dashes
along flanges, and short bits over a circle.
"""

from __future__ import annotations

import cadquery as cq
import numpy as np
import pytest
import trimesh

import hlr
from support.at_size import AT_SIZE
from support.meshes import as_parts
from support.missing_ink import missing, visible_segments
from support.side_by_side import side_by_side

ACCURACY = 0.05
DEPTHS = [0.2, 0.6, 1.2, 1.6, 2.0, 2.4]
"""Accuracies."""
DEEP = 20.0
"""Accuracies: nobody takes that for a contact."""
MOST_MISSED = 0.2
"""Millimetres."""
VIEWS = ["front", "top", "iso", (1, -2, 0.3), (2, -1, 1.2), (1, 1, 3)]


def pair(wall, foot):
    return cq.Assembly().add(wall, name="wall").add(foot, name="foot")


def strap_on_a_drum(depth):
    strap = cq.Workplane().box(120, 30, 20).translate((110, 0, 20))
    return pair(cq.Workplane().cylinder(160, 60), strap.cut(cq.Workplane().cylinder(400, 60 - depth)))


def pin_on_a_drum(depth):
    pin = cq.Workplane("YZ").circle(14).extrude(100)
    return pair(cq.Workplane().cylinder(160, 60), pin.cut(cq.Workplane().cylinder(400, 60 - depth)))


def post_on_a_plate(depth):
    plate = cq.Workplane().box(120, 120, 20).translate((0, 0, -10))
    return pair(plate, cq.Workplane().box(30, 40, 50).edges("|Z").fillet(8).translate((0, 0, 25 - depth)))


def leaning_post(depth):
    post = cq.Workplane().box(30, 40, 120).rotate((0, 0, 0), (0, 1, 0), 30)
    above = cq.Workplane().box(300, 300, 100).translate((0, 0, 50 - depth))
    return pair(cq.Workplane().box(160, 120, 20).translate((0, 0, -10)), post.intersect(above))


def cup_on_a_ball(depth):
    cup = cq.Workplane().cylinder(60, 20).translate((0, 0, 70)).cut(cq.Workplane().sphere(50 - depth))
    return pair(cq.Workplane().sphere(50), cup)


def ring_on_a_cone(depth):
    def cone(less):
        return cq.Workplane(cq.Solid.makeCone(60 - less, 30 - less, 80))

    return pair(cone(0), cq.Workplane().cylinder(20, 70).translate((0, 0, 40)).cut(cone(depth)))


MODELS = [strap_on_a_drum, pin_on_a_drum, post_on_a_plate, leaning_post, cup_on_a_ball, ring_on_a_cone]
"""The sides of each foot are the same at any depth, and so is the line in which they meet the wall."""


def drawn(model, view):
    return hlr.draw(model, view, accuracy=ACCURACY, **AT_SIZE)


@pytest.mark.parametrize("depths", DEPTHS)
@pytest.mark.parametrize("model", MODELS)
def test_no_line_runs_beside_another(model, depths):
    shape = model(depths * ACCURACY)
    assert {view: side_by_side(drawn(shape, view)) for view in VIEWS} == dict.fromkeys(VIEWS, 0.0)


@pytest.mark.parametrize("model", MODELS)
def test_a_line_is_seen_wherever_a_deep_foot_has_one(model):
    wanted = {view: visible_segments(drawn(model(DEEP * ACCURACY), view), {"intersection"}) for view in VIEWS}
    assert sum(len(segments) > 0 for segments in wanted.values()) >= 3
    for depths in DEPTHS:
        shape = model(depths * ACCURACY)
        for view, segments in wanted.items():
            if len(segments):
                assert missing(segments, visible_segments(drawn(shape, view)), 3.0 * ACCURACY) <= MOST_MISSED, (
                    depths,
                    view,
                )


def test_picture(picture):
    picture(drawn(strap_on_a_drum(1.6 * ACCURACY), "iso"))


def test_coarse_facets_of_a_shaft_and_its_bore_make_no_lines_along_it():
    """They cross by more than the accuracy, between rims that go as deep: 4 mm of the shaft are in the bore."""
    facets, radius = 40, 20.0
    assert 1.0 < radius * (1.0 - np.cos(np.pi / facets)) / ACCURACY < 2.5
    shaft = trimesh.creation.cylinder(radius, 40.0, sections=facets)
    bore = trimesh.creation.annulus(radius, 35.0, 40.0, sections=facets)
    bore.apply_transform(trimesh.transformations.rotation_matrix(np.pi / facets, (0, 0, 1)))
    bore.apply_translation((0, 0, 36.0))
    drawing = drawn(as_parts(*((x.vertices, x.faces) for x in (shaft, bore))), "front")
    along = [np.ptp(x.points3[:, 2]) for x in drawing.lines if x.kind == "intersection"]
    assert max(along, default=0.0) < 1.0
