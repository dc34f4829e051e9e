"""A plate with rows of windows whose sides lie in one line from window to window, but for rounding.

Between three corners in one line a planar face may have a needle of a triangle, which the grid of the image turns over.
Edges beside it were drawn hidden in full view: as edges with all their faces turned away, or as edges behind the
triangle on the needle's other side. Exporters of meshes write such needles.
"""

from __future__ import annotations

import functools
import math

import cadquery as cq
import numpy as np
import pytest
import trimesh
from hard.brep import faultless

from hlr import _kernel
from hlr.source import open_source

SIDE, STEP = 5.0, 8.0


@functools.cache
def plate(degrees: float) -> cq.Shape:
    """Windows like diamonds, in rows along the directions of their own sides."""
    slope = math.radians(degrees)
    ways = np.array([(math.cos(slope), math.sin(slope)), (-math.cos(slope), math.sin(slope))])
    windows = []
    for i in range(-2, 3):
        for j in range(-2, 3):
            corners = [
                tuple((STEP * np.array((i, j)) + SIDE * np.array(at)) @ ways) for at in ((0, 0), (1, 0), (1, 1), (0, 1))
            ]
            windows.append(cq.Workplane().polyline(corners).close().extrude(10, both=True).val())
    return cq.Workplane().box(60, 60, 4).val().cut(*windows)


@pytest.mark.slow
@pytest.mark.parametrize("degrees", [30, 60])
def test_by_rays(degrees):
    shape = plate(degrees)
    drawings = list(faultless(shape, shape, ["top", "iso", "iso-sw", (0.2, 0.3, 1)], 6000))
    assert all(len(drawing.visible) > 100 for drawing in drawings)


def heights(points, triangles):
    p, q, r = (points[triangles[:, k]] for k in range(3))
    sides = np.stack([q - p, r - q, p - r])
    return np.linalg.norm(np.cross(q - p, r - p), axis=1) / np.linalg.norm(sides, axis=2).max(axis=0)


@pytest.mark.slow
@pytest.mark.parametrize("degrees", [30, 45, 60])
def test_there_are_no_needles(degrees):
    (part,) = open_source(plate(degrees)).mesh(0.05, 0.3).parts
    assert heights(part.points, part.triangles).min() > 1e-3


def with_needles(shape: cq.Shape):
    """(points, triangles) of a mesh in which every corner that may be is the low one of a needle."""
    (part,) = open_source(shape).mesh(0.05, 0.3).parts
    points, triangles = part.points, [list(map(int, t)) for t in part.triangles]
    at = {(t[k], t[(k + 1) % 3]): i for i, t in enumerate(triangles) for k in range(3)}
    for _ in range(4):
        for q, s in sorted(at):
            if (q, s) not in at or (s, q) not in at:
                continue
            one, other = at[q, s], at[s, q]
            (r,) = set(triangles[one]) - {q, s}  # q s r and s q p
            (p,) = set(triangles[other]) - {q, s}
            sides = points[p] - points[q], points[r] - points[q]
            cosine = sides[0] @ sides[1] / np.linalg.norm(sides, axis=1).prod()
            if cosine > -1 + 1e-12 or {(p, r), (r, p)} & at.keys():
                continue
            triangles[one], triangles[other] = [r, q, p], [s, r, p]
            del at[q, s], at[s, q]
            for i in (one, other):
                t = triangles[i]
                at.update({(t[k], t[(k + 1) % 3]): i for k in range(3)})
    return points, np.array(triangles, np.int32)


def written(kind, points, triangles, folder):
    """The mesh as it is given, or as a file that rounds its coordinates."""
    if kind == "arrays":
        return points, triangles
    path = folder / f"plate.{kind}"
    if kind == "obj":
        corners = [f"v {x:.4f} {y:.4f} {z:.4f}" for x, y, z in points]
        path.write_text("\n".join(corners + [f"f {a} {b} {c}" for a, b, c in triangles + 1]) + "\n")
    else:
        trimesh.Trimesh(points, triangles, process=False).export(path)
    return path


@pytest.mark.slow
@pytest.mark.parametrize("kind", ["arrays", "stl", "obj"])
@pytest.mark.parametrize("degrees", [30, 60])
def test_a_mesh_with_needles_by_rays(degrees, kind, tmp_path):
    shape = plate(degrees)
    points, triangles = with_needles(shape)
    assert np.count_nonzero(heights(points, triangles) < 1e-9) > 50
    source = written(kind, points, triangles, tmp_path)
    drawings = list(faultless(source, shape, ["top", "iso", "iso-sw", (0.2, 0.3, 1)], 6000))
    assert all(len(drawing.visible) > 100 for drawing in drawings)
    (part,) = open_source(source).mesh(0.05, 0.3).parts
    assert len(part.triangles) == len(triangles)
    assert heights(part.points, part.triangles).min() > 1e-3


@pytest.mark.slow
def test_without_the_turning_edges_are_lost(monkeypatch):
    monkeypatch.setattr(_kernel, "without_needles", lambda *_: None)
    shape = plate(30)
    with pytest.raises(AssertionError, match="wrong_hidden"):
        list(faultless(with_needles(shape), shape, ["top", "iso", "iso-sw", (0.2, 0.3, 1)], 6000))
