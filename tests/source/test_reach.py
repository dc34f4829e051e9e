"""How far a source reaches along two directions, which tells the scale on a page before anything is meshed."""

import numpy as np
import pytest
import trimesh

from hlr.source import open_source
from support.shapes_of_all_kinds import shapes

ANGLE, CHORD = 0.05, 1e-4

BEYOND = {"box": 1e-9, "rounded": 1e-3, "torus": 1e-3, "ball": 1e-3, "mirrored": 1e-3, "scaled": 1e-3}
BEYOND |= {"wavy": 1e-3, "sheet": 0.02, "turned": 0.2}
"""By name of a shape: how much farther than a fine mesh it may seem to reach, as a share of its size. A surface of
revolution counts by the control points of its profile."""


def frames(count):
    """Directions to the right and up: those of the axes, and some at random."""
    rng = np.random.default_rng(11)
    random = [np.linalg.qr(rng.normal(size=(3, 3)))[0] for _ in range(count)]
    return [tuple(map(tuple, frame[:2].tolist())) for frame in [np.eye(3), *random]]


def points_of(source):
    return np.concatenate([part.points for part in source.mesh(CHORD, ANGLE).parts])


def range_along(points, way):
    along = points @ np.array(way)
    return np.array([along.min(), along.max()])


@pytest.mark.parametrize("name", BEYOND)
def test_a_shape_reaches_as_far_as_a_fine_mesh_of_it(name):
    source = open_source(shapes()[name])
    points = points_of(source)
    size = np.linalg.norm(np.ptp(points, axis=0))
    for ways in frames(8):
        found = source.reach(*ways)
        for way, (low, high) in zip(ways, found.tolist(), strict=True):
            first, last = range_along(points, way)
            beyond = max(first - low, high - last)
            assert low <= first + 1e-9 * size and last <= high + 1e-9 * size, (name, ways)
            assert beyond <= BEYOND[name] * size, (name, ways, beyond / size)


def test_parts_that_stand_in_several_places_all_count():
    cq = pytest.importorskip("cadquery")
    rod = cq.Workplane().cylinder(10, 1)
    assembly = cq.Assembly()
    for i in range(40):
        assembly.add(rod, name=f"rod{i}", loc=cq.Location(cq.Vector(3 * i, 0, 0), cq.Vector(1, 0, 0), 9 * i))
    source = open_source(assembly)
    points = points_of(source)
    for right, up in frames(4):
        wanted = np.array([range_along(points, way) for way in (right, up)])
        assert np.allclose(source.reach(right, up), wanted, atol=1e-3)
    alone = source.of_parts(["rod3"], ((), ()))
    assert np.ptp(alone.reach((1.0, 0.0, 0.0), (0.0, 1.0, 0.0))[0]) == pytest.approx(2.0)


def test_nothing_reaches_nowhere():
    cq = pytest.importorskip("cadquery")
    from hlr.source.cad.prototypes import divided_by_kernel

    model, _ = divided_by_kernel([cq.Workplane().box(1, 2, 3).val().wrapped])
    low, high = model.reach(np.zeros(0, np.int32), np.zeros((0, 3, 4)), (1.0, 0.0, 0.0), (0.0, 1.0, 0.0)).T
    assert (low > high).all()


@pytest.mark.parametrize(("parts", "places"), [([1], np.eye(3, 4)[None]), ([0], np.zeros((2, 3, 4)))])
def test_parts_and_places_that_fit_nothing_are_refused(parts, places):
    cq = pytest.importorskip("cadquery")
    from hlr.source.cad.prototypes import divided_by_kernel

    model, _ = divided_by_kernel([cq.Workplane().box(1, 2, 3).val().wrapped])
    with pytest.raises(ValueError, match=r"parts|places"):
        model.reach(np.array(parts, np.int32), places, (1.0, 0.0, 0.0), (0.0, 1.0, 0.0))


def test_a_mesh_reaches_as_far_as_its_points():
    rng = np.random.default_rng(3)
    points = rng.normal(size=(60, 3)) * (1.0, 30.0, 0.1)
    source = open_source((points, rng.permutation(60).reshape(20, 3)))
    for right, up in frames(4):
        wanted = np.array([range_along(points, way) for way in (right, up)])
        assert np.allclose(source.reach(right, up), wanted, rtol=1e-13, atol=1e-13)


def test_parts_that_are_left_out_no_longer_count():
    far, near = trimesh.creation.box((1, 1, 1)), trimesh.creation.box((2, 2, 2))
    far.apply_translation((50, 0, 0))
    source = open_source(trimesh.Scene({"far": far, "near": near}))
    ways = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0))
    assert source.reach(*ways).tolist() == [[-1.0, 50.5], [-1.0, 1.0]]
    name = next(name for name in source.names() if "near" in name)
    assert source.bounds()[1].max() > 50
    alone = source.of_parts([name], ((), ()))
    assert alone.reach(*ways).tolist() == [[-1.0, 1.0], [-1.0, 1.0]]
    assert alone.bounds().tolist() == [[-1.0] * 3, [1.0] * 3]
