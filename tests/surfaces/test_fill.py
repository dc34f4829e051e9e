"""Filled drawings: what is painted is what is seen, without gaps, in the parts' colours."""

import io
import re

import numpy as np
import pytest
from surfaces.test_coverage import ball

import hlr
from hlr.errors import OptionError
from hlr.surfaces import fill, regions
from hlr.surfaces.polygons import polygons_of
from hlr.writers import render as written

CUBE = np.array([[x, y, z] for x in (0, 20) for y in (0, 20) for z in (0, 20)], float)
SIDES = np.array(
    [[0, 1, 3], [0, 3, 2], [4, 6, 7], [4, 7, 5], [0, 4, 5], [0, 5, 1], [2, 3, 7], [2, 7, 6], [0, 2, 6], [0, 6, 4],
     [1, 5, 7], [1, 7, 3]]
)  # fmt: skip


def cube(view="iso", **options):
    return hlr.draw((CUBE, SIDES), view=view, fill=True, **options)


def area(drawing, face):
    """Of one filled face, square millimetres."""
    total = 0.0
    for k in range(drawing.fill.faces[face], drawing.fill.faces[face + 1]):
        p = drawing.fill.points[drawing.fill.loops[k] : drawing.fill.loops[k + 1]]
        q = np.roll(p, -1, axis=0)
        total += 0.5 * float((p[:, 0] * q[:, 1] - p[:, 1] * q[:, 0]).sum())
    return abs(total)


def test_coplanar_triangles_become_one_face():
    drawing = cube()
    assert len(drawing.fill.part) == 3
    # Each side of a cube of 20 is foreshortened to 400 / sqrt(3).
    assert [area(drawing, k) for k in range(3)] == pytest.approx([400 / 3**0.5] * 3, rel=1e-4)
    low, high = drawing.fill.points.min(axis=0), drawing.fill.points.max(axis=0)
    assert (*low, *high) == pytest.approx(drawing.bounds, abs=1e-3)


def test_the_lamp_is_at_the_viewers_shoulder():
    drawing = cube()
    grey = sorted(drawing.fill.colors[:, 0].tolist())
    assert grey[0] < grey[1] < grey[2] < 0.76 * 255
    top = max(range(3), key=lambda k: drawing.fill.points[drawing.fill.loops[k] : drawing.fill.loops[k + 1], 1].mean())
    assert drawing.fill.colors[top, 0] == grey[2]


def test_a_face_keeps_its_hole():
    import trimesh

    ring = trimesh.creation.annulus(4, 10, 3, sections=16)
    drawing = hlr.draw(ring, view="top", fill=True)
    assert len(drawing.fill.part) == 1
    assert drawing.fill.faces.tolist() == [0, 2]
    outer, inner = (8.0 * r * r * np.sin(np.pi / 8) for r in (10, 4))
    assert area(drawing, 0) == pytest.approx(outer - inner, rel=1e-4)


def test_near_faces_are_painted_over_far_ones():
    import pypdfium2

    box = np.array([[x, y, z] for x in (0, 8) for y in (0, 8) for z in (0, 8)], float)
    points = np.concatenate([CUBE, box + [6, -12, 6], box + [30, 0, 0]])
    faces = np.concatenate([SIDES, SIDES + 8, SIDES + 16])
    drawing = hlr.draw((points, faces), view="front", fill=True, hidden=False)
    page = pypdfium2.PdfDocument(io.BytesIO(written(drawing, "pdf")))[0]
    picture = np.asarray(page.render(scale=4 * 25.4 / 72).to_pil().convert("L"))
    # Between the lines there is no white: no gap within a face, nor where one ends over another.
    x0, y0, x1, y1 = drawing.bounds
    left, top = (np.array(page.get_size()) / 72 * 25.4 - (x1 - x0, y1 - y0)) / 2 * 4
    inside = picture[int(top) + 4 : int(top + 20 * 4) - 4, int(left) + 4 : int(left + 20 * 4) - 4]
    assert inside.max() < 200


def test_svg_and_pdf_carry_the_faces():
    drawing = cube()
    svg = written(drawing, "svg").decode()
    group = svg[svg.index('<g id="fill"') : svg.index('<g id="hidden"')]
    assert len(re.findall(r'<path d="[^"]*" data-part=', group)) == 3
    assert len(set(re.findall(r'fill="(#[0-9a-f]{6})" stroke="\1"', group))) == 3
    assert b"Fill" in written(drawing, "pdf")
    plain = hlr.draw((CUBE, SIDES))
    assert plain.fill is None and b'id="fill"' not in written(plain, "svg")
    # The lines are the same ones.
    assert svg.replace(group, "") == written(plain, "svg").decode()


def test_the_same_bytes_each_time():
    for kind in ("svg", "pdf"):
        assert written(cube(threads=1), kind) == written(cube(threads=2), kind)


def test_parts_keep_their_colours(tmp_path):
    import trimesh

    red = trimesh.creation.box((4, 4, 4))
    scene = trimesh.Scene([red, red.copy().apply_translation((9, 0, 0))])
    drawing = hlr.draw(scene, fill=True)
    assert set(drawing.fill.part.tolist()) == {0, 1}
    assert len(drawing.fill.part) == 6


def test_perspective_and_what_stands_behind_the_eye():
    camera = hlr.Perspective(eye=(60, -50, 40), target=(10, 10, 10))
    assert len(cube(perspective=camera).fill.part) == 3
    inside = hlr.Perspective(eye=(10, 10, 10), target=(10, 30, 10), fov=100.0)
    assert len(hlr.draw((CUBE, SIDES[:, ::-1]), fill=True, perspective=inside).fill.part) >= 1


def test_a_painters_order_too_long_is_found_by_the_tree(monkeypatch):
    monkeypatch.setattr(fill, "PATIENCE", 0)
    drawing = cube()
    assert sum(area(drawing, k) for k in range(len(drawing.fill.part))) == pytest.approx(400 * 3**0.5, rel=1e-4)


def test_too_many_faces_are_refused_in_one_sentence(monkeypatch):
    monkeypatch.setattr(fill, "MOST", 2)
    with pytest.raises(OptionError, match="3 faces are too many to be filled, 2 at most"):
        cube()


def test_fill_is_yes_or_no():
    with pytest.raises(OptionError, match="fill is yes or no"):
        hlr.draw((CUBE, SIDES), fill="yes")


def test_joining_keeps_curved_facets_apart():
    from hlr.scene.build import build
    from hlr.source import open_source

    mesh = ball()
    scene = build(open_source((mesh.points, mesh.corners.reshape(-1, 3))).mesh(0.1, 0.5), 30.0, 0.1)
    polygons, normals, part = regions.joined(scene, np.ones(len(scene.triangles), bool))
    assert len(polygons) == len(normals) == len(part)
    assert 0.5 * len(scene.triangles) < len(polygons) <= len(polygons_of(scene))
    np.testing.assert_allclose(np.linalg.norm(normals, axis=1), 1.0)
