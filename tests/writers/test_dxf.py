"""DXF, read back by ezdxf."""

import io
import math
import re
import subprocess
import sys
from dataclasses import replace
from functools import partial

import ezdxf
import ezdxf.path
import numpy as np
import pytest

from hlr import WriteError
from hlr.drawing.chords import chords
from hlr.drawing.fill import Fill, Gradient
from hlr.lab.sampling import polyline
from hlr.writers.dxf import dxf
from support.drawings import arc, bezier, drawing, line, part, sample
from support.programs import environment

VERSIONS = ("R2010", "R12")
WAVE = [(0, 0), (1, 3), (3, 3), (4, 0), (5, -3), (7, -3), (8, 1)]
"""Two cubic curves with a bend between them."""

CURVES = [
    line([[0, 0], [40, 30]], edge=1),
    line([[0, 0], [10, 0], [10, 10], [3, 4]], "outline", face=2),
    line([[0, 0], [10, 0], [10, 10], [0, 0]], "outline", face=2),
    line([[0, 0], [10, 10], [20, 20]], "boundary"),
    arc((5, 5), 3, 3, (0.5, 0.5 + math.tau)),
    arc((5, 5), 3, 3, (6, 7.5), turn=0.3),
    arc((5, 5), 3, 3, (2, -1), turn=2.0),
    arc((5, 5), 3, -3, (0.2, 2), turn=0.3),
    arc((5, 5), 7, 2, (0, -math.tau), turn=0.4),
    arc((5, 5), 7, 2, (1, 4), turn=0.4, visible=False),
    arc((5, 5), 7, 2, (4, -1), turn=4.0),
    arc((5, 5), 7, -2, (1, 4), turn=0.4),
    arc((5, 5), 7, 1e-7, (0, 2), turn=0.4),
    bezier(2, [(0, 0), (4, 8), (8, 0)]),
    bezier(2, [(0, 0), (4, 8), (8, 0), (9, 5), (12, 0)], visible=False),
    bezier(3, WAVE),
]
TYPES = "LINE LWPOLYLINE LWPOLYLINE LINE CIRCLE ARC ARC ARC ELLIPSE ELLIPSE ELLIPSE ELLIPSE LINE SPLINE SPLINE SPLINE"


def read(made, version="R2010"):
    """The document, whose audit finds nothing to complain about."""
    data = dxf(replace(made, style=replace(made.style, dxf=version)))
    encoding = "cp1252" if version in ("R12", "R2000", "R2004") else "utf-8"
    document = ezdxf.read(io.TextIOWrapper(io.BytesIO(data), encoding))
    audit = document.audit()
    assert not [*audit.errors, *audit.fixes]
    return document


def told(entity):
    """The extended data of an entity."""
    return dict(
        ezdxf.decode_dxf_unicode(value).split("=", 1) for code, value in entity.get_xdata("HLR") if code == 1000
    )


def points_of(entity, distance=1e-4):
    """(n, 2) points along an entity, with chords that are off it by that distance at most."""
    kind = entity.dxftype()
    if kind == "LINE":
        points = [entity.dxf.start, entity.dxf.end]
    elif kind in ("CIRCLE", "ARC", "ELLIPSE", "SPLINE"):  # a path is only near to them
        points = entity.flattening(distance)
    else:
        points = ezdxf.path.make_path(entity).flattening(distance)
    return np.array([(p.x, p.y) for p in points])


def farthest(points, corners):
    """The largest distance of the points (n, 2) from the polyline through the corners, millimetres."""
    start, way = corners[:-1], np.diff(corners, axis=0)
    off = points[:, None] - start
    share = np.clip((off * way).sum(axis=2) / np.maximum((way**2).sum(axis=1), 1e-30), 0.0, 1.0)
    return np.hypot(*np.moveaxis(off - share[..., None] * way, -1, 0)).min(axis=1).max()


def apart(one, entity):
    """How far a line and its entity are apart, seen from either, millimetres."""
    mine = one.points if one.curve is None else chords(one.curve, 1e-4)
    theirs = points_of(entity)
    return max(farthest(polyline(theirs, 0.1), mine), farthest(polyline(mine, 0.1), theirs))


def test_each_line_is_the_entity_of_its_curve():
    model = read(drawing(CURVES)).modelspace()
    assert [entity.dxftype() for entity in model] == TYPES.split()
    assert max(apart(*pair) for pair in zip(CURVES, model, strict=True)) < 5e-4


def test_r12_has_polylines_within_the_accuracy_for_what_it_does_not_know():
    model = read(drawing(CURVES, accuracy=0.05), "R12").modelspace()
    older = {"LWPOLYLINE": "POLYLINE", "ELLIPSE": "POLYLINE", "SPLINE": "POLYLINE"}
    assert [entity.dxftype() for entity in model] == [older.get(kind, kind) for kind in TYPES.split()]
    off = [apart(*pair) for pair in zip(CURVES, model, strict=True)]
    assert 1e-3 < max(off) < 0.05 * 0.1 + 5e-4


def test_a_closed_polyline_is_closed_and_its_dashes_run_on():
    polylines = read(drawing(CURVES)).modelspace().query("LWPOLYLINE")
    assert [(len(entity), entity.closed, entity.dxf.flags & 128) for entity in polylines] == [
        (4, False, 128),
        (3, True, 128),
    ]


@pytest.mark.parametrize("version", VERSIONS)
def test_a_layer_for_each_class_and_visibility(version):
    document = read(sample(), version)
    made = {layer.dxf.name: (layer.color, layer.dxf.linetype.upper()) for layer in document.layers}
    assert {name: made[name] for name in made if name not in ("0", "Defpoints")} == {
        "VISIBLE_SHARP": (7, "CONTINUOUS"),
        "VISIBLE_SMOOTH": (7, "CONTINUOUS"),
        "VISIBLE_SEAM": (7, "CONTINUOUS"),
        "VISIBLE_BOUNDARY": (7, "CONTINUOUS"),
        "VISIBLE_OUTLINE": (7, "CONTINUOUS"),
        "VISIBLE_INTERSECTION": (7, "CONTINUOUS"),
        "HIDDEN_SHARP": (7, "HIDDEN2"),
        "HIDDEN_SMOOTH": (7, "HIDDEN2"),
        "HIDDEN_OUTLINE": (7, "HIDDEN2"),
    }
    assert [entity.dxf.layer for entity in document.modelspace()] == [
        f"{'VISIBLE' if one.visible else 'HIDDEN'}_{one.kind.upper()}" for one in sample().lines
    ]


def test_a_style_says_layers_colours_and_widths():
    red = {"layers": "part", "visible": {"width": 0.68, "color": "#ff0000"}, "parts": {"M6*": {"color": "#123456"}}}
    document = read(sample().with_style(red))
    layers = {layer.dxf.name: layer for layer in document.layers}
    assert set(layers) == {"0", "Defpoints", "box", "M6 _bolt_ & _nut_ ü_"}
    assert layers["box"].color == 1 and not layers["box"].dxf.hasattr("true_color")
    bolt = layers["M6 _bolt_ & _nut_ ü_"]
    assert bolt.rgb == (0x12, 0x34, 0x56) and layers["box"].dxf.lineweight == 70
    first, hidden = document.modelspace()[:2]
    assert not first.dxf.hasattr("lineweight") and not first.dxf.hasattr("linetype")
    assert (hidden.dxf.color, hidden.dxf.linetype, hidden.dxf.lineweight) == (7, "HIDDEN2", 25)


@pytest.mark.parametrize("version", VERSIONS)
def test_layers_of_parts_of_any_name(version):
    names = ["a/b*c", "a?b|c", "A_B_C", "0", "", " ", "x" * 300, "x" * 299 + "y", "螺丝", "FILL", "a\nb"]
    made = drawing([line([[0, 0], [1, k]], part=k) for k in range(len(names))], parts=[part(name) for name in names])
    document = read(made.with_style({"layers": "part"}), version)
    assert len(document.layers) == len(names) + 2
    found = [entity.dxf.layer for entity in document.modelspace()]
    most = 255 if version == "R2010" else 31
    assert max(map(len, found)) == most and len({name.upper() for name in found}) == len(names)


def test_a_part_of_another_colour_differs_from_its_layer():
    for version, color in (("R2010", 3), ("R12", 3)):
        made = sample().with_style({"parts": {"M6*": {"color": "lime"}}})
        colors = {told(entity)["part"]: entity.dxf.color for entity in read(made, version).modelspace()}
        assert colors == {"0": 256, "1": color}


@pytest.mark.parametrize("version", ["R2000", "R2004", "R2007", "R2013", "R2018"])
def test_every_version_is_written(version):
    document = read(sample().with_style({"lines": {"color": "#123456"}}), version)
    assert document.acad_release == version and len(document.modelspace()) == len(sample().lines)


def test_widths_and_dashes_are_those_of_the_drawing():
    document = read(sample())
    wide = {layer.dxf.name: layer.dxf.lineweight for layer in document.layers}
    assert (wide["VISIBLE_SHARP"], wide["VISIBLE_SMOOTH"], wide["HIDDEN_SHARP"]) == (50, 25, 25)
    assert document.linetypes.get("HIDDEN2").simplified_line_pattern() == (3.0, 0.75)
    assert document.header["$LTSCALE"] == 1.0 and document.header["$LWDISPLAY"] == 1


@pytest.mark.parametrize("version", VERSIONS)
def test_extents_that_begin_at_the_origin(version):
    header = read(drawing([line([[0, 0], [30, 20]])]), version).header
    assert header["$EXTMIN"][:2] == (0, 0) and header["$EXTMAX"][:2] == (30, 20)


@pytest.mark.parametrize("version", VERSIONS)
def test_no_number_of_the_header_ends_in_the_dust_of_a_sum(version):
    written = drawing([line([[-0.1 - 0.2, 1e-15], [1 / 3, 2 / 3]])])
    head = written.with_style({"dxf": version}).to_dxf().decode("latin-1").partition("ENTITIES")[0]
    numbers = [text for text in head.split() if re.fullmatch(r"-?\d+\.\d+(e-?\d+)?", text)]
    assert "0.333333" in numbers and "-0.3" in numbers
    assert [text for text in numbers if "e" in text or text == "-0.0" or len(text.partition(".")[2]) > 12] == []


@pytest.mark.parametrize("version", VERSIONS)
def test_millimetres_extents_and_page(version):
    document = read(drawing([line([[-10, 20], [30, 50]])]), version)
    header = document.header
    assert header["$EXTMIN"][:2] == (-10, 20) and header["$EXTMAX"][:2] == (30, 50)
    assert header["$LIMMIN"][:2] == (-15.5, 14.5) and header["$LIMMAX"][:2] == (35.5, 55.5)
    if version == "R2010":
        assert header["$INSUNITS"] == 4 and header["$MEASUREMENT"] == 1
        paper = document.modelspace().dxf_layout.dxf
        assert (paper.paper_width, paper.paper_height, paper.plot_paper_units) == (51, 41, 1)
        assert header["$PLIMMIN"][:2] == (0, 0) and header["$PLIMMAX"][:2] == (51, 41)
        assert header["$PINSBASE"][:2] == (15.5, -14.5) and header["$PSVPSCALE"] == 1


@pytest.mark.parametrize("version", VERSIONS)
def test_every_entity_knows_its_part_and_its_edge(version):
    made = sample()
    for one, entity in zip(made.lines, read(made, version).modelspace(), strict=True):
        known = told(entity)
        assert (known.pop("class"), known.pop("visible")) == (one.kind, "yes" if one.visible else "no")
        assert known.pop("name") == made.parts[one.part].name.replace("\x07", "\ufffd")
        ties = {"part": one.part, "edge": one.edge, "face": one.face, "other": one.other}
        assert known == {key: str(n) for key, n in ties.items() if n is not None}


@pytest.mark.parametrize("version", VERSIONS)
@pytest.mark.parametrize(
    "name",
    [
        'a/b*c|d?e<f>g:h;i,j=k`l"m\\n',
        "Größe 螺丝",
        "x" * 300,
        "螺" * 300,
        "line\nbreak\r\x00\udc80",
        "^J %%d",
        "",
    ],
)
def test_part_names_of_any_kind(version, name):
    model = read(drawing([line([[0, 0], [1, 1]])], parts=[part(name)]), version).modelspace()
    (entity,) = model
    read_back = told(entity)["name"]
    assert len(f"name={read_back}") <= 255
    if name.isprintable() and len(name) < 250:
        assert read_back == name


@pytest.mark.parametrize("version", VERSIONS)
def test_an_empty_drawing(version):
    assert len(read(drawing([]), version).modelspace()) == 0


def test_a_point_that_is_not_finite_is_refused():
    with pytest.raises(WriteError):
        dxf(drawing([line([[0, 0], [math.nan, 1]])]))
    broken = arc((math.nan, 5), 3, 3, (0, 1))
    with pytest.raises(WriteError):
        dxf(drawing([replace(broken, points=np.array([[0.0, 0.0], [1.0, 1.0]]))]))


def test_filled_faces_are_hatches_under_the_lines():
    square = np.array([[0, 0], [10, 0], [10, 10], [0, 10], [2, 2], [4, 2], [4, 4]], float)
    ints = partial(np.array, dtype=np.int32)
    ramp = Gradient(
        np.zeros(2), np.ones(2), np.array([0.0, 0.5, 1.0]), np.array([[0] * 3, [9] * 3, [99] * 3], np.uint8)
    )
    fill = Fill(
        square, ints([0, 4, 7, 11]), ints([0, 2, 3]), np.array([[255, 0, 10, 128], [1, 2, 3, 255]], np.uint8),
        ints([-1, 0]), (ramp,), ints([0, 0]), 0.1,
    )  # fmt: skip
    fill = replace(fill, points=np.concatenate([square, square[:4] + 20.0]))
    filled = drawing([line([[0, 0], [1, 1]])], fill=fill)
    one, other, entity = read(filled).modelspace()
    assert (one.dxf.layer, one.rgb, len(one.paths), entity.dxftype()) == ("FILL", (255, 0, 10), 2, "LINE")
    assert one.transparency == pytest.approx(0.5, abs=0.01) and other.rgb == (9, 9, 9)
    assert [e.dxftype() for e in read(filled, "R12").modelspace()] == ["LINE"]


BYTES = """
import hashlib, sys
from support.drawings import sample
made = [sample().with_style({"dxf": version}).to_dxf() for version in ("R2010", "R12")]
print([hashlib.sha256(data).hexdigest() for data in made])
"""


@pytest.mark.slow
def test_the_same_bytes_in_every_process():
    found = {
        subprocess.run(
            [sys.executable, "-P", "-c", BYTES], env=environment(PYTHONHASHSEED=seed), capture_output=True, check=True
        ).stdout
        for seed in ("1", "5")
    }
    assert len(found) == 1


def test_the_user_s_own_documents_keep_their_dates():
    dxf(sample())
    assert not ezdxf.options.write_fixed_meta_data_for_testing


def test_handles_are_not_given_twice():
    document = read(sample())
    handles = [entity.dxf.handle for entity in document.entitydb.values()]
    assert len(set(handles)) == len(handles)
    assert int(document.header["$HANDSEED"], 16) > max(int(handle, 16) for handle in handles)
