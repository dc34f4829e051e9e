"""The drawing as a value: compared, hashed, shown, and written without being changed."""

import copy
import io
import math
import pickle
from dataclasses import FrozenInstanceError, fields, replace

import cadquery as cq
import numpy as np
import pytest
import trimesh

import hlr
from hlr.drawing.curve import Arc, Bezier
from hlr.drawing.drawing import Drawing, DrawnPart
from hlr.drawing.fill import Gradient
from hlr.drawing.notes import Note
from support.at_size import ALL_LINES, AT_SIZE
from support.drawings import drawing, line, sample

POINTS = np.array([[0.0, 0.0], [1.0, 2.0], [3.0, 2.0], [4.0, 0.0]])


MAKERS = [
    lambda: line([[0, 0], [1, 1]]),
    lambda: Arc(np.zeros(2), np.eye(2), np.array([0.0, 1.0])),
    lambda: Bezier(3, POINTS.copy()),
    lambda: replace(line([[0, 0], [1, 1]]), curve=Bezier(3, POINTS.copy())),
    lambda: DrawnPart("a", None, np.eye(4)),
    lambda: Gradient(np.zeros(2), np.ones(2), np.linspace(0, 1, 3), np.zeros((3, 3), np.uint8)),
    lambda: hlr.draw(trimesh.creation.icosphere(2), "iso", scale=9, fill=True, **ALL_LINES).fill,
    sample,
    lambda: hlr.preview(trimesh.creation.box((9, 9, 9)), size=(9, 9), depth=True, ids=True),
]
"""Of everything that holds an array."""


@pytest.mark.slow
@pytest.mark.parametrize("make", MAKERS)
def test_equal_values_are_equal_and_have_one_hash(make):
    one, other = make(), make()
    assert one == other and hash(one) == hash(other) and len({one, other}) == 1
    assert copy.deepcopy(one) == one == pickle.loads(pickle.dumps(one))
    for thing in (None, 0, "text", POINTS, line([[0, 0], [1, 2]])):
        assert (one == thing) is False and (thing == one) is False


@pytest.mark.parametrize("make", MAKERS)
def test_each_array_counts(make):
    one = make()
    for f in fields(one):
        value = getattr(one, f.name)
        if isinstance(value, np.ndarray):
            assert one != replace(one, **{f.name: value + 1}) and one != replace(one, **{f.name: value[:0]})


@pytest.mark.parametrize("make", MAKERS)
def test_what_is_shown_is_short(make):
    assert len(repr(make())) < 200


def test_no_number_and_minus_zero_are_themselves():
    one, other = (line([[0.0, np.nan], [1, sign * 0.0]]) for sign in (1, -1))
    assert one == other and hash(one) == hash(other)


def test_two_runs_make_equal_drawings():
    box = trimesh.creation.box((10, 20, 30))
    one, other = (hlr.draw(box, threads=threads, **AT_SIZE) for threads in (1, 2))
    assert one == other and hash(one) == hash(other) and one != hlr.draw(box, "front", **AT_SIZE)
    assert replace(one, timings={"total": 1.0}) == one != replace(one, notes=(Note("defects", "open"),))
    assert set(one.plan) == set(other.plan)


def test_it_shows_itself_in_one_line():
    drawing = hlr.draw(trimesh.creation.box((10, 20, 30)), "iso", **AT_SIZE)
    assert repr(drawing) == "<Drawing Trimesh, iso, 1:1, 9 visible and 3 hidden lines>"
    assert repr(drawing.lines[0]).startswith("<Line sharp, visible, part 0, 2 points>")


def test_visible_and_hidden_lines_and_bounds():
    drawing = hlr.draw(trimesh.creation.box((10, 20, 30)), "front", **AT_SIZE)
    assert set(drawing.visible) | set(drawing.hidden) == set(drawing.lines)
    assert all(x.visible for x in drawing.visible) and not any(x.visible for x in drawing.hidden)
    assert drawing.bounds == pytest.approx((0, 0, 10, 30)) and drawing.bounds.height == pytest.approx(30)


def test_a_drawing_cannot_be_changed():
    drawing = hlr.draw(trimesh.creation.box((10, 20, 30)), "front", **AT_SIZE)
    with pytest.raises(FrozenInstanceError):
        drawing.scale = 2.0
    with pytest.raises(ValueError, match="read-only"):
        drawing.lines[0].points[0] = 7.0
    with pytest.raises(ValueError, match="read-only"):
        drawing.lines[0].points3[0] = 7.0


@pytest.mark.parametrize("format", ["svg", "pdf", "dxf", "json"])
def test_saving_changes_nothing(tmp_path, format):
    drawing = sample()
    before = pickle.dumps(drawing)
    drawing.save(tmp_path / f"a.{format}")
    assert pickle.dumps(drawing) == before


@pytest.mark.parametrize("format", ["svg", "pdf", "dxf", "json"])
def test_it_is_written_into_a_path_of_any_kind_and_into_file_objects(tmp_path, format):
    drawing, path = sample(), tmp_path / f"a.{format}"
    assert drawing.save(str(path)) == path
    told = getattr(drawing, f"to_{format}")()
    assert path.read_bytes() == (told if isinstance(told, bytes) else told.encode())
    memory = io.BytesIO()
    assert drawing.save(memory, format=format) is None and memory.getvalue() == path.read_bytes()
    with open(tmp_path / "b", "wb") as file:
        drawing.save(file, format)
    assert (tmp_path / "b").read_bytes() == path.read_bytes()
    assert drawing.save(tmp_path / "c", format).read_bytes() == path.read_bytes()


class Short(io.RawIOBase):
    def write(self, data):
        return 1


def closed():
    file = io.BytesIO()
    file.close()
    return file


@pytest.mark.parametrize(
    ("file", "format", "message"),
    [
        (io.BytesIO(), None, "no ending that names the format: give format='svg', 'pdf', 'dxf', 'png' or 'json'"),
        (io.BytesIO(), "dwg", "unknown format 'dwg'; use svg, pdf, dxf, png or json"),
        (io.StringIO(), "svg", "cannot write into the StringIO: it takes text, not bytes; open it with mode 'wb'"),
        (closed(), "svg", "cannot write into the BytesIO: I/O operation on closed file"),
        (Short(), "svg", "it took 1 of"),
        (7, "svg", "cannot write into 7: give a path or a binary file object"),
        (None, None, "cannot write into None: give a path or a binary file object"),
        ("a\0.svg", None, "a file name holds no zero character"),
        ("a.svg", "dwg", "unknown format 'dwg'"),
        ("a.svg", ["svg"], "unknown format"),
    ],
)  # fmt: skip
def test_what_cannot_be_written_is_refused_in_a_sentence(tmp_path, monkeypatch, file, format, message):
    monkeypatch.chdir(tmp_path)
    with pytest.raises(hlr.WriteError) as caught:
        sample().save(file, format)
    assert message.lower() in str(caught.value).lower() and "\n" not in str(caught.value)
    assert not list(tmp_path.iterdir())


def test_a_notebook_shows_the_picture():
    shown = sample()._repr_svg_()
    assert shown.lstrip().startswith("<svg ") and shown.rstrip().endswith("</svg>")


def test_a_picture_shows_itself_and_is_written_into_a_file_object(tmp_path):
    picture = hlr.preview(trimesh.creation.box((9, 9, 9)), size=(9, 9), depth=True)
    memory, depth = io.BytesIO(), io.BytesIO()
    assert picture.save(memory, depth=depth) is None
    path = picture.save(tmp_path / "a.png", depth=tmp_path / "b.png")
    assert memory.getvalue() == picture._repr_png_() == path.read_bytes()
    assert depth.getvalue() == (tmp_path / "b.png").read_bytes()
    for file in (io.StringIO(), closed(), 7, None):
        with pytest.raises(hlr.WriteError):
            picture.save(file)


def test_the_data_of_a_path_comes_first():
    assert 'path d="M' in sample().to_svg() and "<path data" not in sample().to_svg()


def test_drawings_are_the_same_type_only():
    class Other(Drawing):
        pass

    made = drawing([])
    assert made != Other(**{f.name: getattr(made, f.name) for f in fields(made)})


def test_the_length_of_a_line_is_that_of_its_exact_curve():
    bored = cq.Workplane().box(30, 20, 10).faces(">Z").workplane().hole(8)
    lengths = {len(line.points): line.length_mm for line in hlr.draw(bored, "top", scale=2, accuracy=0.5).visible}
    assert lengths.pop(2) in (pytest.approx(40.0), pytest.approx(60.0))
    (circle,) = lengths.values()
    assert circle == pytest.approx(16.0 * math.pi, rel=1e-5)
    # A quarter of a parabola's arc, y = x^2 / 2 from 0 to 1.
    parabola = hlr.Bezier(2, np.array([(0.0, 0.0), (0.5, 0.0), (1.0, 0.5)]))
    assert parabola.length_mm == pytest.approx(0.5 * (math.sqrt(2.0) + math.asinh(1.0)), rel=1e-5)
    assert hlr.Bezier(2, np.array([(0.0, 0.0), (1.0, 0.0), (2.0, 0.0)])).length_mm == pytest.approx(2.0)
