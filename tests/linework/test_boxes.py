"""Drawings of boxes, known to the last digit: where lines end, split, hide and coincide."""

import numpy as np
import pytest

import hlr
from support.at_size import ALL_LINES, AT_SIZE
from support.measures import counts, drawn_twice, length, placed, straight
from support.models import box, parts, sheet, solids

BREP_AND_MESH = pytest.mark.parametrize("kind", ["brep", "mesh"])


def boxes(kind, *sizes):
    return solids(*sizes) if kind == "brep" else parts(*(box(*s) for s in sizes))


def seg(x0, y0, x1, y1, visible=True):
    return (*sorted(((x0, y0), (x1, y1))), visible)


def rectangle(x0, y0, x1, y1, visible=True):
    corners = [(x0, y0), (x1, y0), (x1, y1), (x0, y1)]
    return {seg(*a, *b, visible): 1 for a, b in zip(corners, corners[1:] + corners[:1], strict=True)}


@BREP_AND_MESH
@pytest.mark.parametrize(
    ("view", "width", "height"),
    [("front", 10, 30), ("back", 10, 30), ("left", 20, 30), ("right", 20, 30), ("top", 10, 20), ("bottom", 10, 20)],
)
def test_a_box_along_an_axis_is_four_lines_and_hides_nothing(kind, view, width, height):
    drawing = hlr.draw(boxes(kind, ((10, 20, 30), (0, 0, 0))), view, **AT_SIZE)
    assert len(drawing.lines) == 4
    assert straight(drawing) == rectangle(-width / 2, -height / 2, width / 2, height / 2)


@BREP_AND_MESH
@pytest.mark.parametrize("view", ["iso", "iso-sw", "iso-ne", "iso-nw", (3, -1, 2)])
@pytest.mark.parametrize("scale", [1.0, 0.5])
def test_a_box_seen_on_a_corner_shows_nine_edges_and_hides_three(kind, view, scale):
    drawing = hlr.draw(boxes(kind, ((10, 20, 30), (1, 2, 3))), view, scale=scale, **ALL_LINES)
    assert counts(drawing) == {("sharp", True): 9, ("sharp", False): 3}
    d = np.asarray(drawing.view.direction)
    # A length seen under an angle to the view direction shrinks by its sine.
    expected = [size * scale * float(np.sqrt(1 - d[k] ** 2)) for k, size in enumerate((10, 20, 30))]
    for visible, times in ((True, 3), (False, 1)):
        lengths = sorted(length(line) for line in drawing.lines if line.visible == visible)
        assert lengths == pytest.approx(sorted(expected * times), abs=1e-6)
    hidden = [tuple(p) for line in drawing.lines if not line.visible for p in line.points3.round(9).tolist()]
    far = tuple(c - s / 2 * np.sign(k) for c, s, k in zip((1, 2, 3), (10, 20, 30), d, strict=True))
    assert hidden.count(far) == 3


@BREP_AND_MESH
def test_a_bar_behind_a_box_is_split_at_the_box(kind):
    drawing = hlr.draw(boxes(kind, ((20, 20, 20), (0, 0, 0)), ((40, 4, 4), (0, 30, 0))), "front", **AT_SIZE)
    expected = rectangle(-10, -10, 10, 10)
    for z in (-2, 2):
        expected |= {seg(-20, z, -10, z): 1, seg(-10, z, 10, z, False): 1, seg(10, z, 20, z): 1}
    expected |= {seg(-20, -2, -20, 2): 1, seg(20, -2, 20, 2): 1}
    assert straight(drawing) == expected
    only = hlr.draw(
        boxes(kind, ((20, 20, 20), (0, 0, 0)), ((40, 4, 4), (0, 30, 0))), "front", hidden=False, scale=1.0, smooth=False
    )
    assert straight(only) == {piece: n for piece, n in expected.items() if piece[2]}


@BREP_AND_MESH
def test_a_box_wholly_behind_another_is_hidden(kind):
    drawing = hlr.draw(boxes(kind, ((20, 20, 20), (0, 0, 0)), ((4, 4, 4), (1, 30, 2))), "front", **AT_SIZE)
    assert straight(drawing) == rectangle(-10, -10, 10, 10) | rectangle(-1, 0, 3, 4, False)


@BREP_AND_MESH
def test_a_bar_through_a_box_is_split_where_it_enters(kind):
    drawing = hlr.draw(boxes(kind, ((20, 20, 20), (0, 0, 0)), ((40, 4, 4), (0, 0, 0))), "iso", **AT_SIZE)
    right, up = np.asarray(drawing.view.right), np.asarray(drawing.view.up)

    def at(x, y, z):
        p = np.array([x, y, z])
        return (round(float(p @ right), 6) + 0.0, round(float(p @ up), 6) + 0.0)

    found = straight(drawing)
    # The bar's edges leave the face x = 10 toward the viewer: visible from exactly there.
    for y, z in ((-2, -2), (-2, 2), (2, 2)):
        assert found[(*sorted((at(10, y, z), at(20, y, z))), True)] == 1
    # On the other side they are covered by the box, or come out from behind it at its left outline.
    ends = {p for a, b, _ in found for p in (a, b)}
    for y, z in ((-2, -2), (-2, 2), (2, -2), (2, 2)):
        assert at(10, y, z) in ends or (y, z) == (2, -2)
    assert drawn_twice(drawing) == 0


@BREP_AND_MESH
def test_boxes_on_top_of_one_another(kind):
    stack = boxes(kind, ((10, 10, 10), (0, 0, 5)), ((10, 10, 10), (0, 0, 15)))
    front = hlr.draw(stack, "front", **AT_SIZE)
    sides = {seg(x, z, x, z + 10): 1 for x in (-5, 5) for z in (0, 10)}
    assert straight(front) == sides | {seg(-5, z, 5, z): 1 for z in (0, 10, 20)}
    iso = hlr.draw(stack, "iso", **AT_SIZE)
    # The joint is there once, on both visible sides, and hidden once on the two others.
    joint = [line for line in iso.lines if np.allclose(line.points3[:, 2], 10)]
    assert sorted(line.visible for line in joint) == [False, False, True, True]
    assert drawn_twice(iso) == 0
    assert straight(hlr.draw(stack, "top", **AT_SIZE)) == rectangle(-5, -5, 5, 5)


@BREP_AND_MESH
def test_boxes_side_by_side_sharing_part_of_a_face(kind):
    pair = boxes(kind, ((10, 10, 10), (0, 0, 0)), ((10, 6, 6), (10, 0, 0)))
    front = hlr.draw(pair, "front", **AT_SIZE)
    assert straight(front) == rectangle(-5, -5, 5, 5) | {
        seg(5, -3, 15, -3): 1,
        seg(5, 3, 15, 3): 1,
        seg(15, -3, 15, 3): 1,
    }
    from_left = hlr.draw(pair, "left", **AT_SIZE)
    assert straight(from_left) == rectangle(-5, -5, 5, 5) | rectangle(-3, -3, 3, 3, False)
    from_right = hlr.draw(pair, "right", **AT_SIZE)
    assert straight(from_right) == rectangle(-5, -5, 5, 5) | rectangle(-3, -3, 3, 3)


@BREP_AND_MESH
def test_a_box_standing_on_a_plate(kind):
    model = boxes(kind, ((40, 40, 4), (0, 0, -2)), ((10, 10, 10), (0, 0, 5)))
    plate, foot = rectangle(-20, -20, 20, 20), (-5, -5, 5, 5)
    assert straight(hlr.draw(model, "top", **AT_SIZE)) == plate | rectangle(*foot)
    assert straight(hlr.draw(model, "bottom", **AT_SIZE)) == plate | rectangle(*foot, False)
    iso = hlr.draw(model, "iso", **AT_SIZE)
    base = [line for line in iso.lines if line.part == 1 and np.allclose(line.points3[:, 2], 0)]
    assert sorted(line.visible for line in base) == [False, False, True, True]
    assert sum(length(line) for line in base) == pytest.approx(4 * 10 * np.sqrt(2 / 3), rel=1e-6)
    assert drawn_twice(iso) == 0


def under_a_sheet(kind, size, **options):
    """A block whose top is 0.1 mm below what covers it, seen from above and from below."""
    block = ((0.5 * size, 0.5 * size, 5), (0, 0, -2.5))
    if kind == "open":
        model = parts(box(*block), sheet(size, 0.1))
    else:
        model = boxes(kind, block, ((size, size, 0.1), (0, 0, 0.05)))
    h = size / 2
    outer, inner = rectangle(-h, -h, h, h), rectangle(-h / 2, -h / 2, h / 2, h / 2, False)
    assert straight(hlr.draw(model, "bottom", **AT_SIZE | options)) == outer | rectangle(-h / 2, -h / 2, h / 2, h / 2)
    assert straight(hlr.draw(model, "top", **AT_SIZE | options)) == outer | inner


@pytest.mark.parametrize("kind", ["brep", "mesh", "open"])
@pytest.mark.parametrize("size", [20.0, 100.0, 500.0])
def test_a_thin_sheet_hides_what_lies_under_it(kind, size):
    under_a_sheet(kind, size, accuracy=0.05 if kind == "brep" else 0.01)


@pytest.mark.parametrize("kind", ["mesh", "open"])
def test_a_thin_sheet_over_a_mesh_hides_what_lies_under_it_at_the_default_accuracy(kind):
    under_a_sheet(kind, 100.0)


def test_a_thin_sheet_over_a_curved_part_hides_it_at_the_default_accuracy():
    import cadquery as cq

    disc = cq.Workplane().cylinder(5, 50).translate((0, 0, -2.5))
    cover = cq.Workplane().box(120, 120, 0.1).translate((0, 0, 0.05))
    drawing = hlr.draw(cq.Assembly().add(disc, name="disc").add(cover, name="sheet"), "top", **AT_SIZE)
    assert counts(drawing) == {("sharp", True): 4, ("sharp", False): 1}


@BREP_AND_MESH
def test_nothing_is_drawn_twice_where_equal_boxes_coincide(kind):
    one = ((10, 10, 10), (0, 0, 0))
    twins = hlr.draw(boxes(kind, one, one), "iso", **AT_SIZE)
    assert straight(twins) == straight(hlr.draw(boxes(kind, one), "iso", **AT_SIZE))


def test_lines_know_their_part_and_edge():
    import cadquery as cq

    drawing = hlr.draw(solids(((10, 10, 10), (0, 0, 0)), ((4, 4, 4), (20, 0, 0))), "iso", **AT_SIZE)
    assert [part.name for part in drawing.parts] == ["part0", "part1"]
    for number, centre in ((0, 0), (1, 20)):
        mine = [line for line in drawing.lines if line.part == number]
        assert sorted({line.edge for line in mine}) == list(range(12))
        size = (10, 4)[number]
        edges = cq.Workplane().box(size, size, size).translate((centre, 0, 0)).val()
        import OCP.TopAbs
        import OCP.TopExp
        import OCP.TopTools

        index = OCP.TopTools.TopTools_IndexedMapOfShape()
        OCP.TopExp.TopExp.MapShapes_s(edges.wrapped, OCP.TopAbs.TopAbs_ShapeEnum.TopAbs_EDGE, index)
        for line in mine:
            edge = cq.Edge(index.FindKey(line.edge + 1))
            middle = line.points3.mean(axis=0)
            assert edge.distance(cq.Vertex.makeVertex(*middle.tolist())) < 1e-6
    mesh = hlr.draw(box((1, 1, 1)), "iso", scale=10, **ALL_LINES)
    assert {line.edge for line in mesh.lines} == {None} == {line.face for line in mesh.lines}


def test_lines_are_sorted_and_the_lower_left_corner_is_the_origin():
    drawing = hlr.draw(solids(((10, 10, 10), (0, 0, 0)), ((4, 4, 4), (20, 0, 0))), "iso", **AT_SIZE)
    keys = [(line.part, line.edge) for line in drawing.lines]
    assert keys == sorted(keys)
    assert drawing.bounds[:2] == (0.0, 0.0)
    lowest = np.concatenate([placed(drawing, line) for line in drawing.lines]).min(axis=0)
    assert tuple(lowest) == pytest.approx(drawing.origin)


def test_the_measures_notice():
    drawing = hlr.draw(
        parts(box((10, 10, 10)), box((10, 10, 10), (0, 0, 0.02))), "front", hidden=True, scale=1.0, smooth=False
    )
    assert drawn_twice(drawing, width=0.05) == pytest.approx(20, abs=0.1)
