"""A small change of the input never causes a large change of the drawing.

Every point of the mesh is moved by up to JIGGLE accuracies: a fortieth of the least contact tolerance (that of flat
B-rep parts, `tolerance.CONTACT_PLANAR`, a fiftieth of the accuracy), so that contacts stay contacts even seen at a
slope of ten, and far less than the smallest gap in these scenes.

IDENTICAL  nothing need be.
MAY MOVE   ink, by the accuracy. A stretch may appear, vanish or change class only up to `ink.LONGEST`, two doubtful
           pieces and a hidden one between them: a piece in contact is decided by its length, hidden up to ten
           accuracies beside a hidden piece and else visible, and a change of any size may carry it over. What changes
           in all is at most SHARE of the ink.

Left out are views along a flat face that runs tangentially into a curved one (see the last test), and meshes with
slivers thinner than the jiggle, which it folds at will. Intersection lines of random parts are left out too: where two
surfaces touch all along, rounding decides where such a line ends.
"""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from properties import changes, ink, models
from properties.assemblies import Piece, assemblies, assembly, examples, upright, views
from properties.frozen import draw, freeze

ACCURACY = 0.01
JIGGLE = 5e-4
SHARE = 0.005
few = examples(25)
generators = st.integers(0, 10**6).map(np.random.default_rng)


def expect_stable(model, view, accuracy, rng, jiggle=JIGGLE, **options):
    before = draw(model, view, accuracy, **options)
    amount = jiggle * accuracy / before.unit
    found = ink.change(before, draw(changes.jiggled(model, amount, rng), view, accuracy, **options))
    assert found.longest <= ink.LONGEST, str(found)
    assert found.share <= SHARE, str(found)


@pytest.mark.slow
@few
@given(assemblies(upright), st.booleans(), views, generators)
def test_solids_on_a_lattice(pieces, brep, view, rng):
    """Touching, flush and crossing: all that a jiggle can pull apart."""
    expect_stable(assembly(pieces, brep), view, ACCURACY, rng, intersections=False)


@pytest.mark.slow
@few
@given(assemblies(), st.booleans(), views, generators)
def test_turned_solids(pieces, brep, view, rng):
    expect_stable(assembly(pieces, brep), view, ACCURACY, rng, intersections=False)


@pytest.mark.slow
@pytest.mark.parametrize("name", models.SOLIDS)
@pytest.mark.parametrize("view", ["iso", (3, -1, 2)])
def test_a_model(name, view):
    model = models.model(name)
    expect_stable(model, view, models.accuracy(model), np.random.default_rng(1))


@pytest.mark.slow
@few
@given(assemblies(upright), st.booleans(), views, st.tuples(*[st.floats(-1, 1)] * 3))
def test_a_camera_turned_by_a_hair(pieces, brep, view, hair):
    """The view turned by a ten-millionth: no point moves by more than a thousandth of the accuracy."""
    model = assembly(pieces, brep)
    before = draw(model, view, ACCURACY, intersections=False)
    direction = np.array(before.view.direction) + 1e-7 * np.array(hair)
    found = ink.change(before, draw(model, tuple(direction), ACCURACY, up=before.view.up, intersections=False))
    assert found.longest <= ink.LONGEST and found.share <= SHARE, str(found)


def test_parts_that_cross_with_their_intersection_lines():
    crossing = (Piece("box", (0, 0, 0), (4, 4, 4)), Piece("cylinder", (2, 2, 2), (4, 4, 4), (1, 1, 0), 30))
    for brep in (True, False):
        expect_stable(assembly(crossing, brep), "iso", ACCURACY, np.random.default_rng(1))


def rounded_disc():
    import cadquery as cq

    return freeze(cq.Workplane().cylinder(10, 10).edges(">Z").fillet(3), 2000)


@pytest.mark.parametrize("jiggle", [JIGGLE, 1e-6])
def test_the_outline_where_a_rounding_ends_in_a_flat_face_seen_edge_on(jiggle):
    """Its topmost line must stay visible: nothing stands before it."""
    model = rounded_disc()
    expect_stable(model, "front", model.diagonal / 2000, np.random.default_rng(1), jiggle)


def test_a_large_change_is_noticed():
    """The comparison can fail."""
    model = assembly([Piece("box", (0, 0, 0), (4, 3, 2)), Piece("cylinder", (2, 2, 1), (3, 3, 3))])
    rng = np.random.default_rng(1)
    with pytest.raises(AssertionError):
        expect_stable(model, "iso", ACCURACY, rng, jiggle=50.0)
    expect_stable(model, "iso", ACCURACY, rng)
