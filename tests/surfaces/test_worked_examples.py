"""The literature's worked examples, each under its own name, with the tables they come with."""

import numpy as np
import pytest
from surfaces.random_scenes import SIZE, interpenetrating

from hlr.lab.methods import METHODS, SCREEN, BspTree, Screen, active_edges, crossing_pairs, render, spans, trace_svg

LARGER = Screen(nearer="larger")
ALL = [(method, variant) for method, variants in METHODS.items() for variant in (variants or (None,))]


def box(x0, y0, x1, y1, z):
    """A rectangle of pixels; z is a depth, or a function of x and y."""
    depth = z if callable(z) else lambda x, y: z
    return [(x, y, depth(x, y)) for x, y in ((x0, y0), (x1, y0), (x1, y1), (x0, y1))]


# 1. A frame of 4 x 4 pixels ------------------------------------------------------------------------------------------


FOUR_BY_FOUR = [
    box(2, 2, 4, 4, 4),
    box(1, 1, 3, 3, lambda x, y: 12 - x - y),  # 9 8 / 8 7 at the centres
    box(0, 2, 3, 4, lambda x, y: 7.5 - x),  # 7 6 5 in both rows
]


def test_1_four_by_four_frame():
    found = render(FOUR_BY_FOUR, LARGER, (4, 4), "z-buffer", variant="larger")
    far = -np.inf
    assert found.depth.tolist() == [[far] * 4, [far, 9, 8, far], [7, 8, 7, 4], [7, 6, 5, 4]]
    assert (found.ids + 1).tolist() == [[0, 0, 0, 0], [0, 2, 2, 0], [3, 2, 2, 1], [3, 3, 3, 1]]
    assert (found.statistics.comparisons, found.statistics.written) == (14, 12)


@pytest.mark.parametrize(("method", "variant"), ALL)
def test_1_is_the_same_by_every_method_and_convention(method, variant):
    # Where the second and the third overlap, the second is in front throughout: no method needs to split.
    ids = render(FOUR_BY_FOUR, LARGER, (4, 4), method, variant=variant).ids
    assert (ids + 1).tolist() == [[0, 0, 0, 0], [0, 2, 2, 0], [3, 2, 2, 1], [3, 3, 3, 1]]


def test_1_as_a_trace():
    found = render(FOUR_BY_FOUR, LARGER, (4, 4), trace=True)
    assert found.trace.tolist() == [
        [2, 2, 4, 0],
        [3, 2, 4, 0],
        [1, 1, 3, 1],
        [2, 1, 3, 1],
        [2, 0, 1, 2],
        [3, 0, 3, 2],
    ]
    drawn = trace_svg(FOUR_BY_FOUR, LARGER, (4, 4))
    assert drawn.count("data-id=") == len(found.trace) + 10
    assert 'class="pixels"' in drawn and 'class="edges"' in drawn


# 2. Two triangles and their active edges -----------------------------------------------------------------------------


def up(*corners):
    """Corners with y upward, as in the literature: y = 16 is the centre of the first row."""
    return [(x, 16.5 - y, 1) for x, y in corners]


A, B, C = (3, 1), (5, 15), (10, 5)
D, E, F = (6, 6), (9, 15), (13, 3)
NAMES = [["AB", "BC", "CA"], ["DE", "EF", "FD"]]


@pytest.mark.parametrize(
    ("y", "edges"),
    [
        (2, ["AB", "CA"]),
        (4, ["AB", "CA", "FD", "EF"]),  # two apart
        (9, ["AB", "DE", "BC", "EF"]),  # overlapping
        (13, ["AB", "BC", "DE", "EF"]),  # apart again
    ],
)
def test_2_active_edges_of_two_triangles(y, edges):
    found = active_edges([up(A, B, C), up(D, E, F)], SCREEN, (16, 17), 16 - y)
    assert [NAMES[polygon][edge] for polygon, edge, _ in found] == edges


def test_2_crossings_are_where_they_should_be():
    found = active_edges([up(A, B, C), up(D, E, F)], SCREEN, (16, 17), 16 - 9)
    assert [x for _, _, x in found] == pytest.approx([3 + 2 * 8 / 14, 7, 8, 11], abs=1e-9)


def test_2_edges_leave_before_the_row_of_their_end():
    # y_max is the row's own centre: [y_min, y_max) does not hold it.
    assert active_edges([box(1, 0.5, 3, 3.5, 1)], SCREEN, (4, 5), 3) == []
    assert len(active_edges([box(1, 0.5, 3, 3.5, 1)], SCREEN, (4, 5), 0)) == 2


# 3. Three polygons behind one another --------------------------------------------------------------------------------


ONE_ROW = [box(1, 0, 20, 1, 30), box(4, 0, 12, 1, 20), box(7, 0, 15, 1, 10)]  # GHIJ, ABC, DEF


@pytest.mark.parametrize(("variant", "comparisons"), [("naive", 4), ("leaving", 3), ("visible", 2)])
def test_3_comparisons_in_one_row(variant, comparisons):
    assert [x for _, _, x in active_edges(ONE_ROW, SCREEN, (24, 1), 0)] == [1, 4, 7, 12, 15, 20]
    found = render(ONE_ROW, SCREEN, (24, 1), "scan line", variant=variant)
    assert found.ids[0].tolist() == [-1] + [0] * 3 + [1] * 3 + [2] * 8 + [0] * 5 + [-1] * 4
    assert found.statistics.comparisons == comparisons


def test_3_leaving_the_obscuring_polygon_needs_a_comparison():
    # DEF ends first: which of the two behind it is next, nobody knows.
    polygons = [box(1, 0, 20, 1, 30), box(4, 0, 18, 1, 20), box(7, 0, 12, 1, 10)]
    counts = [
        render(polygons, SCREEN, (24, 1), "scan line", variant=v).statistics.comparisons for v in METHODS["scan line"]
    ]
    assert counts[1:] == [4, 4, 3]


# 4. 200, then 150 ----------------------------------------------------------------------------------------------------


def test_4_nearer_depth_replaces():
    pair = [box(0, 0, 1, 1, 200), box(0, 0, 1, 1, 150)]
    found = render(pair, SCREEN, (1, 1), "z-buffer")
    assert (found.ids.item(), found.depth.item(), found.statistics.written) == (1, 150, 2)
    other = render([box(0, 0, 1, 1, -200), box(0, 0, 1, 1, -150)], LARGER, (1, 1), "z-buffer", variant="larger")
    assert (other.ids.item(), other.depth.item(), other.statistics.written) == (1, -150, 2)


# 5. A cycle, and a triangle through a cube ---------------------------------------------------------------------------


def strips():
    """Three strips, each over the next."""
    return [
        box(2, 4, 28, 8, lambda x, y: x),
        [(24, 2, 10), (28, 2, 10), (14, 28, 36), (10, 28, 36)],
        [(2, 2, 20), (6, 2, 20), (20, 28, 25), (16, 28, 25)],
    ]


def test_5_strips_in_a_cycle_need_no_split_in_scan_lines():
    found = render(strips(), SCREEN, (30, 30), "scan line")
    assert found.statistics.splits == 0
    for method, variant in ALL:
        assert (render(strips(), SCREEN, (30, 30), method, variant=variant).ids == found.ids).all(), (method, variant)


def test_5_strips_overlap_in_a_cycle():
    def over(polygon, others):
        whole = render([strips()[polygon]], SCREEN, (30, 30)).ids == 0
        other = render([strips()[others]], SCREEN, (30, 30)).ids == 0
        seen = render([strips()[polygon], strips()[others]], SCREEN, (30, 30)).ids
        return (seen[whole & other] == 0).all() and (whole & other).any()

    assert over(0, 2) and over(1, 0) and over(2, 1)
    # A painter has to cut one of them.
    assert render(strips(), SCREEN, (30, 30), "depth sort").statistics.splits > 0


def cube_and_triangle():
    """A cube seen along its diagonal, a triangle through its visible faces; x right, y down, z away, in pixels."""
    cube = [
        [(1, -1, -1), (1, 1, -1), (1, 1, 1), (1, -1, 1)],
        [(-1, 1, -1), (-1, 1, 1), (1, 1, 1), (1, 1, -1)],
        [(-1, -1, 1), (1, -1, 1), (1, 1, 1), (-1, 1, 1)],
        [(-1, -1, -1), (-1, -1, 1), (-1, 1, 1), (-1, 1, -1)],
        [(-1, -1, -1), (1, -1, -1), (1, -1, 1), (-1, -1, 1)],
        [(-1, -1, -1), (-1, 1, -1), (1, 1, -1), (1, -1, -1)],
    ]
    through = [(1.6, 0.2, 0.2), (0.2, 1.6, 0.2), (0.2, 0.2, 1.6)]
    right, down, away = np.array([[1, -1, 0], [1, 1, -2], [-1, -1, -1]]) / np.sqrt([[2], [6], [3]])

    def seen(corner):
        p = np.array(corner, float)
        return (60 + 30 * right @ p, 60 + 30 * down @ p, 30 * away @ p)

    return [[seen(p) for p in polygon] for polygon in [*cube, through]]


def test_5_a_triangle_through_a_cube_shows_three_tips():
    scene = cube_and_triangle()
    found = render(scene, SCREEN, (120, 120), "scan line")
    assert found.statistics.splits > 0
    assert islands(found.ids == 6) == 3
    for method, variant in ALL:
        if variant not in ("naive", "leaving", "visible"):
            assert (render(scene, SCREEN, (120, 120), method, variant=variant).ids == found.ids).all(), (
                method,
                variant,
            )


def islands(mask):
    """How many connected regions."""
    left = set(map(tuple, np.argwhere(mask).tolist()))
    count = 0
    while left:
        count += 1
        border = [left.pop()]
        while border:
            y, x = border.pop()
            for near in ((y + 1, x), (y - 1, x), (y, x + 1), (y, x - 1)):
                if near in left:
                    left.remove(near)
                    border.append(near)
    return count


# 6. Flag counts ------------------------------------------------------------------------------------------------------


def test_6_flag_counts_of_two_surfaces():
    abc, efh = [(1, 13, 5), (5, 1, 5), (11, 13, 5)], [(14, 1, 2), (16, 13, 2), (7, 13, 2)]
    names = [["AB", "BC", "CA"], ["EF", "FH", "HE"]]

    def row(y):
        edges = [names[p][e] for p, e, _ in active_edges([abc, efh], SCREEN, (18, 14), y)]
        return edges, [len(inside) for _, _, inside in spans([abc, efh], SCREEN, (18, 14), y)]

    assert row(2) == (["AB", "BC", "HE", "EF"], [1, 0, 1])
    assert row(10) == (["AB", "HE", "BC", "EF"], [1, 2, 1])
    first, last, both = spans([abc, efh], SCREEN, (18, 14), 10)[1]
    assert both == [0, 1]
    for method, variant in ALL:
        ids = render([abc, efh], SCREEN, (18, 14), method, variant=variant).ids
        assert (ids[10, first:last] == 1).all() and ids[10, 3] == 0


def test_6_crossings_of_a_concave_polygon_are_paired_by_polygon():
    # Six crossings: of the concave one 1, 2, 4... as 1-2, 3-5 and 4-6.
    concave = [(1, 0, 1), (5, 0, 1), (6, 4, 1), (12, 0, 1), (17, 0, 1), (17, 8, 1), (1, 8, 1)]
    second = box(9.5, 0, 15, 2, 2)
    edges = active_edges([concave, second], SCREEN, (20, 9), 1)
    assert [polygon for polygon, _, _ in edges] == [0, 0, 1, 0, 1, 0]
    columns = [int(np.ceil(x - 0.5)) for _, _, x in edges]
    pairs = [
        (columns.index(a) + 1, columns.index(b) + 1)
        for row, a, b, _ in crossing_pairs([concave, second], SCREEN, (20, 9))
        if row == 1
    ]
    assert pairs == [(1, 2), (3, 5), (4, 6)]


# 7. Seen from the side -----------------------------------------------------------------------------------------------


def test_7_polygons_from_the_side():
    """In profile, the viewer to the left, rows downward; what is seen in each row stands at the left.

    ::

        row 0, 1   -
            2      0      ---0---
            3      0      ---0---        1
            4      1                     1
            5      2          2          1
            6      2           2
            7, 8   -
            9      3   3
            10     4       4     5
            11     5             5
            12     -
    """
    profile = [
        ((2, 10), (4, 10)),
        ((3, 40), (6, 40)),
        ((5, 20), (7, 22)),
        ((9, 4), (10, 4)),
        ((10, 12), (11, 12)),
        ((10, 30), (12, 30)),
    ]
    polygons = [[(0, a, z), (3, a, z), (3, b, w), (0, b, w)] for (a, z), (b, w) in profile]
    # Two more that lie along the view: edge-on, they are never painted.
    polygons += [[(0, 8, 1), (3, 8, 1), (3, 8, 50)], [(0, 2.5, 1), (3, 2.5, 1), (3, 2.5, 50), (0, 2.5, 50)]]
    for method, variant in ALL:
        found = render(polygons, SCREEN, (3, 13), method, variant=variant)
        assert found.ids[:, 1].tolist() == [-1, -1, 0, 0, 1, 2, 2, -1, -1, 3, 4, 5, -1], (method, variant)
        assert found.statistics.edge_on == 2


# 8. A BSP tree -------------------------------------------------------------------------------------------------------


def wall(x0, y0, x1, y1):
    """A wall on a plan, one unit high: seen from the plan's south or north it is a rectangle. x right, z = y away."""
    return [(x0, 0, y0), (x1, 0, y1), (x1, 8, y1), (x0, 8, y0)]


PLAN = [
    wall(2, 10, 22, 10),  # 0, between those in front and those beyond
    wall(4, 4, 10, 4),  # 1
    wall(14, 6, 20, 3),  # 2
    wall(5, 16, 11, 14),  # 3
    wall(12, 15, 19, 15),  # 4
    wall(6, 20, 18, 20),  # 5
]


def test_8_tree_of_six_polygons_and_its_order_from_two_viewpoints():
    tree = BspTree(PLAN)
    assert sorted(p for polygons, _, _ in tree.nodes for p in polygons) == [0, 1, 2, 3, 4, 5]
    assert tree.drawn() == DRAWN
    south, north = SCREEN, Screen(nearer="larger")
    assert tree.order(south, (24, 10)).tolist() == [5, 4, 3, 0, 2, 1]
    assert tree.order(north, (24, 10)).tolist() == [1, 2, 0, 3, 4, 5]
    for camera in (south, north):
        expected = render(PLAN, camera, (24, 10), "z-buffer")
        assert (tree.render(camera, (24, 10)).ids == expected.ids).all()
        # The order of the tree is one in which they can be drawn.
        picture = np.full((10, 24), -1)
        for polygon in tree.order(camera, (24, 10)):
            own = render([PLAN[polygon]], camera, (24, 10)).ids == 0
            picture[own] = polygon
        assert (picture == expected.ids).all()


DRAWN = """\
            5
        4
    3
0
    2
        1"""


# A pinwheel: the plane of each wall cuts the next one, though no two walls meet. Whatever is the root splits another.
SPLIT = [wall(4, 10, 14, 10), wall(20, 6, 16, 16), wall(12, 14, 18, 22)]

SPLIT_DRAWN = """\
    2
        1
0
    1"""


def test_8_a_plane_splits_a_polygon_and_both_pieces_have_their_place():
    tree = BspTree(SPLIT)
    assert [polygons for polygons, _, _ in tree.nodes].count([1]) == 2 and len(tree.nodes) == 4
    assert tree.drawn() == SPLIT_DRAWN
    south, north = SCREEN, Screen(nearer="larger")
    # One piece stands beyond the plane, the other before it, from either side.
    assert tree.order(south, (24, 10)).tolist() == [2, 1, 0, 1]
    assert tree.order(north, (24, 10)).tolist() == [1, 0, 1, 2]
    for camera in (south, north):
        found, expected = tree.render(camera, (24, 10)), render(SPLIT, camera, (24, 10), "z-buffer")
        assert (found.ids == expected.ids).all()
        assert render(SPLIT, camera, (24, 10), "bsp").statistics.splits == 1


def test_8_a_moved_part_is_let_in_again():
    tree = BspTree(PLAN)
    points = tree.polygons.points.copy()
    points[4:8, 2] += 9.0  # wall 1 goes behind wall 0
    moved = tree.moved(points)
    polygons = [points[4 * k : 4 * k + 4] for k in range(6)]
    for camera in (SCREEN, Screen(nearer="larger")):
        assert (moved.render(camera, (24, 10)).ids == render(polygons, camera, (24, 10)).ids).all()
    # The rest of the tree is as it was: the wall's old plane still divides, its new place is a node of its own.
    old, new = tree.nodes, moved.nodes
    assert new[0] == old[0] and len(new) == len(old) + 1
    assert new[-1][0] == [1] and sorted(p for polygons, _, _ in new for p in polygons) == [0, 1, 2, 3, 4, 5]


# 9. Cost -------------------------------------------------------------------------------------------------------------


def test_9_z_buffer_does_not_depend_on_the_screen_alone():
    one = render([box(0, 0, 20, 20, 1)], SCREEN, (20, 20)).statistics
    many = render([box(0, 0, 20, 20, z) for z in range(50, 0, -1)], SCREEN, (20, 20)).statistics
    assert many.comparisons == 50 * one.comparisons


def test_9_scan_lines_split_where_polygons_interpenetrate():
    scenes = [interpenetrating(seed) for seed in range(20)]

    def count(method, variant=None):
        return sum(render(s, SCREEN, SIZE, method, variant=variant).statistics.splits for s in scenes)

    assert count("scan line") > 0 == count("z-buffer")
