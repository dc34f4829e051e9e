"""Lines of the model that run past the eye and on behind it: only the part before the eye has an image."""

import cadquery as cq
import numpy as np
import pytest

import hlr
from hlr.lab.measure import measured
from hlr.lab.measure.paper import Paper
from hlr.source import open_source
from support.at_size import AT_SIZE

ACCURACY = 0.05
EYE = hlr.Perspective(eye=(0.0, 6.0, 15.0), target=(40.0, 0.0, 0.0))


def floor_with_a_wall():
    """Both run from 50 mm before the eye to 50 behind it, and so do the lines in which they meet."""
    floor = cq.Workplane().box(100, 20, 4)
    return cq.Assembly().add(floor, name="floor").add(cq.Workplane().box(100, 4, 12), name="wall")


def as_mesh():
    corners, triangles = cq.Workplane().box(100, 20, 4).val().tessellate(0.1)
    return np.array([v.toTuple() for v in corners]), np.array(triangles)


@pytest.fixture(scope="module")
def drawing():
    return hlr.draw(floor_with_a_wall(), perspective=EYE, accuracy=ACCURACY, **AT_SIZE)


def test_of_a_line_past_the_eye_the_part_before_it_is_projected(drawing):
    paper = Paper.of(drawing)
    starts, ends = np.array([[30.0, 1, 0], [30, 1, 0], [-30, 1, 0], [-60, 1, 0]]), np.array([[40.0, 1, 0]] * 4)
    ends[1, 0] = ends[3, 0] = -50.0
    chords, shares = paper.chords(starts, ends)
    assert np.isfinite(chords[:3]).all() and np.isnan(chords[3]).all() and np.isnan(paper(starts[2:])).all()
    assert (chords[0] == paper(np.array([starts[0], ends[0]])).ravel()).all()
    assert shares[0].tolist() == [0.0, 1.0] and shares[1, 0] == 0.0 < shares[1, 1] < 1.0 == shares[2, 1]
    # All three lie on one line, on its side away from the eye.
    way = chords[0, 2:] - chords[0, :2]
    for x, y in chords[1:3].reshape(-1, 2) - chords[0, :2]:
        assert abs(x * way[1] - y * way[0]) < 1e-6 * np.hypot(*way) * np.hypot(x, y) + 1e-9


@pytest.mark.slow
def test_edges_and_intersection_lines_that_pass_the_eye_are_measured_before_it(drawing):
    reached = measured(open_source(floor_with_a_wall()), drawing)
    assert any(line.kind == "intersection" for line in drawing.lines)
    assert reached.edges.worst < 0.1 * ACCURACY and reached.intersections.worst < 0.1 * ACCURACY, reached.as_dict()
    assert reached.kept(), reached.as_dict()


def test_edges_of_a_mesh_that_pass_the_eye_are_measured_before_it():
    mesh = as_mesh()
    reached = measured(open_source(mesh), hlr.draw(mesh, perspective=EYE, accuracy=ACCURACY, **AT_SIZE))
    assert reached.meshes.count and reached.meshes.worst < 0.1 * ACCURACY, reached.as_dict()
