"""Faces of a mesh that were meshed one by one: where their borders run together they are one surface, nowhere else."""

from __future__ import annotations

import math
from collections import Counter

import numpy as np
import pytest
import trimesh

import hlr
from hlr import _kernel
from support.at_size import AT_SIZE
from support.meshes import merged

RADIUS, LENGTH = 50.0, 100.0

Mesh = tuple[np.ndarray, np.ndarray]


def sheet(first: float, last: float, along: int, around: int, off: float = 0.0) -> Mesh:
    """A strip of a quarter pipe between two angles (degrees): so many faces along it and around; moved by `off`."""
    angle = np.radians(np.linspace(first, last, around + 1))
    y = np.linspace(0.0, LENGTH, along + 1)
    a, v = np.meshgrid(angle, y, indexing="ij")
    points = np.stack([RADIUS * np.cos(a), v, RADIUS * np.sin(a)], axis=-1).reshape(-1, 3) + [0.0, off, off]
    at = np.arange(len(points)).reshape(a.shape)
    p, q, r, s = at[:-1, :-1].ravel(), at[1:, :-1].ravel(), at[1:, 1:].ravel(), at[:-1, 1:].ravel()
    return points, np.concatenate([np.stack([p, r, q], axis=1), np.stack([p, s, r], axis=1)])


def kinds(mesh: Mesh, **options: object) -> Counter[str]:
    return Counter(line.kind for line in hlr.draw(mesh, (1, -0.5, 1), **AT_SIZE | options).lines)


def drawn(mesh: Mesh, **options: object) -> float:
    """Millimetres of borders, in the model."""
    found = hlr.draw(mesh, (1, -0.5, 1), **AT_SIZE | options)
    steps = [np.diff(line.points3, axis=0) for line in found.lines if line.kind == "boundary"]
    return sum(float(np.sqrt((step**2).sum(axis=1)).sum()) for step in steps)


RIM = 2 * LENGTH + 2 * RADIUS * math.pi / 2


@pytest.mark.parametrize("off", [0.0, 1e-4, 1e-3, -1e-3])
@pytest.mark.parametrize("along", [1, 3, 7])
def test_a_joint_within_the_gap_is_none(off: float, along: int) -> None:
    joined = merged(sheet(0, 40, 4, 6), sheet(40, 90, along, 8, off))
    assert drawn(joined) == pytest.approx(RIM, rel=0.01)
    assert set(kinds(joined)) == {"boundary"}


@pytest.mark.parametrize("off", [0.02, 0.5])
def test_a_true_gap_stays(off: float) -> None:
    # The joint is drawn, at least once: what coincides within the accuracy is one line.
    assert drawn(merged(sheet(0, 40, 4, 6), sheet(40, 90, 7, 8, off))) > RIM + 0.9 * LENGTH


def test_no_corner_moves_by_more_than_a_fifth_of_the_accuracy() -> None:
    joint = merged(sheet(0, 40, 4, 6), sheet(40, 90, 7, 8, 1e-3))
    assert drawn(joint, accuracy=0.05) == pytest.approx(RIM, rel=0.01)
    assert drawn(joint, accuracy=0.002) > RIM + 0.9 * LENGTH


def test_where_the_joint_is_an_edge_it_is_drawn_as_one() -> None:
    one = np.array([[0, 0, 0], [60, 0, 0], [60, 60, 0], [0, 60, 0.0]])
    other = np.array([[60, 0, 0.001], [60, 0, 40], [60, 60, 40], [60, 60, 0.001], [60, 20, 0.001]])
    wall = np.array([[0, 4, 1], [4, 3, 2], [4, 2, 1]])
    found = kinds(merged((one, np.array([[0, 1, 2], [0, 2, 3]])), (other, wall)))
    assert found["sharp"] == 1


def test_sheets_that_cross_or_touch_in_a_point_are_not_joined() -> None:
    low = sheet(0, 90, 4, 8)
    points, faces = sheet(0, 90, 4, 8)
    for moved in (points + [0.0, LENGTH, 0.0] - [0.0, 0.0, RADIUS], points * [1.0, 1.0, -1.0] + [-RADIUS, 0, 1e-3]):
        every, triangles = merged(low, (moved, faces))
        touching, _, seams = _kernel.stitched(every, np.ascontiguousarray(triangles, np.int32), 1e-3)
        assert seams == 0 and (touching == triangles).all()


def test_parts_are_not_joined_to_one_another() -> None:
    scene = trimesh.Scene()
    for name, (points, faces) in {"a": sheet(0, 40, 4, 6), "b": sheet(40, 90, 4, 8)}.items():
        scene.add_geometry(trimesh.Trimesh(points, faces, process=False), node_name=name, geom_name=name)
    assert drawn(scene) > RIM + 0.9 * LENGTH


def test_colours_of_corners_run_on_over_a_triangle_that_was_cut(monkeypatch: pytest.MonkeyPatch) -> None:
    def coloured(*sheets: Mesh) -> trimesh.Trimesh:
        points, faces = merged(*sheets)
        level = (255 * points[:, 1] / LENGTH).clip(0, 255).astype(np.uint8)
        colours = np.stack([level, 255 - level, level // 2, np.full_like(level, 255)], axis=1)
        return trimesh.Trimesh(points, faces, vertex_colors=colours, process=False)

    mesh = coloured(sheet(0, 40, 1, 4), sheet(40, 90, 5, 5, 1e-4))
    cut = hlr.preview(mesh, (1, -0.5, 1), size=(300, 200)).pixels
    monkeypatch.setattr("hlr.scene.stitching.MAX_GAP_SHARE", 0.0)
    whole = hlr.preview(mesh, (1, -0.5, 1), size=(300, 200)).pixels
    # Only the light is smoother, near the joint.
    assert 0 < np.abs(whole.astype(int) - cut.astype(int)).mean() < 1.0
