"""Transparency, shadows, occlusion, highlights, colours: each does what it says, and only where asked."""

import cadquery as cq
import numpy as np
import pytest
import trimesh
from shading.shapes import box, joined, linear, sheet

import hlr


def colored(mesh, rgba):
    out = trimesh.Trimesh(*mesh, process=False)
    out.visual.face_colors = np.tile(np.array(rgba, np.uint8), (len(out.faces), 1))
    return out


def wall(depth, half=2.0):
    return sheet([(-half, depth, -half), (half, depth, -half), (half, depth, half), (-half, depth, half)])


def test_layers_of_glass_are_mixed_in_the_order_of_depth():
    def shade(rgba):
        only = hlr.preview(colored(wall(0), rgba), view="front", size=(60, 60), antialias=False)
        return linear(only.pixels[30, 30, :3])

    red, green, blue = (200, 30, 30), (30, 200, 30), (30, 30, 200)
    meshes = [colored(wall(0), (*red, 128)), colored(wall(1), (*green, 64)), colored(wall(2), (*blue, 255))]
    expected = shade((*blue, 255))
    for rgb, alpha in ((green, 64 / 255), (red, 128 / 255)):
        expected = alpha * shade((*rgb, 255)) + (1 - alpha) * expected
    for order in ([0, 1, 2], [2, 1, 0], [1, 2, 0]):
        scene = trimesh.Scene([meshes[i] for i in order])
        for antialias in (False, True):
            picture = hlr.preview(scene, view="front", size=(60, 60), antialias=antialias)
            assert np.abs(linear(picture.pixels[30, 30, :3]) - expected).max() < 0.006


def test_glass_before_nothing_stays_transparent():
    picture = hlr.preview(colored(wall(0), (255, 0, 0, 102)), view="front", size=(60, 60), background="transparent")
    assert picture.pixels[30, 30, 3] == pytest.approx(102, abs=1)
    assert picture.pixels[0, 0].tolist() == [0, 0, 0, 0]


def test_the_back_of_a_transparent_body_is_seen():
    solid = colored(box(), (200, 200, 200, 255))
    glass = colored(box(), (200, 200, 200, 100))
    one, two = (hlr.preview(b, view="front", size=(60, 60), background="transparent") for b in (solid, glass))
    assert one.pixels[30, 30, 3] == 255
    assert two.pixels[30, 30, 3] == pytest.approx(255 * (1 - (155 / 255) ** 2), abs=1)


def test_opacity_comes_from_an_assembly_and_from_step(tmp_path):
    assembly = cq.Assembly()
    assembly.add(cq.Workplane().box(10, 10, 10), name="block", color=cq.Color(0.8, 0.1, 0.1, 1.0))
    assembly.add(cq.Workplane().box(14, 14, 14), name="case", color=cq.Color(0.1, 0.1, 0.8, 0.25))
    path = tmp_path / "case.step"
    assembly.export(str(path))
    for source in (assembly, path):
        picture = hlr.preview(source, view="front", size=(80, 80), background="transparent")
        centre, rim = picture.pixels[40, 40], picture.pixels[40, 9]
        assert centre[3] == 255 and centre[0] > centre[2]
        assert 60 < rim[3] < 255 and rim[2] > rim[0]


def test_faces_have_their_own_colours(tmp_path):
    from OCP.BRepPrimAPI import BRepPrimAPI_MakeBox
    from OCP.Quantity import Quantity_Color, Quantity_TypeOfColor
    from OCP.STEPCAFControl import STEPCAFControl_Writer
    from OCP.TCollection import TCollection_ExtendedString
    from OCP.TDocStd import TDocStd_Document
    from OCP.XCAFApp import XCAFApp_Application
    from OCP.XCAFDoc import XCAFDoc_ColorType, XCAFDoc_DocumentTool

    document = TDocStd_Document(TCollection_ExtendedString("XmlOcaf"))
    XCAFApp_Application.GetApplication_s().InitDocument(document)
    shapes = XCAFDoc_DocumentTool.ShapeTool_s(document.Main())
    colors = XCAFDoc_DocumentTool.ColorTool_s(document.Main())
    block = cq.Shape.cast(BRepPrimAPI_MakeBox(10, 10, 10).Solid())
    label = shapes.AddShape(block.wrapped, False)
    kind = Quantity_TypeOfColor.Quantity_TOC_sRGB
    surface = XCAFDoc_ColorType.XCAFDoc_ColorSurf
    colors.SetColor(label, Quantity_Color(0.2, 0.7, 0.2, kind), surface)
    top = shapes.AddSubShape(label, block.faces(">Z").wrapped)
    colors.SetColor(top, Quantity_Color(0.9, 0.1, 0.1, kind), surface)
    writer = STEPCAFControl_Writer()
    writer.Transfer(document)
    path = tmp_path / "painted.step"
    writer.Write(str(path))
    above = hlr.preview(path, view="top", size=(60, 60)).pixels[30, 30]
    front = hlr.preview(path, view="front", size=(60, 60)).pixels[30, 30]
    assert above[0] > 2 * above[1]
    assert front[1] > 2 * front[0]


def test_vertex_colours_of_a_file_and_repeated_triangles(tmp_path):
    points, faces = wall(0)
    mesh = trimesh.Trimesh(points, np.concatenate([faces, faces[:1]]), process=False)
    mesh.visual.vertex_colors = np.array([(255, 0, 0, 255)] * 4, np.uint8)
    mesh.visual.vertex_colors[2] = (0, 0, 255, 255)
    path = tmp_path / "painted.ply"
    mesh.export(path)
    pixels = hlr.preview(path, view="front", size=(60, 60), antialias=False).pixels
    assert pixels[50, 10, 0] > 150 and pixels[50, 10, 2] < 130
    assert pixels[6, 53, 2] > 150 and pixels[6, 53, 0] < 130


def test_materials_of_a_gltf_file(tmp_path):
    mesh = trimesh.Trimesh(*box(), process=False)
    material = trimesh.visual.material.PBRMaterial(baseColorFactor=(0, 255, 0, 128), alphaMode="BLEND")
    mesh.visual = trimesh.visual.TextureVisuals(material=material)
    path = tmp_path / "green.glb"
    path.write_bytes(trimesh.Scene(mesh).export(file_type="glb"))
    centre = hlr.preview(path, view="front", size=(60, 60), background="transparent").pixels[30, 30]
    assert centre[1] > 2 * centre[0] and 100 < centre[3] < 255


def shaded_share(**options):
    floor = sheet([(-10, -10, 0), (10, -10, 0), (10, 10, 0), (-10, 10, 0)])
    post = (box()[0] * (0.5, 0.5, 3) + (0, 0, 3.2), box()[1])
    picture = hlr.preview(joined(floor, post), view="top", size=(200, 200), antialias=False, ids=True, **options)
    return picture.pixels[:, :, 0].astype(int)


def test_a_post_casts_a_shadow_where_the_light_says():
    plain, shadowed = shaded_share(), shaded_share(shadows=True)
    darker = plain - shadowed
    assert (darker >= -1).all()
    rows, columns = np.nonzero(darker > 20)
    assert 200 < len(rows) < 4000
    # The light comes from the upper left: the shadow lies below to the right of the post.
    assert columns.mean() > 104 and rows.mean() > 108
    assert (darker[:80, :80] == 0).all()


@pytest.mark.slow
def test_glass_casts_the_shadow_that_its_opacity_says():
    def floor_under(*opacities):
        panes = [colored((wall(0)[0][:, [0, 2, 1]] * (1, 1, 0) + (0, 0, 2 + k), wall(0)[1]), (90, 90, 200, o))
                 for k, o in enumerate(opacities)]  # fmt: skip
        ground = sheet([(-20, -20, 0), (20, -20, 0), (20, 20, 0), (-20, 20, 0)])
        scene = trimesh.Scene([colored(ground, (200, 200, 200, 255)), *panes])
        picture = hlr.preview(scene, view="top", size=(400, 400), antialias=False, shadows=True, ids=True)
        bare = picture.pixels[picture.part_ids == 0][:, 0]
        return linear(np.array([bare.max(), bare.min()]))

    lit, dark = floor_under(255)
    assert dark < 0.3 * lit
    # Of the light that is not everywhere a pane lets through what its opacity leaves.
    for opacities in ((64,), (128,), (128, 128)):
        passed = np.prod([1 - o / 255 for o in opacities])
        brightest, darkest = floor_under(*opacities)
        assert brightest == pytest.approx(lit, abs=0.005)
        assert darkest == pytest.approx(dark + passed * (lit - dark), abs=0.02)


def test_without_anything_in_the_way_there_are_no_shadows():
    ball = cq.Workplane().sphere(10)
    plain, shadowed = (hlr.preview(ball, size=(200, 200), shadows=s).pixels.astype(int) for s in (False, True))
    # Where the light grazes the ball, its own shadow begins: both are dark there.
    assert np.abs(plain - shadowed).max() < 24
    assert (np.abs(plain - shadowed).max(axis=2) > 4).mean() < 0.02


def test_occlusion_darkens_corners_only():
    def step(**options):
        corners = [(0, 0), (20, 0), (20, 10), (10, 10), (10, 20), (0, 20)]
        tread = cq.Workplane("XZ").polyline(corners).close().extrude(-30)
        return hlr.preview(tread, view="iso", size=(240, 200), **options).pixels.astype(int)

    darker = (step() - step(occlusion=True))[:, :, 0]
    assert (darker >= 0).all()
    assert darker.max() > 25
    assert (darker > 10).mean() < 0.15


def test_highlights_are_white_and_only_where_asked():
    ball = cq.Workplane().sphere(10)
    plain, shiny = (hlr.preview(ball, size=(200, 200), specular=s).pixels[:, :, :3].astype(int) for s in (False, True))
    more = (shiny - plain).min(axis=2)
    assert (shiny >= plain).all() and more.max() > 20
    assert 0.002 < (more > 5).mean() < 0.15


def test_ties_of_depth_are_told_where_they_can_be_seen():
    plain = hlr.preview(joined(box(), wall(3)), view="front", size=(60, 60))
    (row,) = [d for d in plain.plan if d.name == "ties of depth"]
    assert not row.on and all(note.code != "depth-coarse" for note in plain.notes)
    for perspective in (None, hlr.Perspective(eye=(0, -40, 0), target=(0, 0, 0), fov=20)):
        deep = joined(box(), wall(1e9))
        picture = hlr.preview(deep, view="front", size=(60, 60), perspective=perspective)
        (row,) = [d for d in picture.plan if d.name == "ties of depth"]
        assert row.on and row.reason.startswith("depths are told apart down to ")
        assert [note.code for note in picture.notes if note.code == "depth-coarse"] == ["depth-coarse"]


def test_of_faces_in_one_place_the_first_is_seen():
    red, blue = colored(wall(0), (200, 30, 30, 255)), colored(wall(0), (30, 30, 200, 255))
    for one, other, wins in ((red, blue, 0), (blue, red, 2)):
        picture = hlr.preview(trimesh.Scene([one, other]), view="front", size=(60, 60), antialias=False)
        inner = picture.pixels[10:50, 10:50, :3].reshape(-1, 3)
        assert (inner.argmax(axis=1) == wins).all()
