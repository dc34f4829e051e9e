"""Random machined parts keep the promise; `parts.py` draws as many as one likes."""

from __future__ import annotations

import numpy as np
import pytest
from fuzz.parts import KINDS, Case, broken, case

import hlr
from support.at_size import AT_SIZE

NUMBERS = range(14)


def test_all_kinds_of_parts_and_views_are_met():
    found = [case(number) for number in range(60)]
    assert sum(found[number] is not None for number in NUMBERS) > 12
    assert {of.kind for of in found if of is not None} == set(KINDS)
    along = [sorted(np.abs(of.direction) > 1e-9) for of in found if of is not None]
    assert [False, False, True] in along and [True, True, True] in along


@pytest.mark.slow
@pytest.mark.parametrize("number", NUMBERS)
def test_the_promise_is_kept(number):
    found = case(number)
    if found is None:
        return  # how many there are at least, the first test says
    # Errors of outlines may be those of the search.
    assert set(broken(found, 0.05)) <= {"outlines"}


def test_a_line_that_is_drawn_wrong_is_found(monkeypatch):
    from dataclasses import replace

    found = case(NUMBERS[0])
    assert found is not None
    draw_views = hlr.draw_views

    def spoiled(*args, **options):
        (drawing,) = draw_views(*args, **options)
        longest = max((x for x in drawing.lines if x.edge is not None), key=lambda x: np.ptp(x.points, axis=0).sum())
        lines = [replace(x, visible=not x.visible) if x is longest else x for x in drawing.lines]
        return [replace(drawing, lines=lines)]

    monkeypatch.setattr(hlr, "draw_views", spoiled)
    assert set(broken(Case(found.kind, found.shape, found.direction), 0.05)) & {"labels", "changes"}


def test_the_view_does_not_depend_on_what_was_drawn_before():
    one, other = case(3), case(3)
    assert one is not None and other is not None and one.direction == other.direction
    drawings = [hlr.draw(of.shape, of.direction, **AT_SIZE) for of in (one, other)]
    assert [x.points.tolist() for x in drawings[0].lines] == [x.points.tolist() for x in drawings[1].lines]
