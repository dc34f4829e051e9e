"""Intersection lines on paper: seen and unseen, in every writer, clipped, and left out where nobody wants them."""

from __future__ import annotations

import json
import re
import subprocess
import sys
from dataclasses import replace

import cadquery as cq
import numpy as np
import pytest
from scene.crossings import CROSSING, THROUGH, TOUCHING, bent, bore, eight, overlapping_boxes, tube

import hlr
from hlr.drawing.notes import Note
from hlr.drawing.saving import render
from support.at_size import ALL_LINES, AT_SIZE
from support.expected import differences, doubled, expect, ink, of_kind
from support.meshes import as_parts
from support.models import box, parts, solids

VIEW = (2, -3, 1)


def post():
    return solids(*CROSSING)


def ring(z):
    """The post's outline at a height, as edges."""
    x, low, high = 4, -2, 4
    corners = [(-x, low, z), (x, low, z), (x, high, z), (-x, high, z)]
    return list(zip(corners, [*corners[1:], corners[0]], strict=True))


def met(drawing, visible=None):
    return [line for line in of_kind(drawing, "intersection") if visible is None or line.visible is visible]


@pytest.mark.parametrize("model", [post, lambda: parts(*(box(*b) for b in CROSSING))], ids=["brep", "mesh"])
def test_a_post_in_a_block(model):
    drawing = hlr.draw(model(), VIEW, **AT_SIZE)
    front, right, back, left = ring(10)
    drawn = ink(replace(drawing, lines=tuple(met(drawing))))
    wanted = expect(drawing, [front, right], [back, left, *ring(-10)])
    assert not differences(wanted, drawn, drawing.accuracy.used)
    for line in met(drawing):
        assert (line.part, line.other, line.edge, line.face) == (0, 1, None, None)
        assert len(line.points) == len(line.points3)
    (seen,) = met(drawing, True)
    corners = seen.points3 if seen.points3[0, 0] < 0 else seen.points3[::-1]
    assert np.abs(corners - [(-4, -2, 10), (4, -2, 10), (4, 4, 10)]).max() < drawing.accuracy.used
    assert all(line.other is None for line in drawing.lines if line.kind != "intersection")


def test_openings_seen_along_the_post_lie_under_its_outline():
    """From above all four corners of both rectangles fall on the post's own edges: nothing is drawn twice."""
    drawing = hlr.draw(post(), "top", **AT_SIZE)
    assert not met(drawing)


@pytest.mark.parametrize("accuracy", [0.2, 0.02])
def test_parts_in_the_other_order(accuracy):
    one = hlr.draw(solids(*CROSSING), VIEW, accuracy=accuracy, **AT_SIZE)
    other = hlr.draw(solids(*CROSSING[::-1]), VIEW, accuracy=accuracy, **AT_SIZE)
    assert met(other) and {(line.part, line.other) for line in met(other)} == {(0, 1)}
    assert not differences(ink(one), ink(other), accuracy)


@pytest.mark.slow
@pytest.mark.parametrize("accuracy", [0.5, 0.05, 0.01])
@pytest.mark.parametrize("name", ["shaft in its bore, turned", "stack", "oblique stack", "coplanar", "ball on a plate"])
def test_what_touches_has_none(name, accuracy):
    for drawing in hlr.draw_views(TOUCHING[name](), ["iso", "front", VIEW], hlr.Options(accuracy=accuracy, **AT_SIZE)):
        assert drawing.lines and not met(drawing) and not drawing.notes


def test_two_tessellations_have_none():
    for drawing in hlr.draw_views(
        as_parts(tube(64, 0), tube(90, 0.37)), ["iso", "front", VIEW], hlr.Options(**AT_SIZE)
    ):
        assert drawing.lines and not met(drawing)


@pytest.mark.parametrize("scale", [0.1, 1, 20])
def test_a_bore_has_none_at_any_scale(scale):
    assert not met(hlr.draw(bore(17), "iso", scale=scale, **ALL_LINES))


# Without them.


@pytest.mark.parametrize("model", [post, eight], ids=["two parts", "through itself"])
def test_they_can_be_left_out(model):
    with_, without = (hlr.draw(model(), VIEW, intersections=on, **AT_SIZE) for on in (True, False))
    assert met(with_) and not met(without)
    # The rest stays, but for what lies under intersection lines.
    rest = [line for line in with_.lines if line.kind != "intersection"]
    near = with_.accuracy.used
    told = differences(ink(without), ink(replace(with_, lines=tuple(rest))), 2 * near)
    assert not [t for t in told if "should not" in t], told
    assert with_.notes == without.notes


def test_hidden_ones_go_with_hidden_lines():
    drawing = hlr.draw(post(), VIEW, hidden=False, scale=1.0, smooth=False)
    assert met(drawing, True) and not met(drawing, False)


@pytest.mark.slow
def test_on_the_command_line(tmp_path):
    model = tmp_path / "post.step"
    cq.exporters.export(cq.Workplane(obj=post().toCompound()), str(model))
    found = []
    for flag in ([], ["--intersections"], ["--no-intersections"]):
        out = tmp_path / "post.json"
        command = [sys.executable, "-P", "-m", "hlr", "draw", str(model), "-o", str(out), "--view", "2,-3,1", *flag]
        subprocess.run(command, check=True, capture_output=True)
        found.append(sum(line["class"] == "intersection" for line in json.loads(out.read_text())["lines"]))
    assert found[0] == found[1] > 0 == found[2]


# In files.


def test_json_names_both_parts():
    drawing = hlr.draw(post(), VIEW, **AT_SIZE)
    lines = json.loads(render(drawing, "json"))["lines"]
    assert len(lines) == len(drawing.lines)
    for line in lines:
        assert ("other" in line and line["other"] is not None) == (line["class"] == "intersection")
    crossing = [line for line in lines if line["class"] == "intersection"]
    assert crossing and all((line["part"], line["other"]) == (0, 1) for line in crossing)


def test_svg_names_both_parts():
    svg = render(hlr.draw(post(), VIEW, **AT_SIZE), "svg")
    svg = svg.decode() if isinstance(svg, bytes) else svg
    seen, unseen = (
        re.findall(r'<g class="intersection"[^>]*>\n(.*?</g>)\n</g>', svg[a:b], re.S)
        for a, b in ((svg.index('<g id="visible"'), None), (0, svg.index('<g id="visible"')))
    )
    assert len(seen) == len(unseen) == 1
    for group in (*seen, *unseen):
        paths = re.findall(r"<path [^>]*>", group)
        assert paths and all('data-other="1"' in path for path in paths)
        assert 'data-part="0"' in group and "data-edge" not in group
    assert svg.count("data-other") == seen[0].count("<path") + unseen[0].count("<path")


def test_a_part_that_meets_itself_is_named_twice():
    drawing = hlr.draw(eight(), VIEW, **AT_SIZE)
    assert {(line.part, line.other) for line in met(drawing)} == {(0, 0)}
    assert drawing.notes == (Note("defects", f'Part "part" is drawn as it is: {THROUGH}.'),)


# Perspective.


@pytest.mark.parametrize(
    ("eye", "target"),
    [((40, -60, 30), (0, 0, 0)), ((14, -16, 14), (0, 2, 10)), ((12, -14, 20), (4, 0, 10)), ((3, -9, 13), (0, 4, 10))],
)
@pytest.mark.parametrize("model", [post, lambda: parts(*(box(*b) for b in CROSSING))], ids=["brep", "mesh"])
def test_in_perspective_they_are_cut_with_everything_else(model, eye, target):
    camera = hlr.Perspective(eye=eye, target=target, fov=50)
    drawing = hlr.draw(model(), "iso", perspective=camera, **AT_SIZE)
    wanted = [np.asarray(edge, float) for edge in ring(10) + ring(-10)]
    assert met(drawing, True)
    for line in met(drawing):
        assert (line.part, line.other) == (0, 1)
        for p in line.points3:
            assert min(distance(p, *edge) for edge in wanted) < 1e-3
    # What of the front edge of the opening lies within the frame is there, seen or not.
    view = drawing.view
    right, up, away = np.asarray(view.right), np.asarray(view.up), -np.asarray(view.direction)
    half = np.tan(np.radians(25))
    runs = [(a, b) for line in met(drawing) for a, b in zip(line.points3[:-1], line.points3[1:], strict=True)]
    inside = 0
    for a, b in wanted[:4]:
        for t in np.linspace(0.02, 0.98, 25):
            p = a + t * (b - a)
            depth = (p - eye) @ away
            if depth > 0.5 and abs((p - eye) @ up) < 0.97 * half * depth > abs((p - eye) @ right) / 4 * 3:
                inside += 1
                if abs(p[1] + 2) < 1e-9 or abs(p[0] - 4) < 1e-9:
                    assert min(distance(p, *run) for run in runs) < 1e-2, p
    assert inside


def distance(p, a, b):
    t = np.clip((p - a) @ (b - a) / ((b - a) @ (b - a)), 0, 1)
    return np.linalg.norm(a + t * (b - a) - p)


# What is said.


def test_notes_reach_the_drawing():
    many = parts(box((9, 9, 9)), *(bent(0).apply_translation((20 * k, 0, 0)) for k in range(1, 8)))
    drawing = hlr.draw(many, "iso", **AT_SIZE)
    assert len(drawing.notes) == 6
    assert drawing.notes[0] == Note("defects", 'Part "part1" is drawn as it is: open: 3 border edges.')
    assert drawing.notes[-1] == Note("more-defects", "2 more parts have defects: see hlr info.")
    with pytest.raises(hlr.StrictError, match="part1"):
        hlr.draw(many, "iso", strict=True, **AT_SIZE)


def test_a_compound_of_overlapping_boxes_draws_its_seam():
    """A hexagon, behind one of the boxes; half of it is seen from the side."""
    drawing = hlr.draw(cq.Compound.makeCompound(overlapping_boxes()), (1, 1, 1), **AT_SIZE)
    (line,) = met(drawing)
    assert not line.visible and np.array_equal(line.points3[0], line.points3[-1]) and len(line.points3) == 7
    assert not drawing.notes
    assert met(hlr.draw(cq.Compound.makeCompound(overlapping_boxes()), (1, -1, 0.3), **AT_SIZE), True)


@pytest.mark.parametrize("view", ["iso", (2, -3, -1), "top", "bottom"])
def test_where_parts_that_cross_share_a_plane_no_line_is_drawn_twice(view):
    """Two bars through one another on one floor: there the lines of intersection are edges of the bars."""
    drawing = hlr.draw(solids(((30, 8, 6), (0, 0, 3)), ((8, 30, 10), (0, 0, 5))), view, **AT_SIZE)
    assert drawing.lines and doubled(drawing) == 0
    for line in met(drawing):
        assert {*np.round(np.abs(line.points3[:, 0]), 2)} <= {4.0}


def test_a_spindle_torus_is_drawn_without_a_tangle():
    for accuracy in (None, 0.1, 0.02):
        drawing = hlr.draw(cq.Solid.makeTorus(3, 5), (0.3, -1, 0.2), accuracy=accuracy, **AT_SIZE)
        assert not met(drawing)
