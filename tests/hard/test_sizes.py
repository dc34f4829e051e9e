"""The same shape in nanometres and in thousands of kilometres, at the origin and a kilometre away from it.

Tolerances in model units (1e-7 is OpenCASCADE's own) make small models vanish and far ones break; single precision has
half a millimetre left at 10 km. Fitted onto the same paper all drawings must be the same.
"""

from __future__ import annotations

import numpy as np
import pytest

import hlr
from support.at_size import ALL_LINES, AT_SIZE
from support.expected import agrees, by_oracle, defects, differences, ink, on_paper
from support.meshes import BOX_EDGES, as_parts, box, merged, moved

EDGES = [*BOX_EDGES, *((i + 8, j + 8) for i, j in BOX_EDGES)]
SHAPE = merged(box((-1, -1, -1), (1, 1, 1)), box((-0.5, -3, -0.25), (0.5, 0, 0.5)))
FIT = (60.0, 60.0)


@pytest.mark.slow
@pytest.mark.parametrize("size", [1e-30, 1e-12, 1e-9, 1e-6, 1.0, 1e6, 1e9, 1e12, 1e30])
@pytest.mark.parametrize("view", ["iso", (1, -2, 0.5)])
def test_any_size_gives_the_same_drawing(picture, size, view):
    points, triangles = SHAPE
    drawing = hlr.draw((points * size, triangles), view, fit=FIT, **ALL_LINES)
    agrees(drawing, by_oracle(drawing, points * size, triangles, EDGES), step=0.5, without=("intersection",))
    plain = ink(hlr.draw((points, triangles), view, fit=FIT, **ALL_LINES))
    assert not differences(plain, ink(drawing), drawing.accuracy.used)
    if size == 1.0 and view == "iso":
        picture(drawing)
    assert defects((points * size, triangles)) == defects((points, triangles))


@pytest.mark.parametrize("size", [1e-55, 1e55])
@pytest.mark.parametrize("view", ["iso", (1, -2, 0.5)])
def test_the_extremes_that_are_accepted(size, view):
    points, triangles = SHAPE
    drawing = hlr.draw((points * size, triangles), view, fit=FIT, **ALL_LINES)
    agrees(drawing, by_oracle(drawing, points * size, triangles, EDGES), step=0.5, without=("intersection",))


@pytest.mark.parametrize(
    ("size", "reason"),
    [
        (1e-150, r"is only 4e-150 large, where 1e-60 is the least: scale the model up\.$"),
        (1e-300, r"is only 4e-300 large"),
        (1e-61, r"is only 4e-61 large"),
        (1e61, r"coordinates beyond 1e\+60"),
        (1e150, r"has no finite size, or coordinates beyond 1e\+60: repair the model\.$"),
    ],
)
def test_sizes_beyond_all_reason_are_refused_in_words(size, reason):
    # Normals are products of lengths: where they vanish, every crease would, and nothing would be said.
    points, triangles = SHAPE
    for draw in (hlr.draw, hlr.info):
        with pytest.raises(hlr.SourceError, match=reason):
            draw((points * size, triangles))


@pytest.mark.parametrize("away", [1e3, 1e6, 1e9])
@pytest.mark.parametrize("view", ["iso", (1, -2, 0.5), "front"])
def test_a_small_part_far_from_the_origin(away, view):
    # At 1e9 a double has steps of 1.2e-7 left, still far below the accuracy.
    points, triangles = moved(SHAPE, lambda p: p * 0.5 + [away, -away, away / 2])
    drawing = hlr.draw((points, triangles), view, scale=20, **ALL_LINES)
    near = hlr.draw((points - points.mean(axis=0), triangles), view, scale=20, **ALL_LINES)
    shift = on_paper(drawing, [points.mean(axis=0)])[0]
    there, here = ink(drawing), ink(near)
    here = type(here)(here.visible + shift, here.hidden + shift)
    assert not differences(here, there, drawing.accuracy.used)
    agrees(drawing, by_oracle(drawing, points, triangles, EDGES), step=0.5, without=("intersection",))


def test_a_huge_and_a_tiny_part_in_one_scene():
    # 1 km and 0.01 mm: on one sheet the tiny one is nothing, however the sheet is scaled; drawn alone it is all there.
    huge, tiny = box((0, 0, 0), (1e6, 1e6, 1e6)), box((-0.01, -0.01, 0), (0, 0, 0.01))
    drawing = hlr.draw(as_parts(huge, tiny), "iso", fit=(200, 200), **ALL_LINES)
    agrees(drawing, by_oracle(drawing, *huge, BOX_EDGES), step=2.0)
    assert {line.part for line in drawing.lines} == {0}
    alone = hlr.draw(tiny, "iso", fit=(200, 200), **ALL_LINES)
    agrees(alone, by_oracle(alone, *tiny, BOX_EDGES), step=2.0)


def test_a_tiny_part_beside_a_huge_one_at_a_scale_that_would_show_it_is_refused_in_words():
    huge, tiny = box((0, 0, 0), (1e6, 1e6, 1e6)), box((-0.01, -0.01, 0), (0, 0, 0.01))
    with pytest.raises(hlr.OptionError, match=r"accuracy 0\.05 mm is too fine for a drawing of .* mm: give at least"):
        hlr.draw(as_parts(huge, tiny), "iso", scale=1000, **ALL_LINES)


def test_one_flat_dimension_a_million_times_thinner():
    points, triangles = box((0, 0, 0), (100, 60, 1e-4))
    for view in ("iso", (0.1, 0.2, 1), "front", "top"):
        drawing = hlr.draw((points, triangles), view, **AT_SIZE)
        agrees(drawing, by_oracle(drawing, points, triangles, BOX_EDGES), step=0.5)
        assert np.isfinite(np.concatenate([line.points3 for line in drawing.lines])).all()
