"""Which parts of a model are drawn, and which shape of a script."""

import json
from importlib.util import find_spec

import pytest
import trimesh

SCRIPT = """
import cadquery as cq
box = cq.Workplane().box(1, 2, 3)
big = cq.Workplane().box(9, 9, 9)
"""


def mesh_scene():
    scene = trimesh.Scene()
    for i, name in enumerate(("bolt", "nut", "plate")):
        box = trimesh.creation.box((4, 4, 4))
        box.apply_translation((10 * i, 0, 0))
        scene.add_geometry(box, geom_name=name, node_name=name)
    return scene


@pytest.mark.slow
def test_on_the_command_line(hlr_real, tmp_path):
    mesh_scene().export(tmp_path / "m.glb")
    assert hlr_real("draw", "m.glb", "-o", "a.json", "--only", "Bolt", "--only", "n*", "--hide", "nut").code == 0
    assert [part["name"] for part in json.loads((tmp_path / "a.json").read_text())["parts"]] == ["bolt"]
    assert hlr_real("preview", "m.glb", "-o", "a.png", "--hide", "nut", "--size", "20x20").code == 0
    assert hlr_real("plan", "m.glb", "--only", "nut").code == 0
    methods = ("methods", "m.glb", "--size", "64x64", "--method", "z-buffer", "-q")
    assert "m.glb: 12\n" in hlr_real(*methods, "--hide", "nut", "--hide", "plate").out
    assert hlr_real("methods", "--only", "nut", "-q").err.endswith("choose parts of a model: name one.\n")
    study = ("study", "m.glb", "-o", "s", "--accuracy", "1", "--no-rivals", "--no-reached", "--runs", "1", "-q")
    assert hlr_real(*study, "--only", "nut").code == 0 and "1 part" in (tmp_path / "s" / "study.md").read_text()
    refused = hlr_real("draw", "m.glb", "--only", "blot")
    assert refused.code == 2 and 'perhaps "bolt"' in refused.err


@pytest.mark.skipif(find_spec("cadquery") is None, reason="the script is one of CadQuery")
def test_the_command_says_which_shape_it_draws(hlr_real, tmp_path):
    path = tmp_path / "model.py"
    path.write_text(SCRIPT)
    done = hlr_real("draw", path, "-o", "a.svg", "--strict")
    assert done.code == 0 and done.err.startswith('hlr: note: model.py: the variable "big" is drawn, the last solid;')
    assert hlr_real("draw", path, "-o", "a.svg", "-q") == (0, "", "")
    assert '"box" is drawn' in hlr_real("draw", path, "-o", "a.svg", "--var", "box", "--scale", "9").err
    assert "1 x 2 x 3 mm" in hlr_real("info", path, "--var", "box").out
