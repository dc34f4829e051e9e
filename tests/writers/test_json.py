import json
import re
from dataclasses import replace

import numpy as np
import pytest
from writers import golden

from hlr.errors import WriteError
from hlr.writers.json import document
from support.drawings import ISO, drawing, line, on_page, sample


def read(made):
    def refuse(text):
        raise AssertionError(f"{text} is not JSON")

    return json.loads(document(made), parse_constant=refuse)


def test_golden():
    golden.check("sample.json", document(sample()).decode())
    golden.check("page.json", document(on_page()).decode())


def test_fields_and_their_order():
    made = read(sample())
    assert list(made) == [
        "format", "version", "source", "units", "accuracy", "view", "scale", "origin", "model", "parts", "lines",
        "notes", "plan", "counters", "timings",
    ]  # fmt: skip
    assert (made["format"], made["version"], made["units"]) == ("hlr-drawing", 2, "mm")
    assert made["model"] == {"unit": 1.0, "up_axis": np.eye(3).tolist()}
    assert list(made["view"]) == ["name", "projection", "direction", "right", "up"]
    assert list(made["lines"][0]) == ["class", "visible", "part", "edge", "face", "points", "points3"]
    assert made["parts"][1]["name"] == sample().parts[1].name
    assert made["counters"] == {"segments": 10}


def test_lines_are_those_of_the_drawing_in_their_order():
    asked = sample()
    for entry, found in zip(asked.lines, read(asked)["lines"], strict=True):
        assert (found["class"], found["visible"], found["part"], found["edge"], found["face"]) == (
            entry.kind, entry.visible, entry.part, entry.edge, entry.face
        )  # fmt: skip
        assert np.array_equal(found["points"], entry.points) and np.array_equal(found["points3"], entry.points3)


def test_perspective_says_where_the_eye_is():
    view = replace(ISO, projection="perspective", eye=(1.0, 2.0, 3.0), target=(0.0, 0.0, 0.0), fov=40.0, distance=3.7)
    found = read(drawing([], view=view))["view"]
    assert (found["eye"], found["target"], found["fov"], found["distance"]) == ([1, 2, 3], [0, 0, 0], 40, 3.7)


def test_model_coordinates_keep_enough_digits_whatever_the_unit():
    points = np.array([[0.0, 0.0], [123.456789, 1.0]])
    space = np.array([[0.0, 0.0, 0.0], [0.123456789, 0.001, 0.0]])
    made = drawing([replace(line(points), points3=space)], unit=1000.0)
    assert read(made)["lines"][0]["points3"][1][0] == pytest.approx(0.123456789, abs=1e-7)


def test_zero_has_no_sign():
    made = drawing([line([[-0.0, -1e-9], [1, 1]])], origin=(-0.0, 0.0), view=replace(ISO, up=(-0.0, 0.0, 1.0)))
    assert not re.search(r"-0(\.0*)?[],}\s]", document(made).decode())


def test_only_timings_differ_between_runs():
    one, other = document(sample()), document(replace(sample(), timings={"total": 9.0}))
    assert one != other
    assert one[: one.index(b'"timings"')] == other[: other.index(b'"timings"')]


def test_an_empty_drawing_is_a_valid_file():
    assert read(drawing([]))["lines"] == []


def test_a_point_that_is_not_finite_is_refused():
    with pytest.raises(WriteError, match="not finite"):
        document(drawing([line([[0, 0], [np.nan, 1]])]))
