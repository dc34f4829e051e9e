"""Named views, directions, up, and the perspective camera: vectors as they are documented."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import hlr
from hlr.errors import HlrError, OptionError, ViewError
from hlr.image.camera import Camera, resolve
from hlr.request.check import checked
from hlr.request.directions import NAMED
from hlr.request.options import Options, Perspective
from hlr.source.model import Frame
from support.at_size import AT_SIZE

BOUNDS = np.array([[-5.0, -10.0, -15.0], [5.0, 10.0, 15.0]])
Y_UP = Frame(1000.0, ((1.0, 0.0, 0.0), (0.0, 0.0, -1.0), (0.0, 1.0, 0.0)))
H, T, S = math.sqrt(0.5), math.sqrt(1 / 3), math.sqrt(1 / 6)


def camera(view, frame=None, bounds=BOUNDS, **options) -> Camera:
    return resolve(view, Options(**AT_SIZE | options), frame or Frame(), bounds)


@pytest.mark.parametrize(
    ("name", "direction", "right", "up"),
    [
        ("front", (0, -1, 0), (1, 0, 0), (0, 0, 1)),
        ("back", (0, 1, 0), (-1, 0, 0), (0, 0, 1)),
        ("left", (-1, 0, 0), (0, -1, 0), (0, 0, 1)),
        ("right", (1, 0, 0), (0, 1, 0), (0, 0, 1)),
        ("top", (0, 0, 1), (1, 0, 0), (0, 1, 0)),
        ("bottom", (0, 0, -1), (1, 0, 0), (0, -1, 0)),
        ("iso", (T, -T, T), (H, H, 0), (-S, S, 2 * S)),
        ("iso-se", (T, -T, T), (H, H, 0), (-S, S, 2 * S)),
        ("iso-sw", (-T, -T, T), (H, -H, 0), (S, S, 2 * S)),
        ("iso-ne", (T, T, T), (-H, H, 0), (-S, -S, 2 * S)),
        ("iso-nw", (-T, T, T), (-H, -H, 0), (S, -S, 2 * S)),
    ],
)
def test_named_views(name, direction, right, up):
    found = camera(name)
    assert found.name == name
    assert found.direction == pytest.approx(direction)
    assert found.right == pytest.approx(right)
    assert found.up == pytest.approx(up)
    assert found.eye is None


def test_every_name_is_listed_above():
    assert len(NAMED) == 11


@pytest.mark.parametrize("name", list(NAMED))
def test_a_name_and_its_direction_are_the_same_view(name):
    named, given_ = camera(name), camera(NAMED[name][0])
    assert (named.direction, named.right, named.up) == (given_.direction, given_.right, given_.up)


numbers = st.floats(-1e6, 1e6).filter(lambda x: x == 0 or abs(x) > 1e-6)
directions = st.tuples(numbers, numbers, numbers).filter(any)


@pytest.mark.slow
@given(directions, st.sampled_from([Frame(), Y_UP]))
def test_any_direction_gives_a_right_handed_frame(direction, frame):
    found = camera(direction, frame)
    r, u, d = (np.asarray(v) for v in (found.right, found.up, found.direction))
    assert np.stack([r, u, d]) @ np.stack([r, u, d]).T == pytest.approx(np.eye(3), abs=1e-12)
    assert np.cross(r, u) == pytest.approx(d, abs=1e-12)
    world = np.asarray(frame.up) @ d
    assert world == pytest.approx(np.asarray(direction) / np.linalg.norm(direction), abs=1e-12)
    # z never points down on paper, but where it is seen end-on: then y points up.
    assert (np.asarray(frame.up) @ u)[2] >= (-1e-12 if abs(world[2]) < 0.999999 else -2e-6)


@given(directions, directions)
def test_up_points_up_or_is_refused(direction, up):
    crossing = np.linalg.norm(np.cross(direction, up)) / np.linalg.norm(direction) / np.linalg.norm(up)
    if crossing < 1e-10:
        with pytest.raises(ViewError, match="parallel"):
            camera(direction, up=up)
    elif crossing > 1e-8:
        found = camera(direction, up=up)
        assert np.dot(found.right, up) / np.linalg.norm(up) == pytest.approx(0, abs=1e-7)
        assert np.dot(found.up, up) > 0


@pytest.mark.parametrize("length", [1e-300, 1e-20, 1.0, 1e20, 1e300])
def test_the_length_of_a_direction_does_not_matter(length):
    assert camera((length, -length, length)).direction == pytest.approx((T, -T, T))


def test_a_custom_direction_names_itself():
    assert camera((1, -1.5, 0.25)).name == "1,-1.5,0.25"
    assert camera(np.array([0, 0, 2])).name == "0,0,2"


@pytest.mark.parametrize(
    ("view", "words"),
    [
        ("isometric", "no view is called 'isometric': use front"),
        ("Front", "no view is called 'Front'"),
        ((0, 0, 0), "the view direction is zero"),
        ((math.nan, 0, 1), "three finite numbers"),
        ((math.inf, 0, 1), "three finite numbers"),
        ((1, 2), "three finite numbers"),
        ((1, 2, 3, 4), "three finite numbers"),
    ],
)
def test_views_that_are_none(view, words):
    with pytest.raises(ViewError, match=words) as caught:
        camera(view)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize(
    ("view", "up"), [("top", (0, 0, 1)), ("front", (0, -2, 0)), ((1, -1, 1), (-3, 3, -3)), ("top", (0, 0, 1e-200))]
)
def test_up_along_the_view_is_refused(view, up):
    with pytest.raises(ViewError, match="`up` is parallel to the view direction"):
        camera(view, up=up)


@pytest.mark.parametrize("up", [(0, 0, 0), (math.nan, 0, 0), (1, 2)])
def test_an_up_that_is_none_is_refused(up):
    with pytest.raises(ViewError, match=r"`up` (is zero|needs three)"):
        camera("front", up=up)


def test_up_turns_the_paper():
    assert camera("front", up=(1, 0, 0)).right == pytest.approx((0, 0, -1))
    assert camera("top", up=(-1, 0, 0)).right == pytest.approx((0, 1, 0))


def test_model_axes_of_a_y_up_mesh():
    front = camera("front", Y_UP)
    # World front looks along +y, which is the model's -z; up is the model's y.
    assert front.direction == pytest.approx((0, 0, 1))
    assert front.right == pytest.approx((1, 0, 0))
    assert front.up == pytest.approx((0, 1, 0))
    # Up and eye are world millimetres, too.
    eyed = camera("front", Y_UP, up=(1, 0, 0), perspective=Perspective(eye=(2000, -3000, 500), target=(0, 0, 0)))
    assert eyed.eye == pytest.approx((2, 0.5, 3))
    assert eyed.up[0] > 0.8


def test_orthographic_projection_and_depth():
    found = camera("iso").project(np.array([[1.0, 2.0, 3.0]]))
    right, up, direction = (np.array(v) for v in ((H, H, 0), (-S, S, 2 * S), (T, -T, T)))
    p = np.array([1.0, 2.0, 3.0])
    assert found[0] == pytest.approx((p @ right, p @ up, -(p @ direction)))


def test_perspective_projects_onto_the_plane_through_the_target():
    found = camera("front", perspective=Perspective(eye=(0, -30, 0), target=(0, -10, 0), fov=60))
    assert (found.distance, found.fov, found.framed) == (20, 60, True)
    flat = found.project(np.array([[3.0, -10.0, 4.0], [3.0, 10.0, 4.0], [3.0, -20.0, 4.0]]))
    assert flat[:, :2] == pytest.approx(np.array([[3, 4], [1.5, 2], [6, 8]]))
    # Depth grows away from the viewer.
    assert flat[2, 2] < flat[0, 2] < flat[1, 2]
    assert found.ahead(np.array([[0.0, -40.0, 0.0]])) == pytest.approx([-10])


def test_without_an_eye_the_whole_model_fits_the_field_of_view():
    for fov in (None, 10.0, 45.0, 90.0, 150.0):
        found = camera("iso", perspective=Perspective(fov=fov))
        corners = np.array([[x, y, z] for x in (-5, 5) for y in (-10, 10) for z in (-15, 15)], float)
        assert (found.ahead(corners) > 0).all()
        reach = np.abs(found.project(corners)[:, 1]).max()
        assert reach <= found.distance * math.tan(math.radians(found.fov) / 2)
        assert not found.framed
        assert found.direction == camera("iso").direction
    tight = camera("iso", perspective=Perspective())
    assert np.abs(tight.project(corners)[:, :2]).max() > 0.9 * tight.distance * math.tan(math.radians(tight.fov) / 2)


def test_with_an_eye_the_direction_is_from_target_to_eye():
    found = camera("front", perspective=Perspective(eye=(30, 0, 40)))
    assert found.direction == pytest.approx((0.6, 0, 0.8))
    assert found.target == (0, 0, 0)
    assert found.distance == pytest.approx(50)


@pytest.mark.parametrize(
    ("perspective", "error"),
    [
        (Perspective(eye=(0, 0, 0)), ViewError),
        (Perspective(eye=(5, 5, 5), target=(5, 5, 5)), ViewError),
        (Perspective(eye=(math.nan, 0, 0)), HlrError),
        (Perspective(target=(math.inf, 0, 0)), HlrError),
        (Perspective(fov=0.0), OptionError),
        (Perspective(fov=-10.0), OptionError),
        (Perspective(fov=180.0), OptionError),
        (Perspective(fov=400.0), OptionError),
        (Perspective(fov=math.nan), OptionError),
        (Perspective(eye=(0, -99, 0), fov=180.0), OptionError),
    ],
)
def test_perspectives_that_are_none(perspective, error):
    with pytest.raises(error) as caught:
        resolve("front", checked(Options(perspective=perspective, **AT_SIZE)), Frame(), BOUNDS)
    assert isinstance(caught.value, HlrError)
    assert "\n" not in str(caught.value)


def test_an_eye_inside_the_model_gets_the_widest_field():
    assert camera("front", perspective=Perspective(eye=(0, -1, 0))).fov == 120


@pytest.mark.parametrize("view", ["iso", "front"])
def test_an_eye_straight_above_needs_no_up(view):
    above = camera(view, perspective=Perspective(eye=(0, 0, 100)))
    assert (above.right, above.up) == ((1, 0, 0), (0, 1, 0))


@pytest.mark.parametrize("view", ["front", (1, 1, 1)])
def test_up_may_be_an_array(view):
    tetrahedron = (np.vstack([np.zeros(3), np.eye(3)]), np.array([[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]]))
    named, array = (hlr.draw(tetrahedron, view, up=up) for up in ((1, 0, 1), np.array([1.0, 0.0, 1.0])))
    assert array.to_svg() == named.to_svg()
    assert hlr.preview(tetrahedron, view=view, up=np.array([1.0, 0.0, 1.0])) is not None
