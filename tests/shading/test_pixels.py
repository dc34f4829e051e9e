"""Pixels of scenes whose light can be told by hand."""

import cadquery as cq
import numpy as np
import pytest
import trimesh
from shading.shapes import box, joined, linear, sheet

import hlr
from hlr.request.picture_effects import AMBIENT, DIFFUSE, SHOULDER
from hlr.source.model import DEFAULT_COLOR

LIGHT = np.array(SHOULDER) / np.linalg.norm(SHOULDER)
"""In the picture's axes: right, up, toward the viewer."""


def lit(normal, color=DEFAULT_COLOR):
    """Linear light of a surface with this unit normal, in the picture's axes."""
    return linear(np.array(color[:3]) * 255.0) * (AMBIENT + DIFFUSE * max(0.0, float(np.dot(normal, LIGHT))))


def test_a_plane_has_one_colour_and_it_is_the_right_one():
    picture = hlr.preview(box(), view="front", size=(120, 100), antialias=False)
    inner = picture.pixels[20:80, 30:90]
    assert (inner == inner[0, 0]).all()
    assert np.abs(linear(inner[0, 0, :3]) - lit((0, 0, 1))).max() < 0.005


@pytest.mark.parametrize("antialias", [False, True])
@pytest.mark.parametrize("perspective", [None, hlr.Perspective(fov=40)])
def test_a_sphere_is_shaded_by_its_true_normals(antialias, perspective):
    size = 300
    sphere = cq.Workplane().sphere(10)
    picture = hlr.preview(sphere, view="front", size=(size, size), antialias=antialias, perspective=perspective)
    y, x = np.mgrid[0:size, 0:size] + 0.5
    if perspective is None:
        nx, ny = (x - size / 2) / (10 * picture.scale), -(y - size / 2) / (10 * picture.scale)
        inside = nx**2 + ny**2 < 0.98**2
        nz = np.sqrt(np.where(inside, 1 - nx**2 - ny**2, 0))
    else:
        # Rays from the eye at (0, 0, d): the nearer point where they meet the sphere.
        d = picture.view.distance
        rx, ry = (x - size / 2) / picture.scale, -(y - size / 2) / picture.scale
        a, b, c = rx**2 + ry**2 + d * d, -2 * d * d, d * d - 100.0
        under = b * b - 4 * a * c
        inside = under > 0.1 * 400 * d * d
        t = (-b - np.sqrt(np.where(inside, under, 0))) / (2 * a)
        nx, ny, nz = rx * t / 10, ry * t / 10, (d - d * t) / 10
    facing = np.maximum(0, nx * LIGHT[0] + ny * LIGHT[1] + nz * LIGHT[2])
    expected = linear(np.array(DEFAULT_COLOR[:3]) * 255.0) * (AMBIENT + DIFFUSE * facing)[..., None]
    off = np.abs(linear(picture.pixels[:, :, :3]) - expected).max(axis=2)[inside]
    assert inside.sum() > 25000
    assert off.max() < 0.012


def test_planar_faces_are_flat_to_the_last_bit():
    plate = cq.Workplane().box(40, 30, 5).faces(">Z").workplane().rarray(8, 8, 4, 3).hole(4)
    picture = hlr.preview(plate, view="top", size=(400, 300), antialias=False, ids=True)
    for face in np.unique(picture.ids[picture.ids >= 0]):
        shades = np.unique(picture.pixels[picture.ids == face], axis=0)
        assert len(shades) == 1 or face > 20  # walls of bores are seen edge-on


def test_meshes_are_smooth_up_to_creases():
    ball = trimesh.creation.icosphere(subdivisions=4, radius=10)
    picture = hlr.preview(ball, view="front", size=(200, 200), antialias=False)
    middle = linear(picture.pixels[100, 100, :3])
    assert np.abs(middle - lit((0, 0, 1))).max() < 0.01
    creased = hlr.preview(ball, view="front", size=(200, 200), antialias=False, crease=1.0)
    # Facets show as steps between runs of one colour.
    shades = [len(np.unique(p.pixels[60, 40:160, :3], axis=0)) for p in (picture, creased)]
    assert shades[0] > 1.3 * shades[1]


def test_colours_are_interpolated_perspective_correct():
    # A road from near to far, black to white along its length: in the middle of the picture it is not half way.
    road = trimesh.Trimesh(*sheet([(-1, 0, 0), (1, 0, 0), (1, 30, 0), (-1, 30, 0)]), process=False)
    road.visual.vertex_colors = np.array([(0, 0, 0, 255)] * 2 + [(255, 255, 255, 255)] * 2, np.uint8)
    eye, target = (0.0, -10.0, 10.0), (0.0, 8.0, 0.0)
    camera = hlr.Perspective(eye=eye, target=target, fov=60)
    picture = hlr.preview(road, size=(201, 201), perspective=camera, antialias=False)
    view = picture.view
    axes = np.array([view.right, view.up, view.direction])
    light = AMBIENT + DIFFUSE * float(LIGHT @ axes[:, 2])
    half = np.tan(np.radians(30))
    for row in (75, 95, 115):
        up = (100.5 - (row + 0.5)) / 100.5 * half
        ray = -np.array(view.direction) + up * np.array(view.up)
        hit = np.array(eye) + ray * (eye[2] / -ray[2])
        assert 0 < hit[1] < 30
        found = linear(picture.pixels[row, 100, :3])
        assert np.abs(found - hit[1] / 30 * light).max() < 0.008


@pytest.mark.parametrize("antialias", [False, True])
def test_a_closed_mesh_has_no_holes(antialias):
    # Random triangulations of a square that fills the picture: every pixel is covered, none through a crack.
    rng = np.random.default_rng(3)
    inner = rng.random((300, 2)) * 2 - 1
    rim = np.array([(x, y) for x in (-1, 1) for y in (-1, 1)])
    from scipy.spatial import Delaunay

    flat = np.concatenate([rim, inner])
    triangles = Delaunay(flat).simplices
    points = np.column_stack([flat[:, 0], np.zeros(len(flat)), flat[:, 1]])
    camera = hlr.Perspective(eye=(0, -1.5, 0), target=(0, 0, 0), fov=50)
    picture = hlr.preview(
        (points, triangles), size=(160, 160), perspective=camera, antialias=antialias, background="red", ids=True
    )
    assert (picture.ids == 0).all()
    assert (picture.pixels[:, :, 0] <= picture.pixels[:, :, 2]).all()


def test_antialiased_coverage_is_the_share_of_the_pixel():
    # A vertical border through pixels at 16 places: 16 samples tell all of them apart.
    wall = sheet([(-50, 0, -50), (0, 0, -50), (0, 0, 50), (-50, 0, 50)])
    camera = hlr.Perspective(eye=(0, -50, 0), target=(0, 0, 0), fov=90)
    seen = set()
    for k in range(16):
        points = wall[0] + np.array([(2 * k + 1) / 32, 0, 0])
        # One unit is one pixel: the picture is 100 units high.
        picture = hlr.preview((points, wall[1]), size=(100, 100), perspective=camera, background="black")
        full, here = linear(picture.pixels[50, 40, 0]), linear(picture.pixels[50, 50, 0])
        share = float(here / full)
        assert abs(share - (2 * k + 1) / 32) < 0.04
        seen.add(round(share * 16))
    assert len(seen) >= 15


def test_what_crosses_the_near_plane_is_cut_and_not_lost():
    # A floor from behind the eye to the horizon.
    floor = sheet([(-50, -50, 0), (50, -50, 0), (50, 200, 0), (-50, 200, 0)])
    camera = hlr.Perspective(eye=(0, 0, 5), target=(0, 10, 0), fov=60)
    picture = hlr.preview(floor, size=(200, 150), perspective=camera, depth=True)
    assert np.isfinite(picture.depth[-1]).all()
    view, half = picture.view, np.tan(np.radians(30))
    for row, column in ((149, 0), (149, 199), (100, 50), (60, 120)):
        side = (column + 0.5 - 100) / 75 * half
        up = (75 - (row + 0.5)) / 75 * half
        ray = -np.array(view.direction) + up * np.array(view.up) + side * np.array(view.right)
        assert picture.depth[row, column] == pytest.approx(5 / -ray[2], rel=2e-3)


def test_an_eye_inside_a_body_sees_its_walls():
    camera = hlr.Perspective(eye=(0, 0, 0), target=(1, 0, 0), fov=80)
    picture = hlr.preview(box(20), size=(80, 60), perspective=camera, depth=True)
    assert np.isfinite(picture.depth).all()
    assert picture.depth[30, 40] == pytest.approx(10, rel=1e-3)


def test_parts_hide_one_another_by_depth():
    back = sheet([(-2, 1, -2), (2, 1, -2), (2, 1, 2), (-2, 1, 2)])
    front = sheet([(-1, 0, -1), (1, 0, -1), (1, 0, 1), (-1, 0, 1)])
    for order in (joined(back, front), joined(front, back)):
        picture = hlr.preview(order, view="front", size=(100, 100), depth=True, antialias=False)
        assert picture.depth[50, 50] < picture.depth[10, 10]
        assert picture.depth[10, 10] - picture.depth[50, 50] == pytest.approx(1.0, abs=1e-4)


def test_surfaces_that_pass_through_one_another_meet_where_their_depths_are_equal():
    one = sheet([(-1, -1, -1), (1, 1, -1), (1, 1, 1), (-1, -1, 1)])
    two = sheet([(-1, 1, -1), (1, -1, -1), (1, -1, 1), (-1, 1, 1)])
    picture = hlr.preview(joined(one, two), view="front", size=(101, 101), depth=True, antialias=False)
    x = (np.arange(101) + 0.5 - 50.5) / picture.scale
    inside = np.abs(x) < 0.98
    expected = -np.abs(x)
    assert np.abs(picture.depth[50] - expected)[inside].max() < 2e-3
