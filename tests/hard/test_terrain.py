"""One large free-form face and nothing else: hills that hide one another and no edge but the border.

(terrain.brep of OpenCASCADE: one B-spline face of many spans.) All lines but four are outlines within the one face,
which end in the middle of it where the hill flattens out.
"""

from __future__ import annotations

import cadquery as cq
import pytest
from hard.brep import faultless, kinds

import hlr
from hlr.source import open_source
from support.at_size import AT_SIZE
from support.brep_shapes import rough_terrain, terrain
from support.expected import defects, of_kind


@pytest.mark.slow
@pytest.mark.parametrize("views", [["front", "iso"], [(0.36, 0.86, 0.35), (-1, -0.4, 0.25)]])
def test_by_rays(views):
    for drawing in faultless(terrain(), terrain(), views, 2000):
        assert {kind for kind, _ in kinds(drawing)} <= {"boundary", "outline"}


@pytest.mark.slow
def test_outlines_lie_where_the_surface_is_seen_edge_on(picture):
    """Each point's normal, by the B-spline itself, is square to the view but for half the turn of one chord."""
    face = terrain()
    drawing = hlr.draw(face, (-1, -0.4, 0.25), **AT_SIZE)
    found = of_kind(drawing, "outline")
    assert found
    direction = cq.Vector(*drawing.view.direction)
    for line in found:
        for x, y, z in line.points3[:: max(1, len(line.points3) // 10)]:
            normal = face.normalAt(cq.Vector(x, y, z))
            assert abs(normal.dot(direction)) < 0.25
    picture(drawing, twice=5.0)


def test_from_above_only_its_border():
    assert {line.kind for line in hlr.draw(terrain(), "top", **AT_SIZE).lines} == {"boundary"}
    (defect,) = defects(terrain())
    assert defect.startswith("open: ")


@pytest.mark.slow
def test_millions_of_triangles_within_a_long_rough_border():
    """As fine as was asked for: the many flips that the border needs before its first inner point are not too many."""
    meshed = open_source(rough_terrain()).mesh(6e-4, 0.5)
    assert meshed.notes == []
    assert 5_000_000 < meshed.parts.tables.triangle_start[-1] < 6_000_000
