"""All methods against one another and against the rationals: rotated views, perspective, bent, far, self-crossing."""

import numpy as np
import pytest
from surfaces.oracle_of_views import judged
from surfaces.scenes_in_space import SIZE, camera, moved, polygons

from hlr.lab.methods import METHODS, SCREEN, render

VIEWS = ("iso", "parallel", "perspective")

COHERENT = [("scan line", "naive"), ("scan line", "leaving"), ("scan line", "visible")]
EVERYWHERE = [
    (method, variant)
    for method, variants in METHODS.items()
    for variant in (variants or (None,))
    if (method, variant) not in COHERENT
]


def alike(scene, view, size=SIZE, told="", **options):
    """All methods give one picture; that picture."""
    first = render(scene, view, size, "z-buffer", **options)
    for method, variant in EVERYWHERE[1:]:
        found = render(scene, view, size, method, variant=variant, **options)
        wrong = int((found.ids != first.ids).sum())
        assert wrong == 0, f"{told} {method}, {variant}: {wrong} pixels"
        sign = -1.0 if variant == "larger" else 1.0
        assert np.array_equal(sign * found.depth, first.depth), f"{told} {method}, {variant}: depths"
    return first


def right(scene, found, told, rule="even-odd", least=0.5, loss=2.0**-40):
    """The picture is the rationals' wherever rounding leaves no doubt; loss: of the depths' range, what it may cost."""
    truth = judged(scene, found.viewport.matrix, found.ids.shape[::-1], rule)
    depths = [float(d) for _, d, _ in truth.values() if d is not None]
    unsure = loss * (max(depths) - min(depths)) if depths else 0.0
    sure = 0
    for (row, column), (number, depth, gap) in truth.items():
        if gap is not None and gap <= unsure:
            continue
        sure += 1
        assert found.ids[row, column] == number, (told, row, column)
        if depth is not None:
            assert abs(found.depth[row, column] - float(depth)) <= unsure + 1e-12 * abs(float(depth)), (
                told,
                row,
                column,
            )
    assert sure >= least * found.ids.size, told


@pytest.mark.slow
@pytest.mark.parametrize("rule", ["even-odd", "non-zero"])
@pytest.mark.parametrize("view", VIEWS)
def test_the_rationals_agree(view, rule):
    for seed in range(5):
        rng = np.random.default_rng([seed, VIEWS.index(view)])
        scene = polygons(rng, 6)
        found = render(scene, camera(rng, view), SIZE, "z-buffer", rule=rule)
        right(scene, found, f"{view}, {rule}, seed {seed}", rule)


@pytest.mark.slow
@pytest.mark.parametrize("view", VIEWS)
@pytest.mark.parametrize("warp", [0.0, 1e-8, 1e-6, 0.05])
def test_all_methods_agree(view, warp):
    for seed in range(12):
        rng = np.random.default_rng([seed, 17])
        alike(polygons(rng, 9, warp), camera(rng, view), told=f"seed {seed}")


@pytest.mark.slow
@pytest.mark.parametrize("view", VIEWS)
@pytest.mark.parametrize(("shift", "scale"), [(1e6, 1.0), (1e9, 1.0), (0.0, 1e-9), (0.0, 1e100), (1e109, 1e100)])
def test_far_large_and_small(view, shift, scale):
    for seed in range(4):
        rng = np.random.default_rng([seed, 23])
        away = np.array([1.0, -0.7, 0.4]) * shift
        scene = moved(polygons(rng, 7, 0.01), away, scale)
        found = alike(scene, camera(rng, view, away, scale), told=f"seed {seed}")
        assert (found.ids >= 0).mean() > 0.05


@pytest.mark.slow
@pytest.mark.parametrize("view", VIEWS)
def test_detail_beside_something_far_away(view):
    # The picture shows what measures a thousand-millionth of the scene, and in which depths differ by less still.
    for seed in range(6):
        rng = np.random.default_rng([seed, 29])
        scene = polygons(rng, 7)
        eye = camera(rng, view)
        behind = -1e9 * np.asarray(eye.direction)
        plate = [
            behind + 1e9 * (np.asarray(eye.right) * x + np.asarray(eye.up) * y) for x, y in ((-1, -1), (1, -1), (0, 2))
        ]
        window = render(scene, eye, SIZE).viewport
        whole = [*scene, [np.array(plate)]]
        found = alike(whole, eye, window=(-3.0, -2.25, 3.0, 2.25), told=f"seed {seed}")
        assert window is not None and (found.ids == 7).any()
        right(whole, found, f"{view}, seed {seed}", loss=2.0**-44)


def test_two_planes_before_something_far_away():
    square = [(0, 0), (16, 0), (16, 16), (0, 16)]
    far = [(0, 0, 1e9), (4, 0, 1e9), (4, 1, 1e9)]
    scene = [[(x, y, 5.0) for x, y in square], [(x, y, 0.0) for x, y in square], far]
    found = alike(scene, SCREEN, (16, 16))
    assert (found.ids == 1).all() and (found.depth == 0.0).all()


def test_walls_on_a_floor_that_reaches_under_the_eye():
    from hlr.image.camera import resolve
    from hlr.request.options import Options, Perspective
    from hlr.source.model import Frame

    floor = [(-50, -20, -1.7), (50, -20, -1.7), (50, 90, -1.7), (-50, 90, -1.7)]
    walls = [[(-9, y, -1.7), (9, y, -1.7), (9, y, 4), (-9, y, 4)] for y in (40.0 + 1e-7, 40.0)]
    bounds = np.array([[-50.0, -20.0, -2.0], [50.0, 90.0, 4.0]])
    view = resolve("front", Options(perspective=Perspective((0.0, 0.0, 0.0), (0.0, 10.0, 0.0), 60.0)), Frame(), bounds)
    found = alike([floor, *walls], view, (64, 48))
    assert (found.ids == 2).sum() > 100 and not (found.ids == 1).any()


@pytest.mark.parametrize("bend", [0.0, 1e-9, 1e-7, 1e-6, 1e-3, 0.5])
def test_the_bsp_tree_of_a_bent_quad_ends(bend):
    quad = [(10, 10, 0), (20, 10, 0), (20, 20, bend), (10, 20, 0)]
    found = render([quad], SCREEN, (40, 40), "bsp", time_limit=5.0)
    assert (found.ids >= 0).sum() == 100


def test_polygons_that_wind_often():
    def spiral(times, z):
        angle = 2 * np.pi * np.arange(4 * times) / 4 + 0.3
        return np.stack([8 + 6 * np.cos(angle), 8 + 6 * np.sin(angle), z + 0.1 * np.cos(angle)], axis=1)

    found = alike([spiral(65, 1.0), spiral(65, 1.02), spiral(400, 0.95)], SCREEN, (16, 16), rule="non-zero")
    assert set(np.unique(found.ids)) == {-1, 2}
