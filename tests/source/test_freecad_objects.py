"""Objects of a running FreeCAD: told by the names of their classes, and taken over as BREP text or as a saved copy."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import hlr
from hlr.errors import SourceError
from hlr.source import open_source
from support import freecad_document as fc
from support.freecad_document import item, kept, links, placement, text


def made_class(name, *bases, **members):
    """A class that looks as if a module of FreeCAD's had it."""
    module, _, own = name.rpartition(".")
    return type(own, bases, {"__module__": module, **members})


Shape = made_class(
    "Part.Shape",
    isNull=lambda self: self.data is None,
    exportBrepToString=lambda self: self.data.decode(),
)
Document = made_class("App.Document", Name="Model", Label="The model")
Thing = made_class("App.DocumentObject")
Feature = type("Feature", (Thing,), {"__module__": "builtins"})


def shape(data):
    made = Shape()
    made.data = data
    return made


@pytest.fixture
def document():
    objects = {
        "Box": item("Part::Box", Shape=kept("Part", "a.brp"), Label=text("A box")),
        "Part": item("App::Part", Group=links("Box"), Placement=placement(100)),
        "Other": item("Part::Box", Shape=kept("Part", "a.brp"), view={"Visibility": fc.flag(False)}),
    }
    made = Document()
    made.saveCopy = lambda path: fc.write(Path(path), objects, {"a.brp": fc.box(1, 2, 3)})
    return made


def thing(document, name, label):
    made = Feature()
    made.Document, made.Name, made.Label = document, name, label
    return made


def test_a_shape():
    drawing = hlr.draw(shape(fc.box(10, 20, 30, at=(1, 0, 0))), view="top", scale=1.0)
    assert drawing.source == "part"
    assert len(drawing.visible) == 4


def test_a_null_shape():
    with pytest.raises(SourceError, match="holds no shapes"):
        open_source(shape(None))
    with pytest.raises(SourceError, match="The shape is not a BREP file"):
        open_source(shape(b"nonsense"))


def test_an_object_lies_where_it_lies_in_its_document(document):
    source = open_source(thing(document, "Box", "A box"))
    assert (source.name, source.names()) == ("A box", ["A box"])
    assert np.allclose(source.bounds(), [[100, 0, 0], [101, 2, 3]], atol=1e-5)


def test_an_object_that_is_named_is_drawn_though_it_is_hidden(document):
    assert open_source(thing(document, "Other", "Other")).names() == ["Other"]
    assert open_source(document).names() == ["Part/A box"]


def test_a_list(document):
    source = open_source([thing(document, "Box", "A box"), shape(fc.box(5, 5, 5)), thing(document, "Other", "")])
    assert source.names() == ["part", "A box", "Other"]


def test_other_objects_with_such_names_are_no_objects_of_freecad():
    other = made_class("Parts.Shape")
    with pytest.raises(SourceError, match="cannot be drawn"):
        open_source(other())
