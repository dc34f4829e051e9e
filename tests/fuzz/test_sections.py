"""Intersection lines of random pairs lie where OpenCASCADE's sections do; `sections.py` compares any number."""

from __future__ import annotations

import numpy as np
import pytest
from fuzz.sections import compared, pair

from hlr.scene import build

CONTACT = 2.5
"""Accuracies: less deep than that, surfaces touch."""
NUMBERS = range(24)


def test_pairs_cross_little_and_much():
    found = [of.depth for number in NUMBERS if (of := pair(number)) is not None]
    assert len(found) > 16 and min(found) < 0.1 and max(found) > 1.0


@pytest.mark.slow
@pytest.mark.parametrize("number", NUMBERS)
def test_sections_have_lines_and_lines_sections(number):
    of = pair(number)
    if of is None:
        return  # how many there are at least, the first test says
    told = compared(of, 0.05)
    assert told.wrong < 1.0 and told.off < 0.03
    # The mean depth of a common volume is about half of the greatest.
    assert told.missing < 1.0 or of.depth < 0.75 * CONTACT * 0.05


def test_a_missing_and_a_wrong_line_are_found(monkeypatch):
    of = next(found for number in NUMBERS if (found := pair(number)) is not None and found.depth > 1.0)
    find_clashes = build.find_clashes

    def spoiled(*given):
        from dataclasses import replace

        met = find_clashes(*given)
        return replace(met, points=met.points + [0.0, 0.0, 3.0])

    monkeypatch.setattr(build, "find_clashes", spoiled)
    told = compared(of, 0.05)
    assert told.missing > 1.0 and told.wrong > 1.0 and told.section > told.missing - 1e-9 and np.isfinite(told.wrong)
