"""The shares of the accuracy: their sums, the table that states them, and the kernel's own."""

import re
from pathlib import Path

import pytest

from hlr.request import accuracy

KERNEL = Path(__file__).resolve().parents[2] / "hlr/kernel/accuracy/src/lib.rs"
REPEATED = ("CURVE_FIT", "INTERSECTION_FIT", "ARC_FIT", "CONTOUR_MOVE", "CONTOUR_FIT")
"""Shares of the kernel that the sums in Python need."""


def kernel_shares() -> dict[str, float]:
    return {name: float(value) for name, value in re.findall(r"pub const (\w+): f64 = ([^;]+);", KERNEL.read_text())}


def table() -> dict[str, tuple[list[float], float]]:
    """What the module's own text states: per class of line its shares and their sum."""
    found = {}
    for line in (accuracy.__doc__ or "").splitlines():
        row = re.fullmatch(r" {4}(\S+(?: \S+)*) {2,}(\S+(?: \S+)*) {2,}([\d.]+)", line)
        if row:
            found[row[1]] = [float(share) for share in re.findall(r"\d\.\d+", row[2])], float(row[3])
    return found


@pytest.mark.parametrize("line", accuracy.SHARES)
def test_the_shares_of_a_line_add_up_to_less_than_the_accuracy(line):
    assert sum(accuracy.SHARES[line].values()) <= 1.0


def test_the_table_states_what_the_shares_are():
    assert table() == {
        line: (pytest.approx(list(shares.values())), pytest.approx(sum(shares.values())))
        for line, shares in accuracy.SHARES.items()
    }


def test_the_kernel_has_the_shares_that_the_sums_count():
    kernel = kernel_shares()
    for name in REPEATED:
        assert kernel[name] == getattr(accuracy, name), name
    # What else both name is the same, too.
    assert {name for name in kernel if hasattr(accuracy, name)} == set(REPEATED)


def test_what_the_kernel_takes_beside_the_sums_is_less_than_what_they_count():
    kernel = kernel_shares()
    # A straight line stands for a curve, and cubic curves in PDF for an arc, instead of what SVG draws.
    assert kernel["CURVE_STRAIGHT"] <= accuracy.DIGITS
    assert kernel["ARC_CUBIC"] + accuracy.DIGITS <= kernel["ARC_FIT"]
    # A whole circle is rounded without being measured: its centre, and two radii and a rotation that no one sees.
    assert accuracy.DIGITS + 2.0 * kernel["ARC_ROUND"] <= kernel["ARC_FIT"]
    # Points along a curve are nearer to it than the curve to what is true.
    assert kernel["CONTOUR_CHORD"] <= accuracy.CURVE_CHORD <= accuracy.SAME
    # Where a wall stands flush on a face, its edge is not hidden by that face.
    assert 10.0 * kernel["FLUSH"] == accuracy.CONTACT_PLANAR
    # Outlines are moved off their facets by more than these are off, and searched for as far as they may be moved.
    assert accuracy.OUTLINE_CHORD < accuracy.OUTLINE_SPARE < accuracy.OWN_LIFT < accuracy.OUTLINE_LIFT
    assert accuracy.OUTLINE_LIFT < accuracy.MOST_LIFT
    # An accuracy is ten chord tolerances of an outline; a wrinkle that is left out rises by less than two accuracies.
    assert pytest.approx(10.0) == 1.0 / (accuracy.OUTLINE_CHORD * accuracy.TESSELLATION)
    assert kernel["OUTLINE_WRINKLE"] * accuracy.OUTLINE_CHORD * accuracy.TESSELLATION <= 1.5
