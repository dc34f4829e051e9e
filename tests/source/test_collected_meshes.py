"""Lists and dicts of meshes: each is a part, a dict gives them names, and a pair of arrays is one mesh."""

from __future__ import annotations

import subprocess
import sys

import numpy as np
import pytest

from hlr.errors import SourceError
from hlr.source import open_source

trimesh = pytest.importorskip("trimesh")

VERTICES = [[0, 0, 0], [9, 0, 0], [0, 9, 0], [0, 0, 9]]
FACES = [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]]
PAIR = (np.array(VERTICES, float), np.array(FACES))


def block(x=0.0, name=""):
    made = trimesh.creation.box((10, 10, 10))
    made.apply_translation((x, 0, 0))
    if name:
        made.metadata["name"] = name
    return made


def in_itself(things):
    things.append(things)
    return things


def names(thing):
    return list(open_source(thing).names())


def test_keys_are_the_names_of_the_parts():
    manifold = pytest.importorskip("manifold3d")
    things = {"lid": block(), "pot": manifold.Manifold.cube((1, 2, 3)), 3: PAIR}
    source = open_source(things)
    assert list(source.names()) == ["lid", "pot", "3"]
    assert source.kind == "mesh"
    assert [len(part.triangles) for part in source.mesh(0.1, 0.3).parts] == [12, 12, 4]


def test_meshes_of_a_list_are_counted():
    assert names([block(), block(20)]) == names((block(), block(20))) == ["part", "part:2"]
    assert names({"lid": block(), "pot": block(20)}.values()) == ["part", "part:2"]


def test_names_of_meshes_in_a_list_are_kept_and_give_way_to_keys(tmp_path):
    block().export(tmp_path / "cover.stl")
    assert names([block(name="lid"), trimesh.load(tmp_path / "cover.stl"), block()]) == ["lid", "cover", "part"]
    assert names([block(name="pot.stl")]) == ["pot"]
    assert names({"lid": block(name="own")}) == ["lid"]
    assert names(block(name="lid")) == ["lid"]
    assert names(trimesh.Scene([block(), block(20)]).dump()) == ["part", "part:2"]  # names that trimesh makes up


def test_parts_under_one_key_are_counted():
    assert names({"bolt": [block(), block(20)], "plates": {"upper": block(40), "lower": block(60)}}) == [
        "bolt", "bolt:2", "plates/upper", "plates/lower",
    ]  # fmt: skip


def test_parts_of_a_scene_come_after_its_key():
    scene = trimesh.Scene({"hub": block(), "rim": block(20)})
    assert names({"gear": scene, "base": block(40)}) == ["gear/hub", "gear/rim", "base"]
    assert names({"gear": trimesh.Scene({"hub": block()})}) == ["gear"]
    assert names([scene, block(40)]) == ["hub", "rim", "part"]


@pytest.mark.parametrize("pair", [PAIR, list(PAIR), (VERTICES, FACES), [VERTICES, FACES], (list(PAIR[0]), PAIR[1])])
def test_a_pair_of_arrays_is_one_mesh_and_two_pairs_are_two(pair):
    assert names(pair) == names([pair]) == ["part"]
    assert names([pair, pair]) == names((pair, pair)) == ["part", "part:2"]
    assert names([pair, pair, pair]) == ["part", "part:2", "part:3"]
    assert names({"lid": pair, "more": [pair, pair]}) == ["lid", "more", "more:2"]
    assert names([pair, [pair, pair]]) == ["part", "part:2", "part:3"]


def test_lists_of_lists_of_cad_objects_are_no_arrays():
    cq = pytest.importorskip("cadquery")
    box = cq.Workplane().box(1, 2, 3)
    assert len(names([[[box], [box]], [[box], [box]]])) == 4


def test_colours_are_those_of_each_mesh():
    red, blue = [255, 0, 0, 255], [0, 0, 255, 255]
    lid, pot = block(), block(20)
    lid.visual.face_colors, pot.visual.face_colors = red, blue
    looks = open_source({"lid": lid, "seal": PAIR, "pot": pot}).appearances()
    assert {name: look.whole for name, look in looks.items()} == {
        "lid": (1, 0, 0, 1),
        "seal": None,
        "pot": (0, 0, 1, 1),
    }


def test_each_mesh_has_its_own_corners():
    parts = open_source([block(), block(10)]).mesh(0.1, 0.3).parts
    assert [len(part.points) for part in parts] == [8, 8]


def test_meshes_of_several_units_are_drawn_in_millimetres():
    inch, metre = block(), block()
    inch.units, metre.units = "inch", "meter"
    source = open_source([inch, block(), metre])
    assert source.frame.unit == 1.0
    assert [part.points.max() for part in source.mesh(0.1, 0.3).parts] == pytest.approx([127.0, 5.0, 5000.0])
    assert open_source([inch, inch]).frame.unit == 25.4


def test_a_model_with_y_up_stands_beside_one_with_z_up(tmp_path):
    tall = trimesh.creation.box((0.2, 0.8, 0.4))  # GLB files are in metres, and y is up
    tall.export(tmp_path / "tall.glb")
    standing, given = open_source([trimesh.load(tmp_path / "tall.glb"), PAIR]).mesh(0.1, 0.3).parts
    assert np.ptp(standing.points, axis=0).tolist() == pytest.approx([200, 400, 800])
    assert given.points.max(axis=0).tolist() == [9, 9, 9]


@pytest.mark.parametrize(
    ("thing", "wanted"),
    [
        (lambda: [block(), None], ["Item 2 of the list is None and was left out."]),
        (
            lambda: {"lid": None, "more": {"seal": None, "lid": block()}, "bolts": []},
            [
                'Part "lid" is None and was left out.',
                'Part "more/seal" is None and was left out.',
                'Part "bolts" is empty and was left out.',
            ],
        ),
        (lambda: {"lid": trimesh.Trimesh(), "pot": PAIR}, ['Part "lid" has no triangles and was left out.']),
    ],
)
def test_none_and_what_is_empty_is_left_out_with_a_warning(thing, wanted):
    notes = open_source(thing()).notes
    assert [note.text for note in notes] == wanted
    assert all(note.is_warning for note in notes)


@pytest.mark.parametrize(
    ("thing", "why"),
    [
        (lambda: [trimesh.Trimesh(), trimesh.Trimesh()], "holds no triangles: there is nothing to draw"),
        (lambda: [block(), trimesh.PointCloud(np.eye(3))], "PointCloud holds no triangles"),
        (lambda: {"lid": block(), "width": 3.0}, "float in it is no CAD object and no mesh"),
        (lambda: [block(), "pot.stl"], "str in it is no CAD object and no mesh"),
        (lambda: {"vertices": PAIR[0], "faces": PAIR[1]}, "ndarray in it is no CAD object and no mesh"),
        (lambda: in_itself([block()]), "list in it holds itself"),
        (lambda: [PAIR, (PAIR[0], [[0, 1, 9]])], "name 1 vertices that do not exist"),
    ],
)
def test_what_is_refused_says_why(thing, why):
    with pytest.raises(SourceError, match=why):
        open_source(thing())


def test_meshes_never_load_a_cad_kernel():
    code = (
        "import sys, trimesh; from hlr.source import open_source; box = trimesh.creation.box()\n"
        "open_source({'lid': box, 'pot': [box, (box.vertices, box.faces)]}).mesh(1, 1)\n"
        "print(*sorted({m.split('.')[0] for m in sys.modules} & {'OCP', 'cadquery', 'build123d'}))"
    )
    run = subprocess.run([sys.executable, "-P", "-c", code], capture_output=True, text=True, check=True)
    assert run.stdout.strip() == ""
