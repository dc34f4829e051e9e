"""Sections whose plane lies on a face of the model, or nearly so: the floor of a pocket, or the top of a bore.

The floor of a pocket that lies on the plane is seen there and not hatched, as a draughtsman leaves it, whatever the
last digits of its height: STL files round them. A curved face that the plane nearly touches is no cut face.
"""

from __future__ import annotations

import math

import cadquery as cq
import numpy as np
import pytest
import trimesh
from hard.brep import same

import hlr
from support.at_size import AT_SIZE
from support.sections import measured_area

HEIGHTS = [0.1, 0.3, 1.1, 3.3, 6.35, 10.1, 12.7, 25.4, 41.7, 63.3, 100.3, 123.4, 254.7]
RING = 40.0 * 30.0 - 20.0 * 10.0
"""Square millimetres of the block beside its pocket."""


def block() -> cq.Shape:
    """A block with a pocket, whose floor is at z = 0."""
    return cq.Workplane().box(40, 30, 20).faces(">Z").workplane().rect(20, 10).cutBlind(-10).val()


def tessellated(move: np.ndarray) -> trimesh.Trimesh:
    """The block after a motion (4, 4)."""
    points, triangles = block().tessellate(0.01)
    mesh = trimesh.Trimesh(np.array([p.toTuple() for p in points]), triangles)
    mesh.apply_transform(move)
    return mesh


def lifted(height: float):
    move = np.eye(4)
    move[2, 3] = height
    return move


@pytest.mark.parametrize("view", ["top", "bottom"])
@pytest.mark.parametrize("height", HEIGHTS)
def test_an_stl_file_is_cut_as_the_solid_at_every_height(tmp_path, height, view):
    path = str(tmp_path / "block.stl")
    tessellated(lifted(height)).export(path)
    solid = block().moved(cq.Location(cq.Vector(0, 0, height)))
    found = [hlr.draw(each, view, section=height, **AT_SIZE) for each in (path, solid)]
    assert measured_area(found[0]) == pytest.approx(RING, rel=0.03)
    same(*found)


@pytest.mark.parametrize("reach", [50.0, 1000.0])
@pytest.mark.parametrize("seed", range(6))
def test_a_mesh_that_is_turned_and_rounded_is_cut_so_too(seed, reach):
    rng = np.random.default_rng(seed)
    move = trimesh.transformations.random_rotation_matrix(rng.random(3))
    move[:3, 3] = reach * rng.normal(size=3)
    mesh = tessellated(move)
    mesh.vertices = mesh.vertices.astype(np.float32)
    drawing = hlr.draw(mesh, tuple(move[:3, 2]), section=tuple(move[:3, 3]), **AT_SIZE)
    assert measured_area(drawing) == pytest.approx(RING, rel=0.03)
    # The border of the block and that of the pocket, seen straight on.
    length = sum(
        np.linalg.norm(np.diff(line.points, axis=0), axis=1).sum() for line in drawing.visible if line.kind == "sharp"
    )
    assert length == pytest.approx(2 * (40 + 30 + 20 + 10), rel=1e-3)


@pytest.mark.parametrize("step", [-15.0, 0.0, 15.0])
@pytest.mark.parametrize("below", [0.0, 1e-7, 1e-6, 3e-6, -1e-6])
@pytest.mark.parametrize("kind", ["solid", "mesh"])
def test_a_plane_that_steps_is_put_on_the_floor(kind, below, step):
    model = block().rotate(cq.Vector(), cq.Vector(1, 0, 0), 90.0)
    if kind == "mesh":
        model = tessellated(trimesh.transformations.rotation_matrix(math.pi / 2, [1, 0, 0]))
    # The block is turned so that its floor looks to the front, at y = 0; the planes lie at 0, and 3 mm behind it.
    drawing = hlr.draw(model, "front", section=(below, (step, 3.0)), **AT_SIZE)
    wanted = 30.0 * (20.0 + step) - 10.0 * (10.0 + np.clip(step, -10.0, 10.0)) + 30.0 * (20.0 - step)
    assert measured_area(drawing) == pytest.approx(wanted, rel=0.03)


@pytest.mark.parametrize("below", [0.0001, 0.001, 0.005, 0.01, 0.05])
@pytest.mark.parametrize("radius", [5.0, 50.0])
def test_the_slit_that_a_plane_makes_in_the_top_of_a_bore_is_open(radius, below):
    scale, side = 100.0 / radius, 3.0 * radius
    bore = cq.Workplane().box(side, 60, side).faces("<Y").workplane().hole(2.0 * radius)
    top = radius - below / scale
    drawing = hlr.draw(bore, view="bottom", section=top, scale=scale)
    slit = 2.0 * math.sqrt(radius**2 - top**2)
    ends = np.concatenate([line.points3[:, 0] for line in drawing.lines if line.kind == "hatch"])
    assert np.abs(ends).min() > 0.49 * slit
    sharp = [line.points3[:, 0] for line in drawing.visible if line.kind == "sharp"]
    edges = np.unique([across.round(9) for across in sharp if np.ptp(across) < 1e-6])
    # At less than half a degree the bore goes on smoothly as the cut.
    borders = [-slit / 2, slit / 2] if below > 0.002 else []
    assert edges == pytest.approx(sorted([-side / 2, *borders, side / 2]), abs=1e-6)


def test_closed_bodies_beside_the_plane_are_not_called_open():
    boxes = [trimesh.creation.box((10, 10, 10)) for _ in range(2)]
    for box, side in zip(boxes, (5.0, -5.0), strict=True):
        box.apply_translation((side, side, 0.0))
    drawing = hlr.draw(trimesh.util.concatenate(boxes), "front", section=0.0, **AT_SIZE)
    (text,) = [note.text for note in drawing.notes if note.code == "section-not-hatched"]
    assert "goes through no part" in text


def test_picture(picture, tmp_path):
    path = str(tmp_path / "block.stl")
    tessellated(lifted(0.1)).export(path)
    picture(hlr.draw(path, "top", section=0.1, **AT_SIZE))
