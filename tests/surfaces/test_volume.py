"""Clipping: six planes in image space, two dimensions after object space; parallel and perspective."""

import math

import numpy as np
import pytest

from hlr.errors import HlrError, OptionError
from hlr.image.camera import resolve
from hlr.lab.methods import METHODS, SCREEN, NotFinishedError, painters_list, quadric_depths, render
from hlr.lab.methods.quadric import MISSED
from hlr.lab.methods.shading import along
from hlr.request.options import Options, Perspective
from hlr.source.model import Frame

NEAR_ONE = [(2, 2, 1), (6, 2, 1), (6, 6, 1), (2, 6, 1)]
FAR_ONE = [(0, 0, 5), (8, 0, 5), (8, 8, 5), (0, 8, 5)]


@pytest.mark.parametrize("method", METHODS)
def test_what_stands_before_the_front_plane_hides_in_object_space_only(method):
    image = render([NEAR_ONE, FAR_ONE], SCREEN, (8, 8), method, front=2.0, space="image")
    assert (image.ids == 1).all()
    object_ = render([NEAR_ONE, FAR_ONE], SCREEN, (8, 8), method, front=2.0, space="object")
    assert (object_.ids == 0).sum() == 16


def test_what_crosses_a_plane_is_cut_there():
    slope = [(0, 0, 0), (8, 0, 8), (8, 8, 8), (0, 8, 0)]
    for method in METHODS:
        found = render([slope], SCREEN, (8, 8), method, front=2.0, back=6.0)
        assert (found.ids[3] == [-1, -1, 0, 0, 0, 0, -1, -1]).all(), method
        assert found.statistics.clipped == 1
    assert render([slope], SCREEN, (8, 8), front=-1.0, back=9.0).statistics.clipped == 0


def test_a_polygon_on_the_back_plane_is_not_lost():
    for method in METHODS:
        assert (render([FAR_ONE], SCREEN, (8, 8), method, front=0.0, back=5.0).ids == 0).all()


def test_sides_clip_without_error():
    large = [(-90, -70, 3), (200, -30, 3), (10, 300, 3)]
    huge = [(-9e6, -7e6, 3), (2e7, -3e6, 3), (1e6, 3e7, 3)]
    for polygon, cut in ((large, 0), (huge, 1)):
        found = render([polygon], SCREEN, (16, 9))
        assert (found.ids == 0).all() and found.statistics.clipped == cut
    assert (render([[(20, 0, 0), (30, 0, 0), (30, 9, 0)]], SCREEN, (16, 9)).ids == -1).all()


def camera(eye=(0.0, -10.0, 0.0), target=(0.0, 0.0, 0.0), fov=60.0):
    bounds = np.array([[-5.0, -5.0, -5.0], [5.0, 5.0, 5.0]])
    return resolve("front", Options(perspective=Perspective(eye, target, fov)), Frame(), bounds)


FLOOR = [(-3, -20, -1), (3, -20, -1), (3, 40, -1), (-3, 40, -1)]


@pytest.mark.parametrize("method", METHODS)
def test_the_near_cut_in_perspective(method):
    # The floor begins behind the eye.
    for space in ("image", "object"):
        found = render([FLOOR], camera(), (60, 60), method, space=space)
        ids = found.ids
        assert (ids[:30] == -1).all() and (ids[-1] == 0).any() and found.statistics.clipped == 1


def test_depth_in_perspective_is_that_of_the_surface():
    view = camera()
    found = render([FLOOR], view, (60, 60))
    rows = np.flatnonzero(found.ids[:, 30] == 0)
    # A ray through row r falls t per unit ahead: the floor, one below the eye, is 1 / t ahead. It reaches under the
    # eye, so that most of the steps of depth are spent on what is near.
    tangent = math.tan(math.radians(30.0))
    expected = 1.0 / (tangent * (rows + 0.5 - 30.0) / 30.0)
    np.testing.assert_allclose(found.ahead(view)[rows, 30], expected, rtol=1e-3)
    # t = 0 at the eye, 1 on the image plane, which stands at the target.
    assert (found.ahead(view)[rows, 30] / view.distance > 0.0).all()


def test_the_naive_way_of_depth_is_wrong_in_perspective():
    near, far = 2.0, 50.0
    half = np.array([0.5])
    naive = along(np.array([near]), np.array([far]), half)
    right = along(np.array([near]), np.array([far]), half, w=(near, far))
    assert naive[0, 0] == 26.0
    # Depth on the screen is linear as -1 / z.
    assert right[0, 0] == pytest.approx(1.0 / (0.5 / near + 0.5 / far))
    assert right[0, 0] < 4.0


def test_values_along_spans_textbook_and_correct():
    view = camera()
    values = np.array([[p[1], 0.0, 1.0] for p in FLOOR])
    # The floor from 0 to 40 only, which is not clipped: there the values are those of the corners.
    floor = [(x, max(y, 0.0), z) for x, y, z in FLOOR]
    values[:, 0] = [p[1] for p in floor]
    both = {s: render([floor], view, (60, 60), values=values, shading=s) for s in ("textbook", "correct")}
    seen = both["correct"].ids == 0
    y = both["correct"].ahead(view)[seen] - 10.0
    assert np.abs(both["correct"].values[seen][:, 0] - y).max() < 0.5
    assert np.abs(both["textbook"].values[seen][:, 0] - y).max() > 5.0
    np.testing.assert_allclose(both["correct"].values[seen][:, 2], 1.0)
    assert np.isnan(both["correct"].values[~seen]).all()


def test_values_survive_clipping():
    view = camera()
    values = np.array([[p[1], p[0], 0.0] for p in FLOOR])
    found = render([FLOOR], view, (60, 60), values=values)
    seen = (found.ids == 0) & (np.arange(60) > 35)[:, None]
    assert np.abs(found.values[seen][:, 0] - (found.ahead(view)[seen] - 10.0)).max() < 0.5


def test_values_are_linear_in_parallel_views():
    triangle = [(0, 0, 0), (8, 0, 8), (0, 8, 0)]
    found = render([triangle], SCREEN, (8, 8), values=np.array([[0.0, 0, 1], [8, 0, 1], [0, 8, 1]]))
    rows, columns = np.nonzero(found.ids == 0)
    np.testing.assert_allclose(found.values[rows, columns, 0], columns + 0.5, atol=1e-9)
    np.testing.assert_allclose(found.values[rows, columns, 1], rows + 0.5, atol=1e-9)


QUADRICS = {
    "sphere": (1, 1, 1, 0, 0, 0, 0, 0, 0, -(50**2)),
    "cylinder": (1, 0, 1, 0, 0, 0, -20, 0, 0, 100 - 30**2),
    "cylinder, oblique": (2, 1, 2, 1, -1, 1, 0, 0, 3, -4000),
    "cone": (-1, 4, 4, 0, 0, 0, 0, 0, 0, 0),
}


@pytest.mark.parametrize("name", QUADRICS)
def test_forward_differences_of_quadrics_are_exact(name):
    a, b, c, d, e, f, g, h, i, j = q = QUADRICS[name]
    hit = 0
    for y in range(-60, 61, 7):
        depths, corrections = quadric_depths(q, (-80, 80), y)
        for x, z in zip(range(-80, 80), depths.tolist(), strict=True):
            linear = e * x + f * y + i
            rest = a * x * x + b * y * y + d * x * y + g * x + h * y + j
            square = linear * linear - 4 * c * rest
            if square < 0:
                assert z == MISSED
                continue
            hit += 1
            # floor((-linear - sqrt(square)) / 2c): the largest whole z with 2 c z + linear <= -sqrt(square).
            root = math.isqrt(square)
            ceiling = root + (root * root < square)
            assert z == (-linear - ceiling) // (2 * c)
        assert corrections < 160 * 60
    assert hit > 300


def test_refusals():
    triangle = [[(0, 0, 0), (4, 0, 0), (4, 4, 0)]]
    for wrong in (
        lambda: render(triangle, SCREEN, (4, 4), method="raytrace"),
        lambda: render(triangle, SCREEN, (4, 4), method="warnock", variant="fast"),
        lambda: render(triangle, SCREEN, (0, 4)),
        lambda: render(triangle, SCREEN, (4, 10**6)),
        lambda: render(triangle, SCREEN, 4),
        lambda: render(triangle, SCREEN, (4.0, 4)),
        lambda: render([[(0, 0), (1, 1), (2, 2)]], SCREEN, (4, 4)),
        lambda: render([[(0, 0, 0), (1, 1, 1)]], SCREEN, (4, 4)),
        lambda: render([[(0, 0, math.nan), (1, 1, 1), (2, 0, 0)]], SCREEN, (4, 4)),
        lambda: render(5, SCREEN, (4, 4)),
        lambda: render(triangle, "front", (4, 4)),
        lambda: render(triangle, SCREEN, (4, 4), rule="odd"),
        lambda: render(triangle, SCREEN, (4, 4), space="hyper"),
        lambda: render(triangle, SCREEN, (4, 4), front=3.0, back=2.0),
        lambda: render(triangle, SCREEN, (4, 4), front=math.nan),
        lambda: render(triangle, SCREEN, (4, 4), values=[[1, 2, 3]]),
        lambda: render(triangle, SCREEN, (4, 4), time_limit=0.0),
        lambda: render(triangle, camera(), (4, 4), front=-1.0),
        lambda: painters_list(triangle, SCREEN, (4, 4), "z-buffer"),
        lambda: quadric_depths((1, 2, 3), (0, 4), 0),
        lambda: quadric_depths((1, 1, 0, 0, 0, 0, 0, 0, 0, 1), (0, 4), 0),
    ):
        with pytest.raises(OptionError) as refused:
            wrong()
        assert "\n" not in str(refused.value)


def test_nothing_gives_background():
    for method in METHODS:
        ids, depth, _ = render([], SCREEN, (4, 3), method)
        assert (ids == -1).all() and np.isinf(depth).all() and ids.shape == (3, 4)


def test_a_time_limit_is_kept():
    rng = np.random.default_rng(1)
    soup = list(rng.uniform(0, 500, (3000, 3, 3)))
    with pytest.raises(NotFinishedError) as late:
        render(soup, SCREEN, (512, 512), "ray casting", variant="flat", time_limit=0.05)
    assert isinstance(late.value, HlrError)
