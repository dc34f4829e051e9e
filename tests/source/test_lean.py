"""3MF and GLB load no more of trimesh than they need, where the process is hlr's own."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

trimesh = pytest.importorskip("trimesh")

GEARS = Path(__file__).parents[1] / "data" / "cube_gears.3mf"
HEAVY = {"scipy", "embreex", "manifold3d", "shapely", "httpx", "jsonschema"}

LOADED = """
import sys, hlr
from hlr.common import process
if sys.argv[2] == "own":
    process.claim()
drawing = hlr.draw(sys.argv[1], accuracy=0.5)
print(*sorted({name.partition(".")[0] for name, module in sys.modules.items() if module is not None}))
print(hash(drawing.to_svg()))
import trimesh, scipy.sparse, networkx
"""


@pytest.fixture
def models(tmp_path):
    box = trimesh.creation.box()
    box.visual = trimesh.visual.ColorVisuals(box, vertex_colors=[[9, 99, 200, 255]] * len(box.vertices))
    scene = trimesh.Scene()
    turn = trimesh.transformations.rotation_matrix(0.3, (0, 0, 1))
    scene.add_geometry(box, node_name="arm", geom_name="box", transform=turn)
    scene.add_geometry(box, node_name="hand", geom_name="box", parent_node_name="arm", transform=turn)
    scene.export(tmp_path / "arm.glb")
    # Lines and points beside a mesh are read by other modules of trimesh.
    scene.add_geometry(trimesh.load_path([[[0.0, 0, 0], [1, 2, 3]], [[1.0, 2, 3], [3, 1, 0]]]), geom_name="line")
    scene.add_geometry(trimesh.PointCloud([[0.0, 0, 0], [4, 2, 3]]), geom_name="points")
    scene.export(tmp_path / "lines.glb")
    return [tmp_path / "arm.glb", tmp_path / "lines.glb", GEARS]


def loaded(path, whose):
    command = [sys.executable, "-P", "-c", LOADED, str(path), whose]
    environment = os.environ | {"PYTHONHASHSEED": "0"}
    done = subprocess.run(command, capture_output=True, text=True, check=True, env=environment)
    modules, drawing = done.stdout.splitlines()
    return set(modules.split()), drawing


@pytest.mark.slow
def test_it_loads_no_more_than_it_needs_and_draws_the_same(models):
    for path in models:
        own, another = loaded(path, "own"), loaded(path, "another's")
        if path.stem != "lines":
            assert not own[0] & HEAVY
            assert ("networkx" in own[0]) == (path.suffix == ".3mf")
        assert own[1] == another[1]


@pytest.mark.slow
@pytest.mark.skipif(not hasattr(os, "fork"), reason="without fork the process is not claimed")
def test_the_command_s_process_is_its_own(models, tmp_path):
    for path in (models[0], GEARS):
        command = [sys.executable, "-P", "-X", "importtime", "-m", "hlr", "draw", str(path), "-q", "-o", "a.svg"]
        done = subprocess.run(command, capture_output=True, text=True, check=True, cwd=tmp_path)
        tried = {line.rpartition("|")[2].strip() for line in done.stderr.splitlines()}
        assert "trimesh.base" in tried
        assert not tried & {"scipy._lib", "embreex.rtcore", "httpx._client", "jsonschema.validators", "shapely.lib"}


@pytest.mark.slow
def test_a_caller_s_trimesh_is_whole(models):
    """Called from another program nothing is hidden, also from what it imports later."""
    code = "import hlr, sys; hlr.draw(sys.argv[1], accuracy=0.5); import trimesh; print(trimesh.graph.coo_matrix)"
    said = subprocess.run(
        [sys.executable, "-P", "-c", code, str(models[0])], capture_output=True, text=True, check=True
    )
    assert said.stdout.startswith("<class 'scipy.sparse")
