"""A part added behind or beside all others changes no visible line of theirs.

IDENTICAL  of B-rep parts that do not run into one another, with a part added behind all others and within their
           outline: the visible lines in every coordinate on paper and in the model, their order and owners, and the
           origin. The added part lengthens the grid of integers in depth alone, and where lines are cut depends on
           the image.
MAY MOVE   beside, above or below the others the added part makes a coarser grid: lines move by up to two of its steps,
           2^-28 of the whole, on top of the origin's. Lines that were cut where parts pierce one another move so too
           when the part stands behind. Where that decides a tie, ink up to `ink.LONGEST` may change.
           Of meshes without B-rep the contact tolerance grows with the whole model (`tolerance.MESH_CONTACT`): they
           are not held to the first.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from properties import changes, models
from properties.assemblies import HULLS, Piece, assemblies, assembly, examples, part, standing_apart, views
from properties.frozen import Frozen, draw
from properties.identity import identities
from properties.ink import expect_same_ink

ACCURACY = 0.01
few = examples(20)


def stranger(kind: str, brep: bool, middle, axes, sizes) -> Frozen:
    """A solid of those half sizes along the axes (right, up, toward the viewer), standing round a middle."""
    mesh = part(Piece(kind, (0, 0, 0), (1, 1, 1)), 0, brep)
    local = (HULLS[kind].corners * 2.0 - 1.0) * np.asarray(sizes)
    points = np.asarray(middle) + local @ np.stack(axes)
    return Frozen((replace(mesh, name="stranger", points=points),), brep)


def place(model, before, where, kind):
    """The model and a stranger behind it, or beside it to the right."""
    view = before.view
    axes = [np.array(v) for v in (view.right, view.up, view.direction)]
    low, high = (f(np.stack([model.points @ a for a in axes], axis=1), axis=0) for f in (np.min, np.max))
    size = float((high - low).max())
    if where == "behind":
        middle, half = (low + high) / 2, np.array([*(0.25 * (high - low)[:2]), 0.1 * size])
        middle[2] = low[2] - 0.5 * size
    else:
        middle, half = (low + high) / 2, np.full(3, 0.1 * size)
        middle[0] = high[0] + 0.5 * size
    solid = stranger(kind, model.brep, middle @ np.stack(axes), axes, half)
    return changes.joined_by(model, solid)


def own(drawing, count, visible=None):
    """The lines of the first parts only, in order."""
    lines = tuple(x for x in drawing.lines if x.part < count and visible in (None, x.visible))
    return replace(drawing, lines=lines)


solids = st.sampled_from(["box", "pentagon", "cylinder", "tetrahedron"])


@pytest.mark.slow
@few
@given(standing_apart(("box", "wedge", "pentagon", "cylinder")), views, solids)
def test_behind_parts_that_stand_apart_the_visible_lines_are_the_same(several, view, kind):
    expect_identical_before(assembly(several), view, ACCURACY, kind)


def expect_identical_before(model, view, accuracy, kind):
    before = draw(model, view, accuracy)
    more = place(model, before, "behind", kind)
    after = draw(more, view, accuracy)
    assert after.origin == before.origin
    was, now = (own(d, len(model.parts), True) for d in (before, after))
    assert identities(now) == identities(was)
    for one, other in zip(was.lines, now.lines, strict=True):
        assert (one.points == other.points).all() and (one.points3 == other.points3).all()


@pytest.mark.slow
@pytest.mark.parametrize("name", [models.SCREW, models.PLATE])
@pytest.mark.parametrize("view", ["front", "iso"])
def test_behind_a_model_of_one_part(name, view):
    expect_identical_before(models.model(name), view, models.accuracy(models.model(name)), "cylinder")


@pytest.mark.slow
@few
@given(assemblies(), st.booleans(), views, st.sampled_from(["behind", "beside"]), solids)
def test_of_any_assembly_the_visible_ink_stays(several, brep, view, where, kind):
    model = assembly(several, brep)
    expect_ink_to_stay(model, view, ACCURACY, where, kind, intersections=False)


@pytest.mark.parametrize("where", ["behind", "beside"])
def test_of_an_assembly_from_a_file_the_visible_ink_stays(where):
    model = models.model(models.ASSEMBLY)
    expect_ink_to_stay(model, "iso", models.accuracy(model), where, "box")


def expect_ink_to_stay(model, view, accuracy, where, kind, **options):
    """A part beside all others hides nothing, so the hidden ink stays too."""
    before = draw(model, view, accuracy, **options)
    more = place(model, before, where, kind)
    after = own(draw(more, view, accuracy, **options), len(model.parts))
    expect_same_ink(before, after, hidden=where == "beside")


def test_what_stands_in_front_is_noticed():
    """The comparison can fail."""
    model = assembly([Piece("box", (0, 0, 0), (4, 4, 4))])
    before = draw(model, "front", ACCURACY)
    v = before.view
    near = stranger("box", True, (2, -9, 2), [np.array(a) for a in (v.right, v.up, v.direction)], (3, 1, 1))
    after = own(draw(changes.joined_by(model, near), "front", ACCURACY), 1)
    with pytest.raises(AssertionError):
        expect_same_ink(before, after, hidden=False)
