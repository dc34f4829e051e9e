"""The scale on a page is known before anything is meshed, so a model is meshed once."""

import cadquery as cq
import numpy as np
import pytest
import trimesh

import hlr
from hlr.drawing.saving import render
from hlr.image.placement import Placement
from hlr.pipeline.session import Session
from hlr.source.cad.brep_source import BrepSource
from hlr.source.mesh.mesh_source import MeshSource


def rods(size):
    rod = cq.Workplane().cylinder(30 * size, 4 * size)
    return cq.Assembly().add(rod).add(rod, loc=cq.Location(cq.Vector(0, 9 * size, 0), cq.Vector(1, 0, 0), 20))


MODELS = {
    "rod": lambda size: cq.Workplane("YZ").cylinder(30 * size, 10 * size),
    "rods": rods,
    "cone": lambda size: cq.Workplane(obj=cq.Solid.makeCone(20 * size, 2 * size, 40 * size)),
    "mesh": lambda size: trimesh.creation.icosphere(3, 10 * size),
}
SIZES = [0.8 * 1.2**k for k in range(10)]


@pytest.fixture
def meshings(monkeypatch):
    """The chord errors that models were meshed with."""
    asked, real = [], Session.scene_at

    def noted(self, deflection, *arguments, **keywords):
        asked.append(deflection)
        return real(self, deflection, *arguments, **keywords)

    monkeypatch.setattr(Session, "scene_at", noted)
    return asked


@pytest.mark.parametrize("name", MODELS)
def test_a_model_is_meshed_once_and_drawn_as_if_its_scale_had_been_found_by_trying(name, meshings, monkeypatch):
    models = [MODELS[name](size) for size in SIZES]
    drawings = [hlr.draw(model, hidden=True) for model in models]
    assert len(meshings) == len(SIZES)
    del meshings[:]
    for kind in (BrepSource, MeshSource):
        monkeypatch.delattr(kind, "reach")
    by_trial = [hlr.draw(model, hidden=True) for model in models]
    assert len(meshings) > len(SIZES)
    assert len({drawing.scale for drawing in drawings}) > 2
    for one, other in zip(drawings, by_trial, strict=True):
        assert render(one, "svg") == render(other, "svg")


@pytest.mark.parametrize(
    "options", [{"scale": "1:2"}, {"perspective": hlr.Perspective()}, {"scale": 1, "accuracy": 0.1}], ids=str
)
def test_a_source_is_not_asked_where_its_answer_would_change_nothing(options, monkeypatch):
    def asked(self, right, up):
        raise AssertionError("the source was asked how far it reaches")

    monkeypatch.setattr(BrepSource, "reach", asked)
    hlr.draw(MODELS["rod"](1.0), **options)
    with pytest.raises(AssertionError):
        hlr.draw(MODELS["rod"](1.0))


def test_a_source_that_tells_nothing_is_placed_by_its_box(monkeypatch):
    model = MODELS["rod"](1.0)
    scale = hlr.draw(model).scale
    monkeypatch.setattr(Placement, "foreseen", lambda self, camera, options, source: self)
    assert hlr.draw(model).scale == scale


def test_a_box_may_be_told_in_whole_numbers(monkeypatch):
    """Sources of others may: `reach` is not theirs, and their box is what NumPy makes of a list."""
    model = trimesh.creation.box((10, 20, 30), transform=trimesh.transformations.translation_matrix((5, 10, 15)))
    usual = render(hlr.draw(model), "svg")
    monkeypatch.delattr(MeshSource, "reach")
    monkeypatch.setattr(MeshSource, "bounds", lambda self: np.array([[0, 0, 0], [10, 20, 30]]))
    assert render(hlr.draw(model), "svg") == usual
