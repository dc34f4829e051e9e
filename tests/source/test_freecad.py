"""FreeCAD documents: what they show, where it lies, and in which colours."""

from __future__ import annotations

import re
import struct

import numpy as np
import pytest

import hlr
from hlr.errors import SourceError
from hlr.source import open_source
from support import freecad_document as fc
from support.freecad_document import flag, item, kept, link, links, number, placement, text, vector, whole, write, xlink

CUBE = {"cube.brp": fc.box(10, 20, 30)}
SHAPE = kept("Part", "cube.brp")


def cube(**values):
    return item("Part::Box", Shape=SHAPE, **values)


def boxes(source):
    """Lower and upper corner of every part, by name."""
    return {
        name: np.round([np.min(corners, 0), np.max(corners, 0)], 6).tolist()
        for name, corners in zip(source.names(), source.boxes(), strict=True)
    }


def opened(path, objects, files=CUBE, *, gui=True, **options):
    return open_source(write(path / "made.FCStd", objects, files, gui=gui), **options)


def texts(source):
    return [str(note) for note in source.notes]


def test_a_shape_lies_where_its_file_says_and_has_its_label(tmp_path):
    files = {"cube.brp": fc.box(10, 20, 30, at=(1, 2, 3))}
    source = opened(tmp_path, {"Box": cube(Label=text("Würfel  <1>"), Placement=placement(1, 2, 3))}, files)
    assert source.kind == "fcstd"
    assert boxes(source) == {"Würfel <1>": [[1, 2, 3], [11, 22, 33]]}


def test_parts_in_parts_are_placed_one_inside_the_other(tmp_path):
    objects = {
        "Box": cube(),
        "Folder": item("App::DocumentObjectGroup", Group=links("Box"), Placement=placement(500)),
        "Inner": item("App::Part", Group=links("Folder"), Placement=placement(100)),
        "Outer": item("App::Part", Group=links("Inner"), Placement=placement(0, 7, 0, turn=90)),
    }
    # Turned by 90 degrees about z, what was along x is along y; the folder moves nothing.
    assert boxes(opened(tmp_path, objects)) == {"Outer/Inner/Folder/Box": [[-20, 107, 0], [0, 117, 30]]}


@pytest.mark.parametrize("transform", [False, True])
def test_a_link_takes_the_place_of_its_target_or_adds_to_it(tmp_path, transform):
    files = {"cube.brp": fc.box(10, 20, 30, at=(1000, 0, 0))}
    objects = {
        "Box": cube(Visibility=flag(False), Placement=placement(1000)),
        "Link": item("App::Link", LinkedObject=xlink("Box"), LinkTransform=flag(transform), Placement=placement(0, 50)),
    }
    shift = 1000 if transform else 0
    assert boxes(opened(tmp_path, objects, files)) == {"Link": [[shift, 50, 0], [shift + 10, 70, 30]]}


@pytest.mark.parametrize(
    ("scale", "size"),
    [
        ({"Scale": number(2.0)}, [20, 40, 60]),
        ({"Scale": number(1.0), "ScaleVector": vector(2, 2, 2)}, [20, 40, 60]),
        ({"ScaleVector": vector(1.5, 1, 0.5)}, [15, 20, 15]),
    ],
)
def test_a_link_scales(tmp_path, scale, size):
    objects = {
        "Box": cube(),
        "Link": item("App::Link", LinkedObject=xlink("Box"), Placement=placement(100), **scale),
    }
    source = opened(tmp_path, objects)
    x, y, z = size
    # OpenCASCADE's boxes of splines are a little too large.
    assert np.allclose(boxes(source)["Link"], [[100, 0, 0], [100 + x, y, z]], atol=1e-5)
    mesh = next(part for part in source.mesh(0.1, 0.5).parts if part.name == "Link")
    assert np.allclose(np.ptp(mesh.points, 0), size)


def test_a_link_scales_what_is_inside_its_target(tmp_path):
    files = {"cube.brp": fc.box(10, 20, 30, at=(5, 0, 0))}
    objects = {
        "Box": cube(),
        "Part": item("App::Part", Group=links("Box"), Placement=placement(300), Visibility=flag(False)),
        "Link": item("App::Link", LinkedObject=xlink("Part"), Scale=number(2.0), Placement=placement(100)),
    }
    assert boxes(opened(tmp_path, objects, files)) == {"Link/Box": [[110, 0, 0], [130, 40, 60]]}


def test_an_array_of_links(tmp_path):
    files = {
        **CUBE,
        "places": fc.placement_list((0, 0, 0), (100, 0, 0), (200, 0, 0)),
        "scales": fc.vector_list((1, 1, 1), (1, 1, 1), (2, 2, 2)),
    }
    objects = {
        "Box": cube(Visibility=flag(False)),
        "Row": item(
            "App::Link",
            LinkedObject=xlink("Box"),
            ElementCount=whole(3),
            PlacementList=kept("PlacementList", "places"),
            ScaleList=kept("VectorList", "scales"),
            VisibilityList='<BoolList value="101"/>',
            Placement=placement(0, 0, 1),
        ),
    }
    source = opened(tmp_path, objects, files)
    assert boxes(source) == {"Row": [[0, 0, 1], [10, 20, 31]], "Row:2": [[200, 0, 1], [220, 40, 61]]}
    assert len(opened(tmp_path, objects, files, hidden_objects=True).names()) == 4


def test_an_array_of_links_shown_as_elements(tmp_path):
    def element(x, visible=True):
        # What is hidden here counts nothing: the array says which elements are shown.
        shown = flag(False)
        return item("App::LinkElement", LinkedObject=xlink("Box"), Placement=placement(x), Visibility=shown)

    objects = {
        "Box": cube(Visibility=flag(False)),
        "Row": item(
            "App::Link",
            LinkedObject=xlink("Box"),
            ElementCount=whole(2),
            ElementList=links("Row_i0", "Row_i1"),
            VisibilityList='<BoolList value="01"/>',
            Placement=placement(0, 0, 1),
        ),
        "Row_i0": element(5),
        "Row_i1": element(50),
    }
    assert boxes(opened(tmp_path, objects)) == {"Row/Row_i0": [[5, 0, 1], [15, 20, 31]]}


def test_a_body_is_its_own_shape_not_its_features(tmp_path):
    files = {"pad.brp": fc.box(1, 1, 1), "cube.brp": fc.box(10, 20, 30, at=(0, 0, 9)), "plane.brp": fc.box(999, 999, 1)}
    objects = {
        "Body": item("PartDesign::Body", Shape=SHAPE, Group=links("Sketch", "Pad", "Datum"), Tip=link("Pad")),
        "Sketch": item("Sketcher::SketchObject", Shape=kept("Part", "pad.brp")),
        "Pad": item("PartDesign::Pad", Shape=kept("Part", "pad.brp")),
        "Datum": item("PartDesign::Plane", Shape=kept("Part", "plane.brp")),
        "Loose": item("PartDesign::Plane", Shape=kept("Part", "plane.brp")),
    }
    source = opened(tmp_path, objects, files, gui=False)
    assert boxes(source) == {"Body": [[0, 0, 9], [10, 20, 39]]}
    assert source.notes == []


def test_hidden_objects_are_left_out_unless_asked_for(tmp_path):
    objects = {
        "Box": cube(view={"Visibility": flag(True)}),
        "Hidden": cube(Visibility=flag(True), view={"Visibility": flag(False)}),
        "Tool": cube(view={"Visibility": flag(False)}),
        "Cut": item("Part::Cut", Shape=SHAPE, Tool=link("Tool"), view={}),
        "Part": item("App::Part", Group=links("Inside"), view={"Visibility": flag(False)}),
        "Inside": cube(),
    }
    source = opened(tmp_path, objects)
    assert source.names() == ["Box", "Cut"]
    note = "2 objects that the document hides left out: --hidden-objects draws them"
    assert [re.sub(r" \(.*", "", each) for each in texts(source)] == [note]
    assert not source.notes[0].is_warning
    # What others are made of is no part of the model, asked or not.
    everything = opened(tmp_path, objects, hidden_objects=True)
    assert everything.names() == ["Box", "Hidden", "Cut", "Part/Inside"]
    with pytest.raises(SourceError, match="hides all its objects"):
        opened(tmp_path, {"Hidden": objects["Hidden"]})


def test_without_the_user_interface_what_others_are_made_of_is_left_out(tmp_path):
    objects = {
        "Tool": cube(),
        "Cut": item("Part::Cut", Shape=SHAPE, Tool=link("Tool")),
        "Off": cube(Visibility=flag(False)),
    }
    assert opened(tmp_path, objects, gui=False).names() == ["Cut"]
    assert opened(tmp_path, objects, gui=False, hidden_objects=True).names() == ["Cut", "Off"]


RED, GLASS = 0xFF000000, 0x0000FF00


def colors(*values):
    return struct.pack(f"<I{len(values)}I", len(values), *values)


def materials(*values):
    found = struct.pack("<I", len(values))
    for packed, transparency in values:
        found += struct.pack("<4I2f", 0, packed, 0, 0, 0.5, transparency)
    return found + bytes(12 * len(values))


@pytest.mark.parametrize(
    ("view", "data"),
    [
        (
            {
                "ShapeColor": whole(RED),
                "Transparency": whole(0),
                "DiffuseColor": kept("ColorList", "colors"),
            },
            colors(*[RED] * 5, GLASS + 51),
        ),
        ({"ShapeAppearance": kept("MaterialList", "colors")}, materials(*[(RED + 255, 0.0)] * 5, (GLASS + 255, 0.2))),
    ],
    ids=["0.20", "1.0"],
)
def test_faces_have_colours_and_transparency(tmp_path, view, data):
    source = opened(tmp_path, {"Box": item("Part::Box", Shape=SHAPE, view=view)}, {**CUBE, "colors": data})
    look = source.appearances()["Box"]
    assert look.whole == (1.0, 0.0, 0.0, 1.0)
    assert look.faces == {**dict.fromkeys(range(5), (1.0, 0.0, 0.0, 1.0)), 5: (0.0, 0.0, 1.0, 0.8)}
    assert source.transparent()


def test_a_link_gives_its_colour_to_all_that_it_shows(tmp_path):
    red = {"ShapeColor": whole(RED), "Transparency": whole(50)}
    material = f'<PropertyMaterial diffuseColor="{GLASS}" transparency="0.25"/>'
    objects = {
        "Box": item("Part::Box", Shape=SHAPE, view=red),
        "Own": item("App::Link", LinkedObject=xlink("Box"), view={"ShapeMaterial": material}),
        "Blue": item(
            "App::Link", LinkedObject=xlink("Own"), view={"ShapeMaterial": material, "OverrideMaterial": flag(True)}
        ),
    }
    looks = opened(tmp_path, objects).appearances()
    assert {name: look.whole for name, look in looks.items()} == {
        "Box": (1.0, 0.0, 0.0, 0.5),
        "Own": (1.0, 0.0, 0.0, 0.5),
        "Blue": (0.0, 0.0, 1.0, 0.75),
    }


def test_instances_share_one_shape(tmp_path):
    objects = {"Box": cube()} | {
        f"Link{i}": item("App::Link", LinkedObject=xlink("Box"), Scale=number(2.0), Placement=placement(40 * i))
        for i in range(1, 5)
    }
    source = opened(tmp_path, objects)
    assert len(source.parts) == 5
    assert len(source.prototypes.counts) == 2


def test_binary_shapes(tmp_path):
    """After the tables FreeCAD writes the numbers of shape, location and orientation."""
    import io

    from OCP.BinTools import BinTools_ShapeSet
    from OCP.BRepPrimAPI import BRepPrimAPI_MakeBox
    from OCP.gp import gp_Trsf, gp_Vec
    from OCP.TopLoc import TopLoc_Location

    move = gp_Trsf()
    move.SetTranslation(gp_Vec(1, 2, 3))
    tables, stream = BinTools_ShapeSet(), io.BytesIO()
    shape = BRepPrimAPI_MakeBox(10, 20, 30).Shape().Located(TopLoc_Location(move))
    number = tables.Add(shape)
    tables.Write(stream)
    data = stream.getvalue()
    root = struct.pack("<3i", number, tables.Locations().Index(shape.Location()), 0)
    objects = {"Box": item("Part::Box", Shape=kept("Part", "cube.bin"))}
    source = opened(tmp_path, objects, {"cube.bin": data + root})
    assert boxes(source) == {"Box": [[1, 2, 3], [11, 22, 33]]}
    with pytest.raises(SourceError, match="cannot be read as BREP"):
        opened(tmp_path, objects, {"cube.bin": data[: len(data) // 2]})


def test_real_documents(data):
    """The figures are FreeCAD's own (0.20.2)."""
    assert np.allclose(open_source(data / "housing_body.FCStd").bounds(), [[-20, -25, 5], [40, 65, 33]], atol=1e-3)
    source = open_source(data / "trolley_assembly.FCStd")
    names = source.names()
    assert len(names) == 18
    assert "Trolley/AxleSet_rear/Wheel_L/Tyre" in names
    assert not [name for name in names if "HiddenCover" in name]
    looks = source.appearances()
    assert looks["Trolley/AxleSet_rear/Wheel_L/Tyre"].whole[:3] == (0.901961, 0.501961, 0.0)
    assert looks["Trolley/Axle set/Wheel/Tyre"].whole[:3] == (0.101961, 0.101961, 0.101961)
    assert looks["Trolley/Chassis/GlassDome"].whole[3] == pytest.approx(0.3)
    assert len({rgba for rgba in looks["Trolley/Chassis/Plate"].faces.values()}) == 3


@pytest.mark.slow
def test_a_drawing_of_a_document(data):
    drawing = hlr.draw(data / "trolley_assembly.FCStd", view="top", only=["Trolley/Chassis"], scale=1.0)
    assert {part.name for part in drawing.parts} == {
        *(f"Trolley/Chassis/{name}" for name in ("Plate", "Pegs", "Pegs:2", "HalfPost", "GlassDome")),
        *(f"Trolley/Chassis/Posts/Posts_i{i}" for i in range(3)),
    }
