"""Filled drawings: what is painted is what is seen, without gaps, in the parts' colours."""

import io
import re
import time

import numpy as np
import pytest
import trimesh

import hlr
from hlr.drawing.saving import render as written
from hlr.errors import OptionError
from support.at_size import ALL_LINES, AT_SIZE

CUBE = np.array([[x, y, z] for x in (0, 20) for y in (0, 20) for z in (0, 20)], float)
SIDES = np.array(
    [[0, 1, 3], [0, 3, 2], [4, 6, 7], [4, 7, 5], [0, 4, 5], [0, 5, 1], [2, 3, 7], [2, 7, 6], [0, 2, 6], [0, 6, 4],
     [1, 5, 7], [1, 7, 3]]
)  # fmt: skip


def cube(view="iso", **options):
    return hlr.draw((CUBE, SIDES), view=view, fill=True, **AT_SIZE | options)


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
    ring = trimesh.creation.annulus(4, 10, 3, sections=16)
    drawing = hlr.draw(ring, view="top", fill=True, **AT_SIZE)
    assert len(drawing.fill.part) == 1
    assert drawing.fill.faces.tolist() == [0, 2]
    outer, inner = (8.0 * r * r * np.sin(np.pi / 8) for r in (10, 4))
    assert area(drawing, 0) == pytest.approx(outer - inner, rel=1e-4)


def test_near_faces_are_painted_over_far_ones():
    import pypdfium2

    box = np.array([[x, y, z] for x in (0, 8) for y in (0, 8) for z in (0, 8)], float)
    points = np.concatenate([CUBE, box + [6, -12, 6], box + [30, 0, 0]])
    faces = np.concatenate([SIDES, SIDES + 8, SIDES + 16])
    drawing = hlr.draw((points, faces), view="front", fill=True, hidden=False, scale=1.0, smooth=False)
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
    plain = hlr.draw((CUBE, SIDES), **AT_SIZE)
    assert plain.fill is None and b'id="fill"' not in written(plain, "svg")
    # The lines are the same ones.
    assert svg.replace(group, "") == written(plain, "svg").decode()


@pytest.mark.slow
def test_the_same_bytes_each_time():
    for kind in ("svg", "pdf"):
        assert written(cube(threads=1), kind) == written(cube(threads=2), kind)


def test_parts_keep_their_colours(tmp_path):
    red = trimesh.creation.box((4, 4, 4))
    scene = trimesh.Scene([red, red.copy().apply_translation((9, 0, 0))])
    drawing = hlr.draw(scene, fill=True, **AT_SIZE)
    assert set(drawing.fill.part.tolist()) == {0, 1}
    assert len(drawing.fill.part) == 6


@pytest.mark.slow
def test_perspective_and_what_stands_behind_the_eye():
    camera = hlr.Perspective(eye=(60, -50, 40), target=(10, 10, 10))
    assert len(cube(perspective=camera).fill.part) == 3
    inside = hlr.Perspective(eye=(10, 10, 10), target=(10, 30, 10), fov=100.0)
    assert len(hlr.draw((CUBE, SIDES[:, ::-1]), fill=True, perspective=inside, **AT_SIZE).fill.part) >= 1


def test_fill_is_yes_or_no():
    with pytest.raises(OptionError, match="fill is yes or no"):
        hlr.draw((CUBE, SIDES), fill="yes", **AT_SIZE)


def painted(drawing, at, dots=8):
    """The colour of the drawing's PDF at a place on paper, (3,) 0 to 255."""
    import pypdfium2

    page = pypdfium2.PdfDocument(io.BytesIO(written(drawing, "pdf")))[0]
    picture = np.asarray(page.render(scale=dots * 25.4 / 72).to_pil().convert("RGB"), int)
    x0, y0, x1, y1 = drawing.bounds
    wide, high = (v / 72 * 25.4 for v in page.get_size())
    x, y = at[0] - (x0 + x1 - wide) / 2, (y0 + y1 + high) / 2 - at[1]
    return picture[int(y * dots), int(x * dots)]


def middle(drawing):
    x0, y0, x1, y1 = drawing.bounds
    return np.array([(x0 + x1) / 2, (y0 + y1) / 2])


def shown(source, **options):
    """The colour that a preview has in its middle."""
    return hlr.preview(source, size=(200, 200), **options).pixels[100, 100, :3].astype(int)


@pytest.mark.slow
def test_each_face_has_its_own_colour():
    mesh = trimesh.Trimesh(CUBE, SIDES, process=False)
    colours = np.array([(200, 30, 30), (30, 200, 30), (30, 30, 200), (200, 200, 30), (200, 30, 200), (30, 200, 200)])
    mesh.visual.face_colors = np.column_stack([np.repeat(colours, 2, axis=0), np.full(12, 255)]).astype(np.uint8)
    for view in ("front", "back", "left", "right", "top", "bottom"):
        drawing = hlr.draw(mesh, view=view, fill=True, **AT_SIZE)
        assert painted(drawing, middle(drawing)) == pytest.approx(shown(mesh, view=view), abs=2)


@pytest.mark.slow
def test_glass_shows_what_it_contains_and_keeps_its_opacity():
    inside = trimesh.Trimesh(0.4 * CUBE + 6.0, SIDES, process=False)
    inside.visual.face_colors = np.tile(np.array((220, 20, 20, 255), np.uint8), (12, 1))
    glass = trimesh.Trimesh(CUBE, SIDES, process=False)
    glass.visual.face_colors = np.tile(np.array((40, 90, 220, 90), np.uint8), (12, 1))
    scene = trimesh.Scene([glass, inside])
    drawing = hlr.draw(scene, view="front", fill=True, **AT_SIZE)
    seen = painted(drawing, middle(drawing))
    assert seen[0] > 1.2 * seen[2]
    assert seen == pytest.approx(shown(scene, view="front"), abs=2)
    # Before nothing both walls of the box together, as in a picture without background.
    beside = hlr.preview(scene, view="front", size=(200, 200), background="transparent").pixels[100, 20, 3]
    clear = drawing.fill.colors[drawing.fill.colors[:, 3] < 255]
    assert clear[:, 3].tolist() == pytest.approx([beside], abs=1)
    told = re.search(r'fill-opacity="([.0-9]+)" stroke="none"', written(drawing, "svg").decode())
    assert float(told[1]) == pytest.approx(clear[0, 3] / 255, abs=1e-3)


def test_a_cylinder_is_one_area_with_a_gradient():
    import cadquery as cq

    shaft = cq.Workplane("YZ").circle(5).extrude(40)
    drawing = hlr.draw(shaft, view="front", fill=True, **AT_SIZE)
    filled = drawing.fill
    assert len(filled.part) == len(filled.gradients) == 1 and filled.gradient.tolist() == [0]
    gradient = filled.gradients[0]
    # Across the axis, which lies along x.
    assert abs(gradient.end[0] - gradient.start[0]) < 0.01 * abs(gradient.end[1] - gradient.start[1])
    assert gradient.shares[0] == 0.0 and gradient.shares[-1] == 1.0
    picture = hlr.preview(shaft, view="front", size=(460, 200)).pixels.astype(int)
    tall = np.flatnonzero((picture[:, 230, :3] < 250).any(axis=1))
    x, y = middle(drawing)
    for share in (0.2, 0.35, 0.5, 0.65, 0.8):
        row = round(tall[0] + share * (tall[-1] - tall[0]))
        assert painted(drawing, (x, y + 5 - 10 * share)) == pytest.approx(picture[row, 230, :3], abs=4)


def test_bands_of_light_are_narrow_and_leave_no_gap():
    ball = trimesh.creation.icosphere(4, 20.0)
    drawing = hlr.draw(ball, fill=True, **AT_SIZE)
    tones = np.sort(drawing.fill.colors[:, 0].astype(int))
    assert len(tones) > 20 and np.diff(tones).max() <= 5
    # Each is what is at least as light as itself: all lie within the first.
    sizes = [area(drawing, k) for k in range(len(drawing.fill.part))]
    assert sizes == sorted(sizes, reverse=True)
    assert sizes[0] == pytest.approx(np.pi * 400, rel=0.01)


@pytest.mark.slow
@pytest.mark.parametrize("turn", [0.0, 0.3, 1.1])
def test_a_hundred_sheets_through_one_another_take_bounded_time(turn):
    """No order of painting exists, and cutting them all by one another makes hundreds of thousands of pieces."""
    rng = np.random.default_rng(5)
    middle_, u, v = rng.uniform(-20, 20, (3, 120, 3))
    corners = np.stack([middle_ - u - v, middle_ + u - v, middle_ + u + v, middle_ - u + v], axis=1).reshape(-1, 3)
    faces = (np.array([(0, 1, 2), (0, 2, 3)])[None] + 4 * np.arange(120)[:, None, None]).reshape(-1, 3)
    begin = time.process_time()
    drawing = hlr.draw(
        (corners, faces),
        view=(1, 1, 1 + turn),
        fill=True,
        hidden=False,
        intersections=False,
        fit=(90, 90),
        smooth=False,
    )
    (row,) = [d for d in drawing.plan if d.name == "fill"]
    assert row.on and "looked up every 0.05 mm" in row.reason
    assert time.process_time() - begin < 60.0
    # One area per sheet that shows, whatever lies across it.
    assert 60 < len(drawing.fill.part) <= 120


def test_where_two_sheets_pass_through_one_another_the_border_is_exact():
    one = np.array([(-10, -10, -10), (10, -10, -10), (10, 10, 10), (-10, 10, 10)], float)
    two = np.array([(-10, 10, -10), (10, 10, -10), (10, -10, 10), (-10, -10, 10)], float)
    faces = np.array([(0, 1, 2), (0, 2, 3), (4, 5, 6), (4, 6, 7)])
    drawing = hlr.draw((np.concatenate([one, two]), faces), view="front", fill=True, **AT_SIZE)
    # From the front the nearer halves are seen: the lower one of the first, the upper one of the second.
    assert sorted(area(drawing, k) for k in range(len(drawing.fill.part))) == pytest.approx([200, 200], rel=1e-4)


@pytest.mark.slow
def test_corners_lie_where_the_model_has_them():
    rng = np.random.default_rng(2)
    for _ in range(5):
        way = rng.normal(size=3)
        drawing = hlr.draw((CUBE, SIDES), view=tuple(way), fill=True, **AT_SIZE)
        ends = np.concatenate([line.points[[0, -1]] for line in drawing.lines])
        apart = np.linalg.norm(drawing.fill.points[:, None] - ends[None], axis=2).min(axis=1)
        assert apart.max() < 0.05 and np.median(apart) < 1e-3


def test_a_gradient_in_the_files():
    import cadquery as cq

    drawing = hlr.draw(cq.Workplane().cylinder(20, 5), view="iso", fill=True, **AT_SIZE)
    svg = written(drawing, "svg").decode()
    assert svg.count("<linearGradient") == len(drawing.fill.gradients) == 1
    assert 'fill="url(#gradient-0)" stroke="url(#gradient-0)"' in svg
    data = written(drawing, "pdf")
    assert b"/ShadingType 2" in data and b"/Pattern" in data


@pytest.mark.slow
def test_glass_that_stands_on_a_floor_has_an_even_bottom():
    import cadquery as cq

    assembly = cq.Assembly()
    assembly.add(cq.Workplane().circle(30).extrude(-0.5), name="floor", color=cq.Color(0.9, 0.9, 0.8, 1.0))
    case = cq.Workplane().box(20, 20, 20, centered=(True, True, False))
    assembly.add(case, name="case", color=cq.Color(0.6, 0.7, 0.9, 0.35))
    filled = hlr.draw(assembly, fill=True, scale=2, **ALL_LINES).fill
    # The floor alone and through two walls, its rim, and the glass before nothing.
    assert len(filled.loops) - 1 < 16


@pytest.mark.slow
@pytest.mark.parametrize("top", [0.0, 12.0])
def test_a_cone_has_no_bands(top):
    """Its light is a fan of narrow wedges, each a level of the screen apart; none goes astray at the apex."""
    import cadquery as cq
    import pypdfium2

    cone = cq.Workplane().add(cq.Solid.makeCone(30, top, 60))
    drawing = hlr.draw(cone, fill=True, hidden=False, scale=1.0, smooth=False)
    shown = hlr.preview(cone, antialias=False, size=(900, 900), background="transparent").pixels
    page = pypdfium2.PdfDocument(io.BytesIO(written(drawing, "pdf")))[0]
    picture = np.asarray(page.render(scale=4 * 25.4 / 72).to_pil().convert("RGB")).astype(int)[:, :, 0]
    # Along rows, where no black line is near: a border of bands is a step between two even stretches.
    for row in picture[:: len(picture) // 40]:
        free = np.convolve(row < 60, np.ones(13), "same") == 0
        steps = np.abs(np.diff(row))
        even = np.convolve(steps, [1, 1, 1, 1, 0, 1, 1, 1, 1], "same") == 0
        assert steps[even & free[1:] & free[:-1]].max(initial=0) <= 1
    # As light as the preview, but for a few pixels at the apex, where a normal is none of the surface's.
    solid = shown[..., 3] > 0
    assert abs(int(np.percentile(shown[solid][:, 0], 99)) - int(drawing.fill.colors[:, 0].max())) <= 2
    colours = np.unique(drawing.fill.colors[:, 0].astype(int))
    assert np.sort(np.diff(colours))[-2] <= 2 and len(drawing.fill.gradients) == 0
    # The same areas are in the SVG.
    assert len(re.findall("data-part", drawing.to_svg().split('id="visible"')[0])) > 60
