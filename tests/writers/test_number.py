import math
import re
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from hlr.errors import WriteError
from hlr.writers.number import decimals, grid, number


@pytest.mark.parametrize(
    ("value", "places", "text"),
    [
        (0.5, 3, ".5"),
        (-0.5, 3, "-.5"),
        (12.25, 3, "12.25"),
        (12.0, 3, "12"),
        (10.0, 0, "10"),
        (-0.0001, 3, "0"),
        (0.0, 0, "0"),
        (1000.001, 3, "1000.001"),
        (0.001, 3, ".001"),
        (100.0, 2, "100"),
        (-1234567890123.5, 1, "-1234567890123.5"),
    ],
)
def test_compact(value, places, text):
    assert number(value, places) == text


@given(st.integers(-(2**53), 2**53), st.integers(0, 12))
def test_text_means_the_same_number_with_no_character_too_many(value, places):
    text = number(Fraction(value, 10**places), places)
    sign, whole, fraction = re.fullmatch(r"(-?)(\d*)(?:\.(\d+))?", text).groups("")
    assert int(sign + whole + fraction.ljust(places, "0") or "0") == value
    assert not fraction.endswith("0")
    assert text != "-0"
    assert whole.startswith("0") is (value == 0)


@given(st.floats(1e-9, 1e3), st.floats(0.0, 1e6))
def test_rounding_moves_a_point_by_less_than_a_tenth_of_the_accuracy(accuracy, extent):
    places = decimals(accuracy, extent)
    worst = math.hypot(0.5, 0.5) * 10.0**-places
    lacking = extent * 10.0 ** (places + 1) > 2**53 or places == 12
    assert worst <= accuracy / 10 * (1 + 1e-9) or lacking
    if places:
        assert worst * 10 > accuracy / 10 * (1 - 1e-9)


def test_decimals_of_usual_accuracies():
    assert [decimals(a) for a in (10, 1, 0.1, 0.05, 0.01, 0.001)] == [0, 1, 2, 3, 3, 4]


@pytest.mark.parametrize("accuracy", [0.0, -1.0, math.nan, math.inf])
def test_an_accuracy_that_is_none_is_refused(accuracy):
    with pytest.raises(WriteError, match="accuracy"):
        decimals(accuracy)


@pytest.mark.parametrize("bad", [math.nan, math.inf])
def test_points_that_are_not_finite_are_refused(bad):
    with pytest.raises(WriteError, match="not finite"):
        grid(np.array([[0.0, bad]]), 3)
    with pytest.raises(WriteError, match="not finite"):
        decimals(0.05, bad)
