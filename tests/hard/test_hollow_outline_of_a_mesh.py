"""A torus as a mesh, on the hollow side of which the edges of the contour run on beyond one another.

In the hole of a torus, as at the neck of a vase, each edge of the mesh's contour reaches beyond the place where the
next one crosses it, and short edges behind lead back. Drawn as they are, these spikes are a millimetre long or more,
and what is one line in the B-rep's drawing comes in dozens. The B-rep's drawing is the oracle.
"""

from __future__ import annotations

import cadquery as cq
import numpy as np
import pytest
from scipy.spatial import cKDTree

import hlr
from hlr.drawing.drawing import Drawing
from support.at_size import AT_SIZE
from support.expected import wrong_by_rays
from support.meshes import torus

MAJOR, MINOR = 20.0, 6.0
MESHES = [(48, 20), (90, 36), (120, 48)]
STEEP = (0.3, -1.0, 1.0)
"""A sight in which the inner outline is closed. In the flatter ones it has cusps, at which it ends."""
FLATTER = [(0.3, -1.0, 0.3), (0.3, -1.0, 0.5), (0.3, -1.0, 0.6)]
STEP = 0.02


def deflection(around: int, across: int) -> float:
    """How far the chords of the mesh are from the torus, at most: those around it, and those of the tube."""
    return float((MAJOR + MINOR) * (1 - np.cos(np.pi / around)) + MINOR * (1 - np.cos(np.pi / across)))


def both(around, across, sight) -> tuple[Drawing, Drawing]:
    solid = cq.Workplane(cq.Solid.makeTorus(MAJOR, MINOR))
    return hlr.draw(torus(MAJOR, MINOR, around, across), sight, **AT_SIZE), hlr.draw(solid, sight, **AT_SIZE)


def outlines(drawing):
    """The points of each visible outline, from the middle of the drawing."""
    low, high = (f([f(line.points, axis=0) for line in drawing.lines], axis=0) for f in (np.min, np.max))
    seen = [line for line in drawing.lines if line.visible and line.kind == "outline"]
    return [line.points - 0.5 * (low + high) for line in seen]


def ink(lines):
    """Points along lines, one for each `STEP` of a millimetre."""
    out = []
    for points in lines:
        lengths = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(points, axis=0), axis=1))])
        at = np.arange(0.0, lengths[-1], STEP)
        out.append(np.stack([np.interp(at, lengths, points[:, k]) for k in (0, 1)], axis=1))
    return np.concatenate(out)


def farthest(of, beside) -> float:
    return float(cKDTree(beside).query(of)[0].max())


@pytest.mark.parametrize("mesh", MESHES)
def test_without_cusps_it_is_drawn_as_the_solid_is(mesh):
    drawn, wanted = (outlines(drawing) for drawing in both(*mesh, STEEP))
    assert len(drawn) == len(wanted) == 2
    assert farthest(ink(drawn), ink(wanted)) <= deflection(*mesh) + STEP
    assert farthest(ink(wanted), ink(drawn)) <= deflection(*mesh) + STEP


@pytest.mark.parametrize("sight", FLATTER)
@pytest.mark.parametrize("mesh", MESHES)
def test_with_cusps_nothing_is_missing_and_little_sticks_out(picture, mesh, sight):
    drawing, solid = both(*mesh, sight)
    drawn, wanted = outlines(drawing), outlines(solid)
    # At a cusp some edges stick out of what hides the outline on either side of them; before there were 28 lines.
    assert len(drawn) <= len(wanted) + 8
    assert farthest(ink(wanted), ink(drawn)) <= deflection(*mesh) + drawing.accuracy.used
    assert len(ink(drawn)) <= 1.03 * len(ink(wanted))
    if (mesh, sight) == (MESHES[-1], FLATTER[-1]):
        picture(drawing, twice=1.0)


@pytest.mark.parametrize("sight", [STEEP, *FLATTER])
def test_what_is_drawn_is_visible(sight):
    points, triangles = torus(MAJOR, MINOR, *MESHES[1])
    judged, wrong = wrong_by_rays(hlr.draw((points, triangles), sight, **AT_SIZE), points, triangles)
    assert judged >= 10
    assert wrong == 0
