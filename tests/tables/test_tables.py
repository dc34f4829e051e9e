"""A reader, a writer and a line class that only this file knows, a row each, go through the whole program."""

import io
import json
import re
import subprocess
import sys
import zlib
from dataclasses import fields, replace
from typing import get_args

import numpy as np
import pytest

import hlr
from hlr import Options
from hlr.drawing.saving import Format
from hlr.source.model import Frame, PartInfo, PartMesh, Tessellation
from hlr.tables.entry import Table
from hlr.tables.line_classes import LINE_CLASSES, EdgeClass, Kind, LineClass, by_number, names, optional
from hlr.tables.readers import READERS, Reader
from hlr.tables.writers import WRITERS, Writer
from support.at_size import AT_SIZE
from support.programs import environment

CORNERS = np.array([(x, y, z) for x in (0, 1) for y in (0, 1) for z in (0, 1)], np.float64)
QUADS = ((0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3))
TRIANGLES = np.array([t for a, b, c, d in QUADS for t in ((a, b, c), (a, c, d))], np.int32)
EDGES = [(i, j) for i in range(8) for j in range(i + 1, 8) if (i ^ j) in (1, 2, 4)]
WELDED = EDGES.index((5, 7))
"""An edge of the top: in front in the usual view."""


class Cube:
    """A third party's source: nothing of hlr's but the records that the protocol speaks of."""

    name, kind, notes, frame = "cube.dummy", "dummy", [], Frame()

    def __init__(self, size):
        self.size = size

    def bounds(self):
        return np.array([[0.0, 0.0, 0.0], [self.size] * 3])

    def names(self):
        return ["cube"]

    def infos(self):
        return [PartInfo("cube", faces=6, edges=12, solids=1)]

    def boxes(self):
        return [self.bounds()]

    def of_parts(self, names, choice):
        return self

    def mesh(self, deflection, angle, progress=None):
        classes = np.full(12, EdgeClass.SHARP, np.uint8)
        if "weld" in LINE_CLASSES:
            classes[WELDED] = LINE_CLASSES["weld"].number
        part = PartMesh(
            name="cube",
            color=None,
            transform=np.eye(4),
            points=CORNERS * self.size,
            triangles=TRIANGLES,
            triangle_face=np.repeat(np.arange(6, dtype=np.int32), 2),
            face_planar=np.ones(6, bool),
            edge_nodes=np.array(EDGES, np.int32).ravel(),
            edge_offsets=np.arange(0, 25, 2, dtype=np.int32),
            edge_index=np.arange(12, dtype=np.int32),
            edge_class=classes,
            brep=True,
        )
        return Tessellation([part])

    def transparent(self):
        return False

    def appearances(self):
        return {}


def open_cube(path):
    return Cube(float(path.read_text()))


def as_text(drawing):
    return "".join(f"{line.kind} {line.visible}\n" for line in drawing.lines).encode()


HERE = "tables.test_tables"

READER = Reader("DUMMY", "dummy", f"{HERE}:open_cube", (".dummy",), brep=True, noun="a DUMMY file")
WRITER = Writer("txt", f"{HERE}:as_text")
LINE_CLASS = LineClass(
    number=len(LINE_CLASSES),
    name="weld",
    title="welds",
    rank=4,
    place=6,
    border=True,
    option="smooth",
    by_default=None,
    counter="weld_lines",
)


def rows():
    """The table and the key of each row that this file adds."""
    return ((READERS, "DUMMY", READER), (WRITERS, "txt", WRITER), (LINE_CLASSES, "weld", LINE_CLASS))


@pytest.fixture
def added(monkeypatch, tmp_path):
    """The rows in their tables, and a file to read."""
    for table, key, row in rows():
        monkeypatch.setitem(table, key, row)
    path = tmp_path / "cube.dummy"
    path.write_text("20")
    return path


def command(path, *arguments):
    """`hlr` with the rows in its tables, as a program."""
    code = (
        f"import sys; from {HERE} import rows; [table.update({{key: row}}) for table, key, row in rows()]; "
        "from hlr.cli import main; main()"
    )
    program = [sys.executable, "-P", "-c", code, *arguments]
    return subprocess.run(
        program, capture_output=True, text=True, cwd=path.parent, env=environment(), check=False, timeout=120
    )


def test_what_is_derived_from_a_table_follows_its_rows():
    table = Table([("a", 1), ("b", 2)])
    made = []

    @table.derived
    def total():
        made.append(1)
        return sum(table.values())

    assert (total(), total(), len(made)) == (3, 3, 1)
    table.update({"c": 4})
    assert (total(), len(made)) == (7, 2)
    del table["a"]
    assert (total(), total(), len(made)) == (6, 6, 3)


def test_rows_of_line_classes_say_what_the_types_and_options_say():
    """Static types cannot be made from a table: they are held against it."""
    assert [row.number for row in by_number()] == list(range(len(LINE_CLASSES)))
    assert set(get_args(Kind)) == set(names())
    assert tuple(kind.name.lower() for kind in EdgeClass) == names()
    assert set(get_args(Format)) == set(WRITERS)
    assert len({row.place for row in by_number()}) == len(LINE_CLASSES)
    # An outline that its own body hides ranks one lower.
    assert all(0 <= row.rank < 255 for row in by_number())
    defaults = {field.name: field.default for field in fields(Options)}
    for row in optional():
        assert defaults[row.option] == row.by_default
        assert row.option in hlr.Wishes.__annotations__
        assert row.help


def test_a_reader_is_a_row(added):
    drawing = hlr.draw(added, **AT_SIZE)
    assert (drawing.source, len(drawing.lines)) == ("cube.dummy", 11)
    model = hlr.info(added)
    assert (model.kind, model.parts[0].faces, model.parts[0].edges, model.parts[0].closed) == ("dummy", 6, 12, True)
    assert hlr.preview(added, size=(64, 64)).pixels.min() < 255
    reading = {d.name: d for d in hlr.plan_views(added, ["iso"], hlr.Options(**AT_SIZE))[0].decisions}
    assert reading["B-rep reader"].reason == "the source is a DUMMY file"
    assert reading["B-rep reader"].on and not reading["mesh reader"].on


def test_a_file_of_a_new_reader_is_a_model_that_no_drawing_overwrites(added):
    with pytest.raises(hlr.WriteError, match="it is a model"):
        hlr.draw(added, **AT_SIZE).save(added, "svg")


def test_the_ending_is_named_where_another_cannot_be_read(added):
    other = added.with_suffix(".xyz")
    other.write_text("20")
    with pytest.raises(hlr.SourceError, match=r" \.dummy\."):
        hlr.draw(other, **AT_SIZE)


def test_a_writer_is_a_row(added):
    drawing = hlr.draw(added, **AT_SIZE)
    path = drawing.save(added.with_suffix(".txt"))
    assert path.read_text() == "".join(f"{line.kind} {line.visible}\n" for line in drawing.lines)
    file = io.BytesIO()
    drawing.save(file, "txt")
    assert file.getvalue() == path.read_bytes()
    with pytest.raises(hlr.WriteError, match=r"svg, .*\.json or \.txt"):
        drawing.save(added.with_suffix(".xyz"))


def test_a_line_class_is_a_row(added):
    without, drawing = hlr.draw(added, **AT_SIZE), hlr.draw(added, smooth=True, scale=1.0, hidden=True)
    assert {line.kind for line in without.lines} == {"sharp"}
    assert [line.edge for line in drawing.lines if line.kind == "weld"] == [WELDED]
    assert (without.counters["weld_lines"], drawing.counters["weld_lines"]) == (0, 1)
    (decision,) = (d for d in drawing.plan if d.name == "welds")
    assert (decision.on, decision.reason, dict(decision.counts)) == (True, "asked for", {"weld_lines": 1})
    (planned,) = (d for d in hlr.plan_views(added, ["iso"], hlr.Options(**AT_SIZE))[0].decisions if d.name == "welds")
    assert (planned.on, planned.reason) == (False, "not asked for")


def test_a_line_class_goes_through_every_file(added):
    drawing = hlr.draw(added, smooth=True, scale=1.0, hidden=True)
    loaded = hlr.load(drawing.save(added.with_suffix(".json")))
    assert loaded == drawing
    assert [line["class"] for line in json.loads(drawing.to_json())["lines"]].count("weld") == 1
    heavy = drawing.with_style({"visible": {"weld": {"width": 0.7}}})
    svg = heavy.to_svg()
    weld, sharp = (re.search(rf'<g class="{name}" [^>]*>', svg) for name in ("weld", "sharp"))
    assert 'stroke-width=".7"' in weld[0] and "stroke-width" not in sharp[0]
    assert weld.start() > sharp.start()
    pdf = heavy.to_pdf()
    assert b"(Visible weld)" in pdf
    content = zlib.decompress(pdf.partition(b"stream\n")[2])
    assert b"BDC 0 0 0 RG .7 w " in content


def test_hidden_lines_of_a_class_have_its_width_and_dash(added):
    look = {"hidden": {"weld": {"width": 0.35, "dash": [4, 2]}}}
    drawing = hlr.draw(added, view=(-1, -1, -1), smooth=True, scale=1.0, hidden=True, style=look)
    assert [line.visible for line in drawing.lines if line.kind == "weld"] == [False]
    svg = drawing.to_svg()
    assert 'stroke-width=".35"' in re.search(r'<g class="weld" [^>]*>', svg)[0]
    pattern = svg[svg.index('<g class="weld"') :].partition('stroke-dasharray="')[2].partition('"')[0]
    dash, gap = map(float, pattern.replace(",", " ").split()[:2])
    assert dash + gap == pytest.approx((4.0 + 2.0) * 0.35, rel=0.2)


def test_a_class_that_nobody_has_to_ask_for_is_always_drawn(added, monkeypatch):
    monkeypatch.setitem(LINE_CLASSES, "weld", replace(LINE_CLASS, option=None, by_default=True))
    drawing = hlr.draw(added, **AT_SIZE)
    assert drawing.counters["weld_lines"] == 1
    (decision,) = (d for d in drawing.plan if d.name == "welds")
    assert (decision.on, decision.reason) == (True, "drawn in every drawing")


@pytest.mark.slow
def test_the_command_knows_all_rows(added):
    done = command(added, "draw", "cube.dummy", "-o", "cube.txt", "-o", "cube.json", "--smooth")
    assert (done.returncode, done.stderr) == (0, "")
    assert added.with_suffix(".txt").read_text().count("weld") == 1
    document = json.loads(added.with_suffix(".json").read_text())
    assert document["counters"]["weld_lines"] == 1
    done = command(added, "plan", "cube.dummy", "--smooth")
    assert "the source is a DUMMY file" in done.stdout
    assert [line.split()[:2] for line in done.stdout.splitlines() if line.startswith("welds")] == [["welds", "on"]]
    assert "closed" in command(added, "info", "cube.dummy").stdout


def test_help_texts_name_all_rows(added):
    shown = " ".join(command(added, "--help").stdout.split())
    assert "GLB and DUMMY." in shown
    assert "Draw a model as SVG, PDF, DXF, PNG, JSON or TXT." in shown
    shown = " ".join(command(added, "draw", "--help").stdout.split())
    assert "[svg|pdf|dxf|png|json|txt]" in shown
    assert "Where to write: .svg, .pdf, .dxf, .png, .json or .txt;" in shown
    refused = command(added, "draw", "cube.dummy", "-o", "cube.xyz")
    assert (refused.returncode, "use .svg, .pdf, .dxf, .png, .json or .txt" in refused.stderr) == (2, True)


def test_any_object_that_follows_the_protocol_is_drawn():
    """No row: the kind is unknown, so it counts as a mesh."""
    drawing = hlr.draw(Cube(20.0), smooth=True, scale=1.0, hidden=True)
    assert len(drawing.lines) == 12
    assert hlr.info(Cube(20.0)).parts[0].edges == 12
    assert hlr.preview(Cube(20.0), size=(64, 64)).pixels.min() < 255
    (plan,) = hlr.plan_views(Cube(20.0), ["iso"], hlr.Options(**AT_SIZE))
    assert next(d.reason for d in plan.decisions if d.name == "mesh reader") == "the source is a mesh (dummy)"


def test_what_stands_for_a_source_is_one():
    class Proxy:
        def __getattr__(self, name):
            return getattr(Cube(20.0), name)

    assert len(hlr.draw(Proxy(), **AT_SIZE).lines) == 12


def test_what_is_nearly_a_source_is_told_what_it_lacks():
    class Half:
        name, kind, notes, frame = Cube.name, Cube.kind, [], Cube.frame
        bounds, names, infos, boxes, of_parts, mesh = (
            Cube.bounds, Cube.names, Cube.infos, Cube.boxes, Cube.of_parts, Cube.mesh
        )  # fmt: skip

    with pytest.raises(hlr.SourceError, match=r"type Half .* it lacks transparent and appearances\."):
        hlr.draw(Half(), **AT_SIZE)


def test_an_object_in_memory_is_a_row(monkeypatch):
    reader = Reader("a dummy object", "dummy", f"{HERE}:open_size", fits=f"{HERE}:is_size")
    monkeypatch.setitem(READERS, reader.title, reader)
    assert len(hlr.draw(Size(20.0), **AT_SIZE).lines) == 12
    with pytest.raises(hlr.SourceError, match=r"CAD objects and meshes, a dummy object or the name of a file\."):
        hlr.draw(object(), **AT_SIZE)


class Size(float):
    """What only a reader of this file can open."""


def is_size(thing):
    return type(thing).__name__ == "Size"


def open_size(thing):
    return Cube(float(thing))


def test_a_package_that_a_reader_needs_is_named_where_it_is_missing(added, monkeypatch):
    monkeypatch.setitem(READERS, "DUMMY", replace(READER, entry=f"{HERE}:open_with_library", needs="no_such_library"))
    with pytest.raises(hlr.SourceError, match=r"cube\.dummy cannot be read: .* no_such_library; install it"):
        hlr.draw(added, **AT_SIZE)


def open_with_library(path):
    import no_such_library

    return no_such_library.read(path)


def test_what_a_crash_of_a_reader_means_is_in_its_row(added):
    program = (
        f"import os, signal; from {HERE} import *; "
        "READERS['DUMMY'] = replace(READER, entry=f'{HERE}:crash', crash='{name} broke ({reason}) while {doing}'); "
        "import sys; sys.argv = ['hlr', 'draw', 'cube.dummy', '-o', 'x.svg']; from hlr.cli import main; main()"
    )
    done = subprocess.run(
        [sys.executable, "-P", "-c", program],
        capture_output=True,
        text=True,
        cwd=added.parent,
        env=environment(),
        check=False,
        timeout=120,
    )
    assert (done.returncode, done.stderr) == (2, "hlr: cube.dummy broke (segmentation fault) while read.\n")


def crash(path):
    import os
    import signal

    os.kill(os.getpid(), signal.SIGSEGV)
