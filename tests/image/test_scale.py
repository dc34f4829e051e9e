"""Scale, fit and accuracy on paper: what was asked is what comes out, or one sentence says why not."""

import math

import numpy as np
import pytest

import hlr
from hlr import OptionError, Perspective
from hlr.drawing.notes import Note
from support.at_size import ALL_LINES, AT_SIZE
from support.models import box, parts


@pytest.mark.slow
@pytest.mark.parametrize("view", ["front", "iso", (3, 1, -2)])
@pytest.mark.parametrize("fit", [(100.0, 100.0), (200.0, 50.0), (10.0, 300.0)])
@pytest.mark.parametrize("kind", ["box", "ball", "perspective"])
def test_fit_fits_and_touches(view, fit, kind):
    import cadquery as cq

    model = box((10, 20, 30), (100, 0, 0)) if kind == "box" else cq.Workplane().sphere(7).translate((100, 0, 0))
    camera = Perspective(fov=60.0) if kind == "perspective" else None
    drawing = hlr.draw(model, view, fit=fit, perspective=camera, **ALL_LINES)
    width, height = drawing.bounds[2:]
    assert width <= fit[0] + 1e-9
    assert height <= fit[1] + 1e-9
    slack = 2 * drawing.accuracy.used
    assert width >= fit[0] - slack or height >= fit[1] - slack


def test_fit_wins_over_scale_and_says_its_own():
    drawing = hlr.draw(box((10, 20, 30)), "front", fit=(100.0, 60.0), **ALL_LINES)
    assert drawing.scale == pytest.approx(2)
    assert drawing.notes == ()


@pytest.mark.parametrize(("fit", "fov"), [((80.0, 60.0), 5.0), ((60.0, 80.0), 60.0)])
def test_a_view_from_a_given_eye_fills_what_it_is_fitted_into(fit, fov):
    wall = box((500, 1, 500))
    drawing = hlr.draw(
        parts(
            wall, box((5, 5, 2), (0, -9, 0)), *(box((1, 1, 1), (x, -9, z)) for x in range(-90, 91, 3) for z in (-3, 3))
        ),
        "front",
        fit=fit,
        perspective=Perspective(eye=(0, -100, 0), target=(0, 0, 0), fov=fov),
        **ALL_LINES,
    )
    # The frame that the field of view spans is what is fitted, whether or not lines reach its border.
    assert drawing.scale == pytest.approx(fit[1] / (2 * 100 * math.tan(math.radians(fov / 2))))
    assert drawing.bounds[2] <= fit[0] and drawing.bounds[3] <= fit[1]


@pytest.mark.parametrize("scale", [0.01, 0.5, 1.0, 3.0, 100.0])
def test_scale_is_paper_to_model(scale):
    drawing = hlr.draw(box((10, 20, 30)), "front", scale=scale, **ALL_LINES)
    assert drawing.scale == scale
    assert drawing.bounds == pytest.approx((0, 0, 10 * scale, 30 * scale))


def test_scaling_by_powers_of_two_changes_nothing_else():
    import trimesh

    mesh = trimesh.creation.icosphere(2, 10)
    mesh = trimesh.util.concatenate([mesh, box((30, 4, 4))])
    one = hlr.draw(mesh, "iso", accuracy=0.25, **AT_SIZE)
    for factor in (0.25, 8.0):
        larger = trimesh.Trimesh(mesh.vertices * factor, mesh.faces, process=False)
        drawings = (
            hlr.draw(larger, "iso", accuracy=0.25 * factor, **AT_SIZE),
            hlr.draw(mesh, "iso", scale=factor, accuracy=0.25 * factor, **ALL_LINES),
            hlr.draw(larger, "iso", scale=1 / factor, accuracy=0.25, **ALL_LINES),
        )
        for drawing, paper in zip(drawings, (factor, factor, 1.0), strict=True):
            assert len(drawing.lines) == len(one.lines) > 10
            for a, b in zip(one.lines, drawing.lines, strict=True):
                assert (a.kind, a.visible) == (b.kind, b.visible)
                assert (a.points * paper == b.points).all()


@pytest.mark.parametrize("unit", ["millimeters", "meters", "inches"])
def test_units_of_a_mesh_count(unit):
    millimetres = {"millimeters": 1.0, "meters": 1000.0, "inches": 25.4}[unit]
    mesh = box((1, 2, 3))
    mesh.units = unit
    drawing = hlr.draw(mesh, "front", scale=0.1, **ALL_LINES)
    assert drawing.unit == millimetres
    assert drawing.bounds[2:] == pytest.approx((0.1 * millimetres, 0.3 * millimetres))


def test_a_tiny_and_a_huge_drawing_say_so():
    assert hlr.draw(box((1, 1, 1)), "front", **AT_SIZE).notes == (
        Note("paper-size", "the drawing is only 1.4 mm large at 1:1: without a scale it gets one that fits a page"),
    )
    assert hlr.draw(box((3e3, 4e3, 3e3)), "front", **AT_SIZE).notes == (
        Note("paper-size", "the drawing is 4.24 m large at 1:1: without a scale it gets one that fits a page"),
    )
    for options in ({"scale": 5.0}, {"fit": (1.0, 1.0)}, {}):
        assert hlr.draw(box((1, 1, 1)), "front", **options).notes == ()
    assert hlr.draw(box((30, 30, 30)), "front", **AT_SIZE).notes == ()


def test_the_accuracy_follows_the_size_unless_given():
    assert hlr.draw(box((300, 300, 400)), "right", **AT_SIZE).accuracy.used == 0.05
    small = hlr.draw(box((3, 3, 4)), "right", **AT_SIZE).accuracy
    assert (small.asked, small.used) == (None, pytest.approx(5 / 2000))
    given = hlr.draw(box((3, 3, 4)), "right", accuracy=0.01, **AT_SIZE).accuracy
    assert (given.asked, given.used) == (0.01, 0.01)


@pytest.mark.parametrize("accuracy", [1.0, 0.1, 0.01])
@pytest.mark.parametrize("scale", [0.2, 5.0])
def test_the_accuracy_is_kept(accuracy, scale):
    import cadquery as cq

    from support.measures import placed, samples

    drawing = hlr.draw(cq.Workplane().cylinder(40, 30), "top", accuracy=accuracy, scale=scale, **ALL_LINES)
    (line,) = drawing.lines
    points = placed(drawing, line)
    off = np.abs(np.hypot(*samples(np.stack([points[:-1], points[1:]], axis=1), 0.1).T) - 30 * scale)
    assert off.max() < accuracy
    # And it means something: a coarser wish gives fewer vertices.
    assert len(points) < 40 / math.sqrt(accuracy / (30 * scale))


def test_the_accuracy_is_kept_before_the_image_plane():
    import cadquery as cq

    from support.measures import placed, samples

    camera = Perspective(eye=(0, 0, 30), target=(0, 0, -1000), fov=120.0)
    drawing = hlr.draw(cq.Workplane().cylinder(4, 10), "top", perspective=camera, **AT_SIZE)
    (rim,) = [line for line in drawing.lines if np.allclose(line.points3[:, 2], 2)]
    points = placed(drawing, rim)
    off = np.abs(np.hypot(*samples(np.stack([points[:-1], points[1:]], axis=1), 0.5).T) - 10 * 1030 / 28)
    assert off.max() < drawing.accuracy.used


@pytest.mark.parametrize(
    ("accuracy", "words"),
    [
        (0.0, "give a positive length"),
        (-1.0, "give a positive length"),
        (math.nan, "give a positive length"),
        (math.inf, "give a positive length"),
        (1e-12, r"too fine for a drawing of 42.4 mm: give at least [0-9.]+, or a smaller scale\.$"),
        (1e-300, "too fine"),
        (20.0, "too coarse for a drawing of 42.4 mm: give at most 10.6"),
        (1e300, "too coarse"),
    ],
)
def test_an_accuracy_that_cannot_be_kept(accuracy, words):
    with pytest.raises(OptionError, match=words) as caught:
        hlr.draw(box((30, 30, 30)), "front", accuracy=accuracy, **AT_SIZE)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize("size", [0.7, 30.0, 433.0, 61_400.0])
def test_the_accuracy_that_a_refusal_names_is_accepted(size):
    with pytest.raises(OptionError, match="give at least") as caught:
        hlr.draw(box((size, size, size)), "front", accuracy=1e-13, **AT_SIZE)
    hlr.draw(
        box((size, size, size)),
        "front",
        accuracy=float(str(caught.value).split("at least ")[1].split(",")[0]),
        **AT_SIZE,
    )


def test_a_model_without_extent_is_refused():
    with pytest.raises(hlr.SourceError):
        hlr.draw(([[1, 1, 1]], [[0, 0, 0]]), "front", **AT_SIZE)
    # Flat is not without extent: edge-on it is a line.
    flat = ([[0, 0, 0], [10, 0, 0], [0, 10, 0]], [[0, 1, 2]])
    assert hlr.draw(flat, "front", **AT_SIZE).bounds == pytest.approx((0, 0, 10, 0))
    fitted = hlr.draw(flat, "front", fit=(50.0, 50.0), **ALL_LINES)
    assert fitted.bounds == pytest.approx((0, 0, 50, 0))
