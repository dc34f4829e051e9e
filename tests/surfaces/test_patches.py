"""Curved patches z = f(x, y) beside polygons: where they are seen is known in closed form."""

import numpy as np
import pytest

from hlr.errors import OptionError
from hlr.lab.methods import METHODS, SCREEN, BspTree, Patch, Screen, painters_list, render

DRAWN = [
    ("z-buffer", "smaller"),
    ("z-buffer", "larger"),
    ("scan-line z-buffer", "merged"),
    ("scan-line z-buffer", "per polygon"),
    ("scan line", None),
]
SIZE = (80, 60)
ROWS, COLUMNS = np.mgrid[: SIZE[1], : SIZE[0]]
X, Y = COLUMNS + 0.5, ROWS + 0.5


def box(x0, y0, x1, y1, z):
    return [(x, y, z(x, y)) for x, y in ((x0, y0), (x1, y0), (x1, y1), (x0, y1))]


def paraboloid(x, y, depth, width, bounds, outline=()):
    """depth + r^2 / width about (x, y): a cup that opens away from the viewer."""
    return Patch(((depth, 0.0, 1.0 / width), (0.0,), (1.0 / width,)), bounds, outline, (x, y))


def render_by_all(scene, size=SIZE, **options):
    first = render(scene, SCREEN, size, **options)
    for method, variant in DRAWN:
        found = render(scene, SCREEN, size, method, variant=variant, **options)
        assert (found.ids == first.ids).all(), (method, variant)
        sign = -1.0 if variant == "larger" else 1.0
        assert (sign * found.depth == first.depth).all(), (method, variant)
    return first


def test_a_paraboloid_before_a_level_plane_shows_a_disc():
    # 10 + r^2 / 16 < 35 where r < 20.
    cup = paraboloid(40, 30, 10.0, 16.0, (5, 5, 75, 55))
    found = render_by_all([box(0, 0, 80, 60, lambda x, y: 35.0), cup])
    square = (X - 40) ** 2 + (Y - 30) ** 2
    assert (found.ids == np.where(square < 400, 1, 0)).all()
    # Of equal depth, r = 20, the lower id is seen; the pixel of centre (56.5, 18.5) is off by r^2 = 404.5.
    assert (found.depth == np.minimum(35.0, np.where(found.ids == 1, 10 + square / 16, 35.0))).all()


def test_a_tie_goes_to_the_lower_id():
    # Centres (x, y) with r^2 = 100: (6, 8), (8, 6), (10, 0) and all that mirror them, from (40.5, 30.5).
    cup = paraboloid(40.5, 30.5, 0.0, 4.0, (5, 5, 75, 55))
    plane = box(0, 0, 80, 60, lambda x, y: 25.0)
    ring = (X - 40.5) ** 2 + (Y - 30.5) ** 2 == 100
    assert ring.sum() == 12
    assert (render_by_all([plane, cup]).ids[ring] == 0).all()
    assert (render_by_all([cup, plane]).ids[ring] == 0).all()


def test_a_paraboloid_through_a_slanted_plane_shows_a_disc_beside_its_axis():
    # r^2 / 16 < 12 + (x - 40) / 4 - (y - 30) / 2: about (42, 26), r^2 < 16 * 12 + 4 + 16.
    cup = paraboloid(40, 30, 0.0, 16.0, (0, 0, 80, 60))
    found = render_by_all([box(0, 0, 80, 60, lambda x, y: 12 + (x - 40) / 4 - (y - 30) / 2), cup])
    assert (found.ids == np.where((X - 42) ** 2 + (Y - 26) ** 2 < 212, 1, 0)).all()
    assert (found.ids == 1).sum() == pytest.approx(np.pi * 212, rel=0.02)


def test_its_silhouette_is_its_outline():
    # A round piece with a hole, alone: a pixel's centre inside a polygon of many sides.
    turn = np.linspace(0, 2 * np.pi, 721)[:-1]
    loops = [[(40 + r * np.cos(t), 30 + r * np.sin(t)) for t in turn] for r in (25, 10)]
    ids = render_by_all([paraboloid(40, 30, 3.0, 50.0, (15, 5, 65, 55), loops)]).ids
    radius = np.hypot(X - 40, Y - 30)
    sure = (np.abs(radius - 25) > 0.01) & (np.abs(radius - 10) > 0.01)
    assert (ids == np.where((radius < 25) & (radius > 10), 0, -1))[sure].all() and sure.mean() > 0.99


def test_two_saddles_change_places_where_their_difference_is_nought():
    # xy / 20 against -xy / 20: quadrants. On the axes no centre lies.
    saddles = [Patch(((0.0,), (0.0, s / 20)), (0, 0, 80, 60), origin=(40, 30)) for s in (1, -1)]
    found = render_by_all(saddles)
    assert (found.ids == np.where((X - 40) * (Y - 30) < 0, 0, 1)).all()
    assert render(saddles, SCREEN, SIZE, "scan line").statistics.splits == SIZE[1]


def test_three_crossings_of_a_cubic_in_one_span():
    # (x - 20.25)(x - 40.25)(x - 60.25) / 1000 changes its sign three times.
    a, b, c = -20.0, 0.0, 20.0
    table = ((-a * b * c / 1000,), ((a * b + b * c + c * a) / 1000,), (-(a + b + c) / 1000,), (1 / 1000,))
    cubic = Patch(table, (0, 0, 80, 60), origin=(40.25, 30))
    found = render_by_all([box(0, 0, 80, 60, lambda x, y: 0.0), cubic])
    before = (X < 20.25) | ((X > 40.25) & (X < 60.25))
    assert (found.ids == np.where(before, 1, 0)).all()
    assert render([box(0, 0, 80, 60, lambda x, y: 0.0), cubic], SCREEN, SIZE, "scan line").statistics.splits == 3 * 60


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(30))
def test_random_patches_and_polygons_by_all_methods(seed):
    rng = np.random.default_rng(seed)
    scene = []
    for _ in range(6):
        x0, y0 = rng.uniform(-10, 50, 2)
        x1, y1 = x0 + rng.uniform(5, 60), y0 + rng.uniform(5, 60)
        if rng.random() < 0.6:
            scale = np.array([30.0, 1.0, 0.05, 0.001])
            table = rng.normal(size=(4, 4)) * scale[:, None] * scale[None, :] / 30
            scene.append(Patch(tuple(map(tuple, table.tolist())), (x0, y0, x1, y1), origin=(x0, y0)))
        else:
            a, b, c = rng.normal(size=3)
            scene.append(box(x0, y0, x1, y1, lambda x, y, a=a, b=b, c=c: a * (x - 40) + b * (y - 30) + 20 * c))
    found = render_by_all(scene)
    best = np.full(SIZE[::-1], np.inf)
    for number, given in enumerate(scene):
        own = render([given], SCREEN, SIZE).ids == 0
        if isinstance(given, Patch):
            x0, y0, x1, y1 = given.bounds
            low, high = given.range()
            z = given.at(X, Y)
            assert ((low <= z) & (z <= high))[own].all()
            mine = own & (found.ids == number)
            np.testing.assert_allclose(found.depth[mine], z[mine], atol=1e-9 * max(1.0, high - low))
        else:
            z = render([given], SCREEN, SIZE).depth
        best = np.where(own & (z < best), z, best)
    np.testing.assert_allclose(found.depth, best, rtol=1e-9, atol=1e-6)


def test_larger_depths_may_be_the_nearer_ones():
    cup = paraboloid(40, 30, -10.0, -16.0, (5, 5, 75, 55))
    plane = box(0, 0, 80, 60, lambda x, y: -35.0)
    found = render([plane, cup], Screen(nearer="larger"), SIZE)
    square = (X - 40) ** 2 + (Y - 30) ** 2
    assert (found.ids == np.where(square < 400, 1, 0)).all()
    assert found.depth[30, 40] == -10 - 0.5 / 16


def test_any_function_in_pieces():
    def wave(x, y):
        return 10 * np.sin(x / 9) * np.cos(y / 7)

    pieces = Patch.of(wave, (0, 0, 80, 60), across=8, down=6)
    assert len(pieces) == 48
    found = render_by_all(pieces)
    assert (found.ids == (ROWS // 10) * 8 + COLUMNS // 10).all()
    np.testing.assert_allclose(found.depth, wave(X, Y), atol=0.02)
    exact = Patch.of(lambda x, y: 3 + x * y**3 / 1000 - x**2, (0, 0, 80, 60))[0]
    np.testing.assert_allclose(exact.at(X, Y), 3 + X * Y**3 / 1000 - X**2, rtol=1e-11)


def test_patches_beside_polygons_that_lie_in_no_plane():
    # Those are triangulated first; numbers stay as they were.
    warped = [(0, 0, 50), (40, 0, 60), (40, 60, 50), (0, 60, 70)]
    cup = paraboloid(60, 30, 1.0, 16.0, (45, 15, 75, 45))
    ids = render_by_all([warped, warped, cup, box(0, 0, 80, 60, lambda x, y: 90.0)]).ids
    assert ids[30, 60] == 2 and ids[30, 20] == 0 and ids[2, 79] == 3
    assert set(np.unique(ids)) == {0, 2, 3}


@pytest.mark.parametrize(("method", "variants"), METHODS.items())
def test_other_methods_refuse_patches(method, variants):
    cup = paraboloid(40, 30, 10.0, 16.0, (5, 5, 75, 55))
    for variant in variants or (None,):
        if (method, variant) in DRAWN or (method, variant) == ("scan line", "both ends"):
            continue
        with pytest.raises(OptionError, match="cannot draw curved patches"):
            render([cup], SCREEN, SIZE, method, variant=variant)


def test_refusals():
    cup = paraboloid(40, 30, 10.0, 16.0, (5, 5, 75, 55))
    for wrong in ({"front": 1.0}, {"back": 1.0}):
        with pytest.raises(OptionError, match="curved patches"):
            render([cup], SCREEN, SIZE, **wrong)
    for call in (lambda: BspTree([cup]).nodes, lambda: painters_list([cup], SCREEN, SIZE)):
        with pytest.raises(OptionError, match="curved patch"):
            call()
    with pytest.raises(OptionError, match="beyond the picture"):
        render([paraboloid(0, 0, 1.0, 1.0, (-9000, 0, 5, 5))], SCREEN, SIZE)
    for coefficients, bounds, outline in [
        ((), (0, 0, 1, 1), ()),
        (((1.0,) * 5,), (0, 0, 1, 1), ()),
        (((float("nan"),),), (0, 0, 1, 1), ()),
        (((1.0,),), (1, 0, 0, 1), ()),
        (((1.0,),), (0, 0, 1), ()),
        ((("a",),), (0, 0, 1, 1), ()),
        (((1.0,),), (0, 0, 1, 1), (((0, 0), (2, 0), (0, 1)),)),
        (((1.0,),), (0, 0, 1, 1), (((0, 0), (1, 0)),)),
    ]:
        with pytest.raises(OptionError):
            Patch(coefficients, bounds, outline)
    with pytest.raises(OptionError, match="not finite"):
        Patch.of(lambda x, y: x * np.inf, (0, 0, 1, 1))
    with pytest.raises(OptionError, match="as many depths"):
        Patch.of(lambda x, y: [1, 2, 3], (0, 0, 1, 1))
