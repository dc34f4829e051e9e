"""Parts far from all others are named, and only those."""

import numpy as np
import pytest
import trimesh

import hlr
from support.at_size import ALL_LINES


def scene(centres, size=2.0):
    found = trimesh.Scene()
    for i, centre in enumerate(centres):
        box = trimesh.creation.box((size, size, size))
        box.apply_translation(centre)
        found.add_geometry(box, geom_name=f"p{i}", node_name=f"p{i}")
    return found


GRID = [(x, y, 0.0) for x in range(0, 12, 3) for y in range(0, 12, 3)]


def stray(centres, view="iso", **options):
    notes = hlr.draw(scene(centres), view, scale=2.0, **ALL_LINES | options).notes
    return [note.text for note in notes if note.code == "stray-parts"]


def test_one_part_far_away_is_named_with_the_cure():
    (text,) = stray([*GRID, (200.0, 0.0, 0.0)])
    assert 'the part "p16" lies far from the rest' in text
    assert '--hide "p16" (in Python, hide=["p16"])' in text
    assert stray([*GRID, (200.0, 0.0, 0.0)], hide=["p16"]) == []


def test_a_few_on_different_sides():
    (text,) = stray([(0.0, -300.0, 0.0), *GRID, (200.0, 0.0, 0.0)])
    assert text.startswith("2 parts lie far") and '--hide "p0" --hide "p17"' in text


def test_along_the_view_nothing_is_stretched():
    assert stray([*GRID, (0.0, 0.0, 500.0)], "top") == []
    assert len(stray([*GRID, (0.0, 0.0, 500.0)], "front")) == 1


@pytest.mark.parametrize(
    "centres",
    [
        GRID,
        [(0.0, 0.0, 0.0), (200.0, 0.0, 0.0)],
        [(float(x), 0.0, 0.0) for x in (0, 50, 100, 150, 200)],  # all are far from one another
        [(0.0, 0.0, 0.0), (3.0, 0.0, 0.0), (6.0, 0.0, 0.0), (200.0, 0.0, 0.0), (203.0, 0.0, 0.0), (206.0, 0.0, 0.0)],
        [*GRID, (20.0, 0.0, 0.0)],  # not that far
    ],
)
def test_models_without_strays(centres):
    assert stray(centres) == []


def test_a_large_plate_under_small_parts_is_no_stray():
    found = scene(GRID)
    plate = trimesh.creation.box((300, 300, 1))
    plate.apply_translation((0, 0, -2))
    found.add_geometry(plate, geom_name="plate", node_name="plate")
    assert not [note for note in hlr.draw(found, scale=2.0, **ALL_LINES).notes if note.code == "stray-parts"]


def test_it_is_a_remark_and_previews_have_it_too():
    far = scene([*GRID, (200.0, 0.0, 0.0)])
    assert hlr.draw(far, scale=2.0, strict=True, **ALL_LINES).notes
    assert [note.code for note in hlr.preview(far, size=(20, 20), strict=True).notes] == ["stray-parts"]


def test_the_search_takes_next_to_no_time():
    from hlr.image.strays import strays

    rng = np.random.default_rng(1)
    low = rng.random((100_000, 2))
    assert strays(low, low + 0.01) == []
