"""A helical face and its mirror image meet at a plane: both approximate one cylinder, with rounded numbers.

The tolerance of a STEP file is a length, 1e-7 mm. On a part of a third of a millimetre it was larger than the error of
the approximation, and no edge was drawn; on a larger part the same edge was drawn.
"""

from __future__ import annotations

import math
from pathlib import Path

import cadquery as cq
import pytest

import hlr


def on_circle(radius: float, degrees: float) -> tuple[float, float]:
    return radius * math.cos(math.radians(degrees)), radius * math.sin(math.radians(degrees))


def two_helical_halves(angle: float) -> cq.Shape:
    """A sector of a ring, extruded with this twist in degrees, and its mirror image in z = 0."""
    sector = cq.Workplane().moveTo(*on_circle(10, 0)).threePointArc(on_circle(10, 10), on_circle(10, 20))
    half = sector.lineTo(*on_circle(5, 20)).lineTo(*on_circle(5, 0)).close().twistExtrude(8, angle)
    return half.union(half.mirror("XY")).val()


def classes(shape: cq.Shape, size: float, folder: Path) -> list[tuple[str, bool]]:
    path = folder / f"{size}.step"
    cq.exporters.export(cq.Workplane(shape.scale(size)), str(path))
    drawing = hlr.draw(path, "iso", scale=2.0 / size, hidden=True)
    return sorted((line.kind, line.visible) for line in drawing.lines)


@pytest.mark.parametrize("size", [0.03, 1.0, 3.0, 3000.0])
def test_no_edge_is_drawn_inside_one_surface_at_any_size(size: float, tmp_path: Path) -> None:
    found = classes(two_helical_halves(5), size, tmp_path)
    assert found == classes(two_helical_halves(5), 0.1, tmp_path)
    assert not [kind for kind, _ in found if kind == "smooth"]


def test_an_edge_between_two_surfaces_is_drawn(tmp_path: Path) -> None:
    """A twist of 40 degrees is approximated so coarsely that the halves are two surfaces."""
    assert "smooth" in [kind for kind, _ in classes(two_helical_halves(40), 1.0, tmp_path)]
