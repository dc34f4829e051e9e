"""Faults of drawings that FreeCAD 0.20.2 made are found, and the verdicts say that it is wrong; nothing else is."""

from pathlib import Path

import pytest

from hlr.compare import compare

DATA = Path(__file__).parents[1] / "data" / "freecad"

FAULTS = {
    # The circle that bounds the hole of the spring is drawn hidden, all ten turns of it.
    "spring_top.svg": ("spring.step", 300.0, "nothing is in front of it"),
    # Lines run across the front of the coils, and are behind it.
    "spring_right.svg": ("spring.step", 120.0, "a face is in front of it"),
    # An arc of the sphere is visible through the torus.
    "torus_sphere_front.svg": ("torus_sphere.brep", 2.5, "a face is in front of it"),
}


@pytest.mark.slow
def test_a_hidden_line_under_a_seam_that_is_not_compared_is_nobodys_fault():
    """FreeCAD 1.0.0 draws this one right, without seams. hlr draws seams, and no hidden lines under those."""
    found = compare(DATA / "version_1_0/spring_right.svg", DATA / "spring.step", view="right", scale=5.0)
    assert not {"first right", "neither right"} & set(found.verdicts_mm) and found.same_mm > 2_800, found


@pytest.mark.slow
@pytest.mark.parametrize("drawing", FAULTS)
def test_a_known_fault_is_found(drawing):
    model, length, reason = FAULTS[drawing]
    found = compare(DATA / drawing, DATA / model, view=drawing[:-4].rpartition("_")[2])
    assert found.verdicts_mm["second right"] > length
    assert not {"first right", "neither right"} & set(found.verdicts_mm)
    worst = max((each for each in found.differences if each.verdict == "second right"), key=lambda each: each.length_mm)
    assert worst.reason.startswith(reason)
