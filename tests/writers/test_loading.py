"""hlr.load: the exchange format read back is the same drawing, and what is damaged is refused in a sentence."""

import io
import json
import math
from dataclasses import replace

import numpy as np
import pytest
import trimesh

import hlr
from hlr.drawing.curve import Arc, Bezier
from hlr.writers.loading import loads
from support.at_size import ALL_LINES, AT_SIZE
from support.drawings import sample

cq = pytest.importorskip("cadquery")


def part():
    """Arcs, ellipses, Bezier curves, outlines, a hidden bore."""
    body = cq.Workplane().box(30, 20, 10).edges("|Z").fillet(4).faces(">Z").workplane().hole(7)
    pipe = cq.Workplane().cylinder(20, 5).cut(cq.Workplane("XZ").cylinder(30, 3))
    return body.union(pipe.translate((0, 0, 12)))


def inch_mesh():
    mesh = trimesh.creation.cylinder(2, 5, 24)
    mesh.units = "inches"
    return mesh


DRAWINGS = {
    "the sample": sample,
    "a part": lambda: hlr.draw(part(), "iso", smooth=True, seam=True, scale=1.0, hidden=True),
    "a perspective": lambda: hlr.draw(part(), "front", perspective=hlr.Perspective(eye=(90, -80, 70)), **AT_SIZE),
    "a mesh in inches": lambda: hlr.draw(inch_mesh(), (1, 2, 3), scale=0.3, **ALL_LINES),
    "what was reached": lambda: hlr.draw(cq.Workplane().cylinder(9, 5), "iso", report=True, **AT_SIZE),
    "within a time": lambda: hlr.draw(cq.Workplane().cylinder(9, 5), "iso", within=20.0, **AT_SIZE),
    "filled faces": lambda: hlr.draw(trimesh.creation.box((10, 20, 30)), "iso", fill=True, **AT_SIZE),
    "filled curves": lambda: hlr.draw(cq.Workplane().cylinder(9, 5), "iso", fill=True, **AT_SIZE),
    "nothing at all": lambda: hlr.draw(
        trimesh.creation.box((9, 9, 9)), perspective=hlr.Perspective((0, -99, 0), (0, -200, 0), 40), **AT_SIZE
    ),
}


@pytest.mark.slow
@pytest.mark.parametrize("name", DRAWINGS)
def test_a_drawing_comes_back_as_it_was(tmp_path, name):
    drawing = DRAWINGS[name]()
    found = hlr.load(drawing.save(tmp_path / "a.json"))
    assert found == drawing and hash(found) == hash(drawing) and found.lines == drawing.lines
    assert found.timings.keys() == drawing.timings.keys()
    for format in ("svg", "pdf", "json"):
        made = [d.save(tmp_path / f"{i}.{format}").read_bytes() for i, d in enumerate((drawing, found))]
        assert made[0] == made[1]
    kinds = {type(line.curve) for line in drawing.lines}
    assert name != "a part" or {Arc, Bezier} <= kinds


def test_it_takes_paths_and_file_objects(tmp_path):
    drawing = sample()
    path = drawing.save(tmp_path / "a.json")
    with open(path, encoding="utf-8") as text, open(path, "rb") as binary:
        for file in (path, str(path), text, binary, io.BytesIO(path.read_bytes())):
            assert hlr.load(file) == drawing


def test_numbers_that_are_hard_to_write_come_back():
    points = np.array([[0.1 + 0.2, 1e-300], [1 / 3, -0.0], [5e22, np.pi]])
    drawing = replace(sample(), lines=(replace(sample().lines[0], points=points, points3=np.ones((3, 3)) / 7),))
    assert loads(drawing.to_json()) == drawing


def damaged(**changes):
    """The sample's JSON with some fields changed; None takes one out."""
    document = json.loads(sample().to_json())
    for path, value in changes.items():
        *above, name = [int(p) if p.isdigit() else p for p in path.split("__")]
        inside = document
        for step in above:
            inside = inside[step]
        inside[name] = value
        if value is None:
            del inside[name]
    return json.dumps(document)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "the text is no JSON"),
        ("[" * 100_000, "the text is no JSON"),
        (b"\xff\xfe\x00", "the text is no JSON"),
        ("{}", "no drawing of hlr"),
        ("[]", "no drawing of hlr"),
        (damaged(format="other"), "no drawing of hlr"),
        (damaged(version=1), "has version 1 of the format, not 2: draw the model again"),
        (damaged(view=None), "damaged: 'view' is missing"),
        (damaged(view__name=None), "view should be an object with 'name'"),
        (damaged(view__projection="oblique"), "view.projection should be one of orthographic, perspective"),
        (damaged(view__direction=[1, 2]), "view.direction should be a list of 3"),
        (damaged(scale="1:2"), "scale should be a number"),
        (damaged(scale=True), "scale should be a number"),
        (damaged(accuracy__used="fine"), "accuracy.used should be a number"),
        (damaged(scale=0), "scale is 0, not a positive number"),
        (damaged(scale=-1), "scale is -1, not a positive number"),
        (damaged(scale=math.inf), "scale is inf, not a positive number"),
        (damaged(model__unit=math.nan), "model.unit is nan, not a positive number"),
        (damaged(view__direction=[0, 0, 0]), "view.direction is no direction"),
        (damaged(view__up=[0, math.nan, 1]), "view.up is no direction"),
        (damaged(lines__0__points=[[0, math.inf], [1, 1]]), "lines[0]"),
        (damaged(lines=7), "lines should be a list of objects"),
        (damaged(lines=["x"]), "lines should be a list of objects"),
        (damaged(timings="x"), "timings should be an object"),
        (damaged(lines__0__class="axis"), "lines[0].class should be one of sharp,"),
        (damaged(lines__0__visible=1), "lines[0].visible should be true or false"),
        (damaged(lines__0__part=9), "lines[0] is of part 9, and there are 2"),
        (damaged(lines__0__part=-1), "lines[0] is of part -1"),
        (damaged(lines__0__points=[[0, 0]]), "as many points as points3"),
        (damaged(lines__0__points=[[0, 0], [1]]), "lines[0].points should be an array of numbers"),
        (damaged(lines__0__points=[["a", 0], [1, 1]]), "lines[0].points should be an array of numbers"),
        (damaged(lines__0__curve={"type": "bezier", "degree": 3, "points": [[0, 0]]}), "lines[0].curve should be"),
        (damaged(lines__0__curve={"type": "arc", "centre": [0, 0], "axes": [[1, 0]], "angles": [0, 1]}), "two axes"),
        (damaged(parts__0__transform="here"), "parts[0].transform should be an array"),
        (damaged(notes=[7]), "notes should be a list of objects"),
        (damaged(plan=[{"effect": 1}]), "plan[0].effect should be text"),
    ],
)
def test_what_is_damaged_is_refused_in_a_sentence(text, message):
    with pytest.raises(hlr.SourceError) as caught:
        loads(text)
    assert message in str(caught.value) and "\n" not in str(caught.value)


@pytest.mark.parametrize("file", ["missing.json", ".", 7, None])
def test_what_cannot_be_read_is_refused_in_a_sentence(tmp_path, monkeypatch, file):
    monkeypatch.chdir(tmp_path)
    with pytest.raises(hlr.SourceError):
        hlr.load(file)


def test_a_note_of_a_later_program_is_kept():
    found = loads(damaged(notes=[{"code": "of-tomorrow", "text": "it rains"}]))
    assert str(found.notes[0]) == "it rains" and found.notes[0].code == "of-tomorrow"
