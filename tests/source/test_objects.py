"""Objects in memory: CadQuery, build123d, bare shapes, and what is none of these."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from hlr.errors import SourceError
from hlr.source import open_source
from hlr.source.part_meshes import PartLabel, PartMeshes, combine_parts

cq = pytest.importorskip("cadquery")


def centres(thing):
    parts = open_source(thing).mesh(0.1, 0.3).parts
    return {part.name: np.round((part.points.min(axis=0) + part.points.max(axis=0)) / 2, 3).tolist() for part in parts}


def test_shapes_of_all_kinds():
    block = cq.Workplane().box(1, 2, 3)
    for thing in (block, block.val(), block.val().wrapped, [block], (block.val(),), cq.Sketch().rect(1, 2)):
        assert list(centres(thing)) == ["part"]
    assert len(centres([block, block])) == 2
    assert len(centres(block.faces())) == 6


def test_a_cadquery_assembly():
    block = cq.Workplane().box(1, 2, 3)
    inner = cq.Assembly(name="inner", loc=cq.Location((10, 0, 0)), color=cq.Color("red"))
    inner.add(block, name="turned", loc=cq.Location((0, 5, 0), (0, 0, 1), 90)).add(block)
    outer = cq.Assembly(name="outer").add(inner).add(block, name="green", color=cq.Color(0, 1, 0))
    parts = open_source(outer).mesh(0.1, 0.3).parts
    assert {part.name: part.color for part in parts} == {
        "inner/turned": (1, 0, 0), "inner": (1, 0, 0), "green": (0, 1, 0),
    }  # fmt: skip
    assert centres(outer) == {"inner/turned": [10, 5, 0], "inner": [10, 0, 0], "green": [0, 0, 0]}


def test_nested_assemblies_keep_their_path():
    block = cq.Workplane().box(1, 2, 3)
    top = cq.Assembly(name="top")
    for i, name in enumerate(("sub", "sub2")):
        top.add(cq.Assembly(name=name, loc=cq.Location((9 * i, 0, 0))).add(block, name="cube"), name=name)
    top.children[1].add(cq.Assembly(name="deep").add(block, name="cube").add(block), name="deep")
    assert list(centres(top)) == ["sub/cube", "sub2/cube", "sub2/deep/cube", "sub2/deep"]


def test_nested_compounds_of_build123d_keep_their_path():
    bd = pytest.importorskip("build123d")

    def sub(label, x):
        cube = bd.Box(1, 1, 1)
        cube.label = "cube"
        return bd.Pos(x, 0, 0) * bd.Compound(label=label, children=[cube])

    top = bd.Compound(label="top", children=[sub("sub", 0), sub("sub2", 9)])
    assert centres(top) == {"sub/cube": [0, 0, 0], "sub2/cube": [9, 0, 0]}


def test_build123d():
    bd = pytest.importorskip("build123d")
    box = bd.Box(1, 2, 3)
    box.label, box.color = "box", bd.Color("blue")
    group = bd.Pos(0, 0, 7) * bd.Compound(label="group", children=[box, bd.Pos(5, 0, 0) * bd.Cylinder(1, 2)])
    assert centres(group) == {"box": [0, 0, 7], "group": [5, 0, 7]}
    assert open_source(box).mesh(0.1, 0.3).parts[0].color == (0, 0, 1)
    with bd.BuildPart() as builder:
        bd.Box(1, 1, 1)
    assert len(centres(builder)) == len(centres(builder.part)) == 1
    assert len(centres(box.faces())) == 6


def test_empty_shapes_of_build123d_are_nothing_to_draw():
    """Their shape of OpenCASCADE cannot even be asked for."""
    bd = pytest.importorskip("build123d")
    for empty in (bd.Part(), bd.Sketch(), bd.Curve(), bd.Compound(), bd.Solid(), [bd.Part(), bd.Face()]):
        with pytest.raises(SourceError, match="holds no shapes: there is nothing to draw"):
            open_source(empty)
    assert len(centres([bd.Part(), bd.Box(1, 2, 3)])) == 1


@pytest.mark.parametrize("thing", [5, None, [], {}, (1, 2), np.zeros((3, 3)), object(), [cq, cq]])
def test_anything_else_is_one_sentence(thing):
    with pytest.raises(SourceError, match="cannot be drawn"):
        open_source(thing)


def test_nothing_to_draw():
    with pytest.raises(SourceError, match="no shapes"):
        open_source(cq.Workplane())
    with pytest.raises(SourceError, match="no shapes"):
        open_source(cq.Assembly())
    with pytest.raises(SourceError, match="no shapes"):
        open_source(cq.Workplane().box(1, 1, 1).vertices())
    with pytest.raises(SourceError, match="no faces and no edges"):
        open_source(hollow())


def hollow():
    """A solid without faces."""
    from OCP.BRep import BRep_Builder
    from OCP.TopoDS import TopoDS_Solid

    solid = TopoDS_Solid()
    BRep_Builder().MakeSolid(solid)
    return solid


def test_one_bad_part_does_not_stop_the_others():
    source = open_source([cq.Workplane().box(1, 1, 1), hollow()])
    assert len(source.mesh(0.1, 0.3).parts) == 1
    assert any("left out" in note.text for note in source.notes)


def test_a_mesher_that_fails_on_one_part(monkeypatch):
    from hlr.source.cad import tessellator

    class Failing:
        """A mesh of the kernel that has lost its last face."""

        def __init__(self, meshed):
            self.meshed = meshed

        def is_sound(self):
            return False

        def faults(self):
            return [(6, "no reason")]

        def turned(self):
            return []

        def torn(self):
            return []

        def unfinished(self):
            return []

        def fill(self, *given):
            return False

        def off_their_edges(self, most):
            return []

        def parts(self, planar):
            found = self.meshed.parts(planar)
            nameless = [PartLabel("", None, np.eye(4))] * len(found)
            *others, last = PartMeshes(nameless, found, object())
            none = replace(last.surface_parameters, corner=last.surface_parameters.corner[:0])
            without = replace(
                last, triangles=last.triangles[:0], triangle_face=last.triangle_face[:0], surface_parameters=none
            )
            return combine_parts([*others, without]).tables

    mesh = tessellator._kernel.BrepModel.mesh
    monkeypatch.setattr(tessellator._kernel.BrepModel, "mesh", lambda model, *given: Failing(mesh(model, *given)))
    monkeypatch.setattr(tessellator, "rescue", lambda *_: False)
    meshed = open_source([cq.Workplane().box(1, 1, 1), cq.Workplane().sphere(1)]).mesh(0.1, 0.3)
    assert len(meshed.parts) == 1
    assert any('"part:2"' in note.text and "1 of 1 faces could not be meshed" in note.text for note in meshed.notes)
