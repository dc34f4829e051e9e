"""Several meshes in one drawing: the same lines as of a scene of them, and each part with its own cut face."""

from __future__ import annotations

import pytest

import hlr

trimesh = pytest.importorskip("trimesh")


@pytest.fixture(scope="module")
def pot():
    return trimesh.creation.annulus(r_min=20, r_max=25, height=30)


@pytest.fixture(scope="module")
def lid():
    made = trimesh.creation.cylinder(radius=25, height=4)
    made.apply_translation((0, 0, 17))
    return made


@pytest.mark.parametrize("options", [{}, {"section": True}])
def test_a_dict_of_meshes_is_drawn_as_a_scene_of_them(pot, lid, options):
    parts = {"lid": lid, "pot": pot}
    drawing, scene = hlr.draw(parts, "front", **options), hlr.draw(trimesh.Scene(parts), "front", **options)
    assert [part.name for part in drawing.parts] == ["lid", "pot"]
    assert drawing.lines == scene.lines


def test_each_mesh_has_a_hatch_of_its_own(pot, lid):
    drawing = hlr.draw([pot, lid], "front", section=True)
    assert drawing.section.parts == (0, 1)
    assert {line.part for line in drawing.lines if line.kind == "hatch"} == {0, 1}
    assert not drawing.notes


def test_parts_of_a_dict_are_chosen_by_their_keys(pot, lid):
    things = {"lid": lid, "more": {"pot": pot, "seal": None, "cover": lid}}
    drawing = hlr.draw(things, "front", only=["more"])
    assert [part.name for part in drawing.parts] == ["more/pot", "more/cover"]
    assert [note.code for note in drawing.notes] == ["part-left-out"]


def test_a_list_of_meshes_is_listed_with_its_parts(pot, lid):
    assert [(part.name, part.closed) for part in hlr.info([pot, lid]).parts] == [("part", True), ("part:2", True)]
