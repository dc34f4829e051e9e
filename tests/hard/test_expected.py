"""The comparison of inks must notice what is wrong, or its silence means nothing."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import hlr
from support.at_size import AT_SIZE
from support.expected import Ink, agrees, by_oracle, differences, expect, ink, read_picture, wrong_by_rays
from support.models import box, parts

CORNERS = np.array([[x, y, z] for x in (-5, 5) for y in (-10, 10) for z in (-15, 15)], float)
EDGES = [(i, j) for i in range(8) for j in range(i + 1, 8) if np.count_nonzero(CORNERS[i] != CORNERS[j]) == 1]
MESH = box((10, 20, 30))


@pytest.fixture(scope="module")
def drawing():
    return hlr.draw(MESH, (3, -1, 2), **AT_SIZE)


def boxed(drawing):
    far = CORNERS[np.argmin(CORNERS @ np.asarray(drawing.view.direction))]
    at_far = [any((CORNERS[n] == far).all() for n in edge) for edge in EDGES]
    pairs = [CORNERS[list(edge)] for edge in EDGES]
    return expect(
        drawing,
        [p for p, f in zip(pairs, at_far, strict=True) if not f],
        [p for p, f in zip(pairs, at_far, strict=True) if f],
    )


def test_a_box_by_hand_by_the_oracle_and_by_rays(drawing):
    agrees(drawing, boxed(drawing))
    agrees(
        drawing,
        by_oracle(drawing, MESH.vertices, MESH.faces, MESH.face_adjacency_edges[MESH.face_adjacency_angles > 1]),
    )
    judged, wrong = wrong_by_rays(drawing, MESH.vertices, MESH.faces)
    assert (judged, wrong) == (60, 0)


@pytest.mark.slow
@pytest.mark.parametrize("perspective", [None, hlr.Perspective(eye=(60, -20, 40))])
def test_every_change_is_noticed(perspective):
    drawing = hlr.draw(MESH, (3, -1, 2), perspective=perspective, **AT_SIZE)
    truth = boxed(drawing)
    used = drawing.accuracy.used
    assert differences(truth, ink(drawing), used) == []
    for n in range(len(drawing.lines)):
        line = drawing.lines[n]
        others = (*drawing.lines[:n], *drawing.lines[n + 1 :])
        shorter = replace(line, points=line.points[0] + (line.points - line.points[0]) * 0.95)
        moved = replace(line, points=line.points + [2 * used, -2 * used])
        for wrong in ((), (replace(line, visible=not line.visible),), (shorter,), (moved,)):
            assert differences(truth, ink(replace(drawing, lines=(*others, *wrong))), used)
        with pytest.raises(AssertionError):
            agrees(replace(drawing, lines=(*drawing.lines, line)), truth)


def test_rays_notice_what_is_wrong(drawing):
    turned = replace(drawing, lines=tuple(replace(line, visible=not line.visible) for line in drawing.lines))
    assert wrong_by_rays(turned, MESH.vertices, MESH.faces)[1] >= 15


def test_nothing_expected_is_refused(drawing):
    with pytest.raises(AssertionError):
        agrees(drawing, Ink(np.zeros((0, 2, 2)), np.zeros((0, 2, 2))))


def test_a_picture_is_read_as_it_was_drawn(tmp_path):
    model = parts(box((10, 20, 30)), box((4, 40, 4), (1, 2, 3)))
    drawing = hlr.draw(model, "iso", **AT_SIZE)
    was, read = ink(drawing), read_picture(drawing.save(tmp_path / "a.svg"))
    assert read.lengths() == pytest.approx(was.lengths(), rel=1e-4)
    assert differences(was, read, 0.01) == []
    assert len(was.hidden) > 3
