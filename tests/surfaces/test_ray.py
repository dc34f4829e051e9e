"""A ray's parameter t: 0 at the eye, 1 at the pixel, negative behind the eye."""

import numpy as np
import pytest

from hlr.errors import OptionError
from hlr.image.camera import resolve
from hlr.lab.methods import SCREEN, ray_hits, render
from hlr.request.options import Options, Perspective
from hlr.source.model import Frame

SIZE = (41, 31)


def camera():
    """Looks along +y from (0, -10, 0); the image plane stands at y = 0."""
    bounds = np.array([[-5.0, -5.0, -5.0], [5.0, 5.0, 5.0]])
    return resolve("front", Options(perspective=Perspective((0.0, -10.0, 0.0), (0.0, 0.0, 0.0), 60.0)), Frame(), bounds)


def screen(y, half=30.0):
    return [(-half, y, -half), (half, y, -half), (half, y, half), (-half, y, half)]


def test_t_at_the_eye_at_the_pixel_and_behind():
    hits = ray_hits([screen(20), screen(0), screen(-5), screen(-30)], camera(), SIZE, (20, 15))
    assert [(hit.polygon, hit.t) for hit in hits] == [
        (3, pytest.approx(-2.0)), (2, pytest.approx(0.5)), (1, pytest.approx(1.0)), (0, pytest.approx(3.0)),
    ]  # fmt: skip
    # The middle pixel of odd sides is straight ahead.
    assert hits[2].point == pytest.approx((0.0, 0.0, 0.0), abs=1e-12)


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(5))
def test_the_first_with_positive_t_is_what_is_seen(seed):
    random = np.random.default_rng(seed)
    scene = [random.uniform((-12, -14, -9), (12, 25, 9), (3, 3)) for _ in range(12)]
    view = camera()
    found = render(scene, view, SIZE, "ray casting")
    ahead = found.ahead(view)
    seen = 0
    for column, row in random.integers(0, SIZE, (60, 2)).tolist():
        # What is nearer to the eye than the near plane is cut off.
        hits = [hit for hit in ray_hits(scene, view, SIZE, (column, row)) if hit.t > 0.01]
        assert found.ids[row, column] == (hits[0].polygon if hits else -1)
        if hits:
            seen += 1
            assert ahead[row, column] == pytest.approx(hits[0].t * view.distance, rel=1e-2)
    assert seen > 10


def test_holes_and_rules():
    hole = [screen(5, 9.0), screen(5, 3.0)]
    assert ray_hits([hole], camera(), SIZE, (20, 15)) == []
    assert len(ray_hits([hole], camera(), SIZE, (20, 15), rule="non-zero")) == 1
    assert len(ray_hits([hole], camera(), SIZE, (27, 15))) == 1
    # Seen edge-on.
    assert ray_hits([[(0, -5, -5), (0, 5, -5), (0, 5, 5)]], camera(), SIZE, (20, 15)) == []


def test_a_parallel_view_has_no_t():
    with pytest.raises(OptionError, match="no eye"):
        ray_hits([screen(5)], SCREEN, SIZE, (20, 15))


def test_renderings_are_compared_by_value():
    one, same, other = (render([screen(y)], camera(), SIZE) for y in (5, 5, 6))
    assert one == same and hash(one) == hash(same) and one != other and one.statistics == same.statistics
