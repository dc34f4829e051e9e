"""exportDXFProjection: drawings as of CadQuery's example of it, read back by ezdxf."""

from collections import Counter

import ezdxf
import pytest
from ezdxf import bbox, units

from hlr.compat.cadquery import exportDXFProjection, exportSVG
from hlr.errors import HlrError

cq = pytest.importorskip("cadquery")

VIEWS = {"top": ((0, 0, 1), (0, 1, 0)), "front": ((0, 1, 0), (0, 0, 1)), "ortho": ((1, 1, 1), (0, 0, 1))}
BOXES = {"top": (-5, -5, 5, 5), "front": (-5, -5, 5, 5), "ortho": None}


def part():
    """A block of 10 mm with rounded corners and a countersunk hole, about the origin."""
    block = cq.Workplane("XY").box(10, 10, 10).edges("|Z").fillet(2.0)
    return block.faces(">Z").workplane().cskHole(3.0, 6.0, 82.0)


@pytest.fixture(scope="module")
def drawn(tmp_path_factory):
    folder = tmp_path_factory.mktemp("drawn")
    model = part()
    for name, (direction, up) in VIEWS.items():
        exportDXFProjection(model, str(folder / f"{name}.dxf"), direction, up=up, doc_units=units.CM)
    return {name: ezdxf.readfile(folder / f"{name}.dxf") for name in VIEWS}


@pytest.mark.parametrize("name", VIEWS)
def test_the_visible_lines_in_model_units(drawn, name):
    document = drawn[name]
    assert not document.audit().errors and document.units == units.CM
    assert {entity.dxf.layer.partition("_")[0] for entity in document.modelspace()} == {"VISIBLE"}
    if BOXES[name] is not None:
        box = bbox.extents(document.modelspace(), fast=False)
        assert (*box.extmin.vec2, *box.extmax.vec2) == pytest.approx(BOXES[name], abs=1e-3)


def test_round_things_stay_round(drawn):
    top = Counter(entity.dxftype() for entity in drawn["top"].modelspace())
    assert top == {"LINE": 4, "ARC": 4, "CIRCLE": 2}
    assert {round(e.dxf.radius, 6) for e in drawn["top"].modelspace().query("ARC CIRCLE")} == {1.5, 2.0, 3.0}
    ortho = Counter(entity.dxftype() for entity in drawn["ortho"].modelspace())
    assert set(ortho) == {"LINE", "ELLIPSE"} and ortho["ELLIPSE"] >= 6


def test_svg_knows_what_is_up(tmp_path):
    sizes = {}
    flat = cq.Workplane("XY").box(40, 10, 5)
    for up in (None, (0, 1, 0), (1, 0, 0)):
        opts = {"projectionDir": (0, 0, 1), "up": up, "height": None, "marginLeft": 0, "marginTop": 0}
        exportSVG(flat, str(tmp_path / "a.svg"), opts)
        text = (tmp_path / "a.svg").read_text()
        sizes[up] = float(text.partition('height="')[2].partition('"')[0])
    assert sizes[None] == sizes[0, 1, 0] == pytest.approx(200) and sizes[1, 0, 0] == pytest.approx(3200)


@pytest.mark.parametrize(
    "how, words",
    [
        ({"projectionDir": (0, 0, 0)}, "projectionDir"),
        ({"up": "north"}, "up needs three finite numbers"),
        ({"up": (0, 0, 2)}, "`up` is parallel"),
        ({"doc_units": 99}, "doc_units needs a number of DXF"),
        ({"fname": "no/such/folder/a.dxf"}, "does not exist"),
    ],
)
def test_errors(how, words, tmp_path):
    given = {"fname": str(tmp_path / "a.dxf"), "projectionDir": (0, 0, 1), **how}
    with pytest.raises(HlrError, match=words):
        exportDXFProjection(cq.Workplane().box(1, 1, 1), **given)
    assert not list(tmp_path.iterdir())
