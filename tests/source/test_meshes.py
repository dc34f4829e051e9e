"""Mesh files and mesh objects: joined corners, instances, units, and files that lie."""

from __future__ import annotations

import io
import json
import struct
import subprocess
import sys
import zipfile

import numpy as np
import pytest

from hlr.errors import SourceError
from hlr.source import open_source
from hlr.source.mesh.cleaning import clean_mesh

trimesh = pytest.importorskip("trimesh")


@pytest.mark.parametrize("kind", ["stl", "obj", "ply", "off", "3mf", "glb"])
def test_every_format_holds_the_same_ball(kind, tmp_path, gaps, volume):
    ball = trimesh.creation.icosphere(radius=2)
    ball.export(tmp_path / f"Ball.{kind}")
    source = open_source(tmp_path / f"Ball.{kind}")
    assert source.kind == kind
    (part,) = source.mesh(0.1, 0.3).parts
    assert not part.brep
    assert gaps(part) == 0
    assert len(part.points) == len(ball.vertices)
    assert volume(part) == pytest.approx(ball.volume, rel=1e-4)
    assert np.allclose(source.bounds(), [(-2, -2, -2), (2, 2, 2)], atol=1e-5)


def test_units_and_up(tmp_path, data):
    trimesh.creation.box().export(tmp_path / "box.glb")
    frame = open_source(tmp_path / "box.glb").frame
    assert frame.unit == 1000
    assert (np.array(frame.up) @ (0, 1, 0)).tolist() == [0, 0, 1]
    assert np.linalg.det(frame.up) == pytest.approx(1)
    assert open_source(data / "cube_gears.3mf").frame.unit == 1
    inch = THREEMF.replace(b"millimeter", b"inch")
    (tmp_path / "inch.3mf").write_bytes(archive({"3D/3dmodel.model": inch}))
    assert open_source(tmp_path / "inch.3mf").frame.unit == 25.4


def test_instances_of_a_scene(volume):
    scene = trimesh.Scene()
    box = trimesh.creation.box()
    mirror = np.diag([-1.0, 1.0, 1.0, 1.0])
    mirror[0, 3] = 5
    scene.add_geometry(box, node_name="one", geom_name="cube")
    scene.add_geometry(box, node_name="two", geom_name="cube", transform=mirror)
    scene.graph.update(frame_from="world", frame_to="two", matrix=mirror, geometry="cube")
    parts = open_source(scene).mesh(0.1, 0.3).parts
    assert len({part.name for part in parts}) == len(parts) == 2
    assert sorted(part.points[:, 0].mean() for part in parts) == [0, 5]
    assert [volume(part) for part in parts] == pytest.approx([1, 1])


def test_nested_placements_of_a_file(tmp_path):
    scene = trimesh.Scene()
    turn = trimesh.transformations.rotation_matrix(np.pi / 2, (0, 0, 1))
    shift = trimesh.transformations.translation_matrix((3, 0, 0))
    scene.graph.update(frame_from="world", frame_to="arm", matrix=turn)
    scene.add_geometry(trimesh.creation.box(), node_name="hand", parent_node_name="arm", transform=shift)
    scene.export(tmp_path / "robot.glb")
    (part,) = open_source(tmp_path / "robot.glb").mesh(0.1, 0.3).parts
    assert np.allclose(part.points.mean(axis=0), (0, 3, 0), atol=1e-6)
    assert np.allclose(part.transform, turn @ shift, atol=1e-6)


def test_parts_of_a_plate(data):
    source = open_source(data / "cube_gears.3mf")
    assert len(source.mesh(0.1, 0.3).parts) == 17
    assert any("degenerate" in note.text for note in source.notes)


def test_manifold_and_arrays(gaps):
    manifold = pytest.importorskip("manifold3d")
    (part,) = open_source(manifold.Manifold.cube((1, 2, 3))).mesh(0.1, 0.3).parts
    assert gaps(part) == 0
    with pytest.raises(SourceError, match="no triangles"):
        open_source(manifold.Manifold())
    quad = open_source(([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)], [(0, 1, 2, 3)]))
    assert len(quad.mesh(0.1, 0.3).parts[0].triangles) == 2
    for faces in ([(0, 1, 9)], [(0.5, 1, 2)], [(0, 1)]):
        with pytest.raises(SourceError):
            open_source((np.eye(3), faces))
    with pytest.raises(SourceError, match="shape"):
        open_source((np.zeros((3, 2)), [(0, 1, 2)]))


def test_corners_are_joined_by_equality_alone():
    tiny = np.nextafter(1.0, 2.0)
    points = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (-0.0, 0, 0), (tiny, 0, 0), (0, 1, 0), (7, 7, 7), (np.nan, 0, 0)]
    triangles = [(0, 1, 2), (3, 4, 5), (0, 3, 1), (0, 1, 7), (0, 1, 99)]
    mesh = clean_mesh(np.array(points), np.array(triangles))
    assert mesh.points.tolist() == [[0, 0, 0], [1, 0, 0], [0, 1, 0], [tiny, 0, 0]]
    assert mesh.triangles.tolist() == [[0, 1, 2], [0, 3, 2]]
    assert (mesh.degenerate, mesh.not_finite, mesh.out_of_range) == (1, 1, 1)


THREEMF = b"""<?xml version="1.0"?>
<model unit="millimeter" xmlns="http://schemas.microsoft.com/3dmanufacturing/core/2015/02"><resources>
<object id="1" type="model"><mesh><vertices><vertex x="0" y="0" z="0"/><vertex x="1" y="0" z="0"/>
<vertex x="0" y="1" z="0"/></vertices><triangles><triangle v1="0" v2="1" v3="2"/></triangles></mesh></object>
</resources><build><item objectid="1"/></build></model>"""
ENTITY = b'<!DOCTYPE model [<!ENTITY a SYSTEM "file:///etc/passwd">]>'


def archive(files):
    stream = io.BytesIO()
    with zipfile.ZipFile(stream, "w", zipfile.ZIP_DEFLATED) as packed:
        for name, content in files.items():
            packed.writestr(name, content)
    return stream.getvalue()


def glb(tree):
    text = json.dumps(tree | {"asset": {"version": "2.0"}, "scene": 0}).encode()
    text += b" " * (-len(text) % 4)
    return b"glTF" + struct.pack("<III", 2, 20 + len(text), len(text)) + b"JSON" + text


def ply(kind, count, body=b""):
    return (
        b"ply\nformat "
        + kind
        + b" 1.0\nelement vertex "
        + str(count).encode()
        + b"\nproperty float x\nproperty float y\n"
        b"property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n" + body
    )


MESH = {
    "scenes": [{"nodes": [0]}],
    "nodes": [{"mesh": 0}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
}
HUGE = {"accessors": [{"componentType": 5126, "count": 2_000_000_000, "type": "VEC3"}]}
NEIGHBOUR = {
    "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}],
    "bufferViews": [{"buffer": 0, "byteLength": 36}],
    "buffers": [{"uri": "neighbour.bin", "byteLength": 36}],
}


@pytest.mark.parametrize(
    ("name", "content", "sentence"),
    [
        ("page.stl", b"<!DOCTYPE html><html></html>", "a web page"),
        ("words.obj", b"hello world\n" * 9, "not an OBJ file"),
        ("points.obj", b"v 0 0 0\nv 1 0 0\n", "no triangles"),
        ("other.obj", b"v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 9\n", "cannot be read as OBJ"),
        ("huge.stl", bytes(80) + struct.pack("<I", 4_000_000_000) + bytes(100), "cut short.*room for 2"),
        ("cut.stl", b"solid x\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\n", "endsolid is missing"),
        ("empty.stl", bytes(84), "no triangles"),
        ("words.stl", b"solid\nfacet\nouter loop\nvertex a 0 0\nendsolid\n", 'line 4 has "a" for a coordinate'),
        ("corner.obj", b"v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 9\n", "line 4 names vertex 9, and there are 3"),
        ("list.ply", ply(b"ascii", 1, b"0 0 0\n4000000000 0 1\n"), "last row is not whole"),
        ("corners.ply", ply(b"ascii", 3, b"0 0 0\n1 0 0\n0 1 0\n3 0 1 7\n"), "no triangle whose corners all exist"),
        ("none.stl", b"solid x\nendsolid x\n", "no triangles"),
        ("nan.stl", bytes(80) + struct.pack("<I12fH", 1, *[float("nan")] * 12, 0), "coordinates are all numbers"),
        ("huge.ply", ply(b"binary_little_endian", 2_000_000_000, bytes(99)), "announces at least 24000000001 bytes"),
        ("huge_text.ply", ply(b"ascii", 2_000_000_000, b"0 0 0\n"), "cut short"),
        ("huge.off", b"OFF\n2000000000 1 0\n0 0 0\n", "cut short"),
        ("cut.glb", b"glTF" + struct.pack("<III", 2, 5000, 20) + b"JSON{}", "cut short"),
        ("old.glb", b"glTF" + struct.pack("<III", 1, 20, 0) + bytes(9), "version 1"),
        ("huge.glb", glb(MESH | HUGE), "more data than it holds"),
        ("neighbour.glb", glb(MESH | NEIGHBOUR), "broken"),
        (
            "circle.glb",
            glb({"scenes": [{"nodes": [0]}], "nodes": [{"children": [1]}, {"children": [0]}]}),
            "no triangles",
        ),
        ("no.3mf", b"PK\x03\x04 nothing", "archive is broken"),
        ("other.3mf", archive({"a.txt": b"x"}), "without 3D/3dmodel.model"),
        ("entity.3mf", archive({"3D/3dmodel.model": THREEMF.replace(b"<model", ENTITY + b"<model")}), "XML entities"),
        (
            "wide.3mf",
            archive({"3D/3dmodel.model": (ENTITY + THREEMF[22:]).decode().encode("utf-16")}),
            "XML entities",
        ),
        ("bomb.3mf", archive({"3D/3dmodel.model": THREEMF, "x": bytes(100 << 20)}), "ZIP bomb"),
    ],
)
def test_files_that_lie(tmp_path, name, content, sentence):
    (tmp_path / "neighbour.bin").write_bytes(struct.pack("<9f", 0, 0, 0, 1, 0, 0, 0, 1, 0))
    (tmp_path / name).write_bytes(content)
    with pytest.raises(SourceError, match=sentence) as caught:
        open_source(tmp_path / name)
    assert name in str(caught.value)
    assert "\n" not in str(caught.value)


def test_what_is_left_of_a_damaged_mesh_is_drawn(tmp_path):
    (tmp_path / "hole.off").write_bytes(b"OFF\n4 2 0\n0 0 0\n1 0 0\n0 1 0\nnan 0 0\n3 0 1 2\n3 0 1 3\n")
    source = open_source(tmp_path / "hole.off")
    assert len(source.mesh(0.1, 0.3).parts[0].triangles) == 1
    assert list(map(str, source.notes)) == ["1 triangle with coordinates that are no numbers was left out."]


SQUARE = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n"


def parts(path):
    return open_source(path).mesh(0.1, 0.3).parts


def test_objects_of_an_obj_file_are_parts_with_their_names(tmp_path):
    path = tmp_path / "two.obj"
    path.write_text(
        f"{SQUARE}o left side\nf 1 2 3 4\n{SQUARE.replace('v 1', 'v 3')}o right\nusemtl a\nf 5 6 7\nf -4 -2 -1\n"
    )
    left, right = parts(path)
    assert (left.name, right.name) == ("left side", "right")
    assert left.points.tolist() == [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]
    assert right.triangles.tolist() == [[0, 1, 2], [0, 2, 3]]
    path.write_text(f"{SQUARE}f 1 2 3 4\n")
    assert [part.name for part in parts(path)] == ["two"]


def test_groups_that_share_vertices_are_one_surface(tmp_path):
    path = tmp_path / "groups.obj"
    path.write_text(f"{SQUARE}{SQUARE}g a\nf 1 2 3\ng b\nf 5 6 7\n")
    assert [part.name for part in parts(path)] == ["a", "b"]
    path.write_text(f"{SQUARE}g a\nf 1 2 3\ng b\nf 1 3 4\n")
    assert [(part.name, len(part.triangles)) for part in parts(path)] == [("groups", 2)]


@pytest.mark.parametrize("kind", ["obj", "off", "ply"])
def test_a_concave_face_does_not_fold_over_itself(kind, tmp_path):
    corners = [(0, 0), (4, 0), (4, 4), (3, 4), (3, 1), (1, 1), (1, 4), (0, 4)]
    rows = [f"{x} 0 {y}" for x, y in corners]
    path = tmp_path / f"u.{kind}"
    if kind == "obj":
        path.write_text("".join(f"v {row}\n" for row in rows) + "f 1 2 3 4 5 6 7 8\n")
    elif kind == "off":
        path.write_text("OFF\n8 1 0\n" + "\n".join(rows) + "\n8 0 1 2 3 4 5 6 7\n")
    else:
        path.write_bytes(ply(b"ascii", 8, "".join(f"{row}\n" for row in rows).encode() + b"8 0 1 2 3 4 5 6 7\n"))
    (part,) = parts(path)
    a, b, c = (part.points[part.triangles[:, k]] for k in range(3))
    areas = np.cross(b - a, c - a)[:, 1] / -2
    assert (areas > 0).all()
    assert areas.sum() == 10


def test_colours_of_a_ply_file(tmp_path):
    box = trimesh.creation.box()
    colors = np.arange(48, dtype=np.uint8).reshape(12, 4)
    box.visual.face_colors = colors
    box.export(tmp_path / "faces.ply")
    look = open_source(tmp_path / "faces.ply").appearances()["faces"]
    assert np.allclose(look.corners, np.repeat(colors[:, None], 3, axis=1) / 255)
    box.visual = trimesh.visual.ColorVisuals(box, vertex_colors=colors[:8])
    box.export(tmp_path / "vertices.ply")
    look = open_source(tmp_path / "vertices.ply").appearances()["vertices"]
    assert np.allclose(look.corners, colors[box.faces] / 255)


def test_bytes_after_a_binary_stl_are_no_obstacle(tmp_path):
    (tmp_path / "more.stl").write_bytes(trimesh.creation.box().export(file_type="stl") + b"more")
    assert len(parts(tmp_path / "more.stl")[0].triangles) == 12


def test_solids_of_a_text_stl_are_parts(tmp_path):
    solid = trimesh.exchange.stl.export_stl_ascii(trimesh.creation.box())
    named = [solid.replace("solid ", f"solid {name}", 1) for name in ("pin", "pin", "")]
    (tmp_path / "three.stl").write_text("".join(named))
    assert [part.name for part in parts(tmp_path / "three.stl")] == ["pin", "pin:2", "three"]


def test_a_byte_order_mark_is_no_obstacle(tmp_path):
    (tmp_path / "bom.obj").write_bytes(b"\xef\xbb\xbfv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
    assert len(open_source(tmp_path / "bom.obj").mesh(0.1, 0.3).parts) == 1


@pytest.mark.slow
@pytest.mark.parametrize("kind", ["stl", "obj", "3mf"])
def test_a_mesh_never_loads_a_cad_kernel(kind, tmp_path, data):
    path = data / {"stl": "soup.stl", "3mf": "cube_gears.3mf"}.get(kind, "")
    if kind == "obj":
        path = tmp_path / "one.obj"
        path.write_bytes(b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
    code = (
        "import sys; from hlr.source import open_source; open_source(sys.argv[1]).mesh(1, 1)\n"
        "print(*sorted({m.split('.')[0] for m in sys.modules} & {'OCP', 'cadquery', 'build123d'}))"
    )
    run = subprocess.run([sys.executable, "-P", "-c", code, str(path)], capture_output=True, text=True, check=True)
    assert run.stdout.strip() == ""
    assert run.stderr == ""


def test_opening_nothing_loads_nothing():
    code = "import sys, hlr.source; print(*sorted({'numpy.linalg', 'trimesh', 'OCP', 'cadquery'} & set(sys.modules)))"
    run = subprocess.run([sys.executable, "-P", "-c", code], capture_output=True, text=True, check=True)
    assert not {"trimesh", "OCP", "cadquery"} & set(run.stdout.split())


def test_colours_of_needles():
    # A vertex of the lower triangles lies on a side of the upper one; the needle between has its own colour.
    points = np.array([[0, 0, 0], [2, 0, 0], [4, 0, 0], [2, 4, 0], [2, -4, 0], [9, 9, 9]], float)
    triangles = np.array([[5, 5, 0], [0, 1, 2], [0, 2, 3], [1, 0, 4], [2, 1, 4]])
    red, green, blue = (255, 0, 0, 255), (0, 255, 0, 255), (0, 0, 255, 255)
    by_face = trimesh.Trimesh(points, triangles, process=False, face_colors=[blue, green, red, blue, blue])
    by_vertex = trimesh.Trimesh(points, triangles, process=False, vertex_colors=[red, green, blue, red, blue, green])
    faces, corners = (next(iter(open_source(mesh).appearances().values())) for mesh in (by_face, by_vertex))
    assert faces.triangles.tolist() == [[0, 1, 3], [1, 2, 3], [1, 0, 4], [2, 1, 4]]
    assert (faces.corners[:2] == np.array(red) / 255).all() and (faces.corners[2:] == np.array(blue) / 255).all()
    expected = np.array([red, green, blue, red, blue])[faces.triangles] / 255
    assert (corners.corners == expected).all()
