"""Depth and identity of pixels, as arrays and as files."""

import io
import json

import cadquery as cq
import numpy as np
import pytest
from PIL import Image
from shading.shapes import box

import hlr
from hlr.writers import png


@pytest.fixture(scope="module")
def picture():
    assembly = cq.Assembly()
    assembly.add(cq.Workplane().box(10, 10, 10), name="büchse", color=cq.Color("red"))
    assembly.add(cq.Workplane().sphere(3).translate((0, 0, 12)), name="ball")
    return hlr.preview(assembly, view="front", size=(160, 120), depth=True, ids=True)


def decoded(data):
    return Image.open(io.BytesIO(data))


def test_depth_is_exact_at_the_centres_of_pixels(picture):
    y, x = np.mgrid[0:120, 0:160] + 0.5
    x = (x - 80) / picture.scale
    ball = picture.part_ids == 1
    z = -(y - 60) / picture.scale + (15 + -5) / 2 - 12  # up from the ball's centre
    r2 = x**2 + z**2
    inner = ball & (r2 < 8)
    assert inner.sum() > 100
    assert np.abs(picture.depth + np.sqrt(np.where(inner, 9 - r2, 0)))[inner].max() < 0.05
    block = picture.part_ids == 0
    assert np.abs(picture.depth[block] + 5).max() < 1e-4
    assert np.isinf(picture.depth[picture.part_ids < 0]).all()


def test_ids_name_part_and_face(picture):
    assert [part.name for part in picture.parts] == ["büchse", "ball"]
    assert set(np.unique(picture.part_ids)) == {-1, 0, 1}
    assert picture.first_face.tolist() == [0, 6, 7]
    assert set(np.unique(picture.ids)) - {-1} <= set(range(7))


def test_the_depth_map_keeps_sixteen_bits(picture):
    image = decoded(png.depth_png(picture))
    assert image.mode == "I;16" and image.size == (160, 120)
    levels = np.asarray(image).astype(float)
    near, far = (float(image.text[key].removesuffix(" mm")) for key in ("Depth-Near", "Depth-Far"))
    seen = levels < png.NOTHING
    assert (seen == np.isfinite(picture.depth)).all()
    back = near + levels / png.FARTHEST * (far - near)
    assert np.abs(back - picture.depth)[seen].max() <= (far - near) / png.FARTHEST


def test_the_map_of_faces_is_lossless(picture):
    image = decoded(png.ids_png(picture))
    r, g, b = np.moveaxis(np.asarray(image).astype(int), 2, 0)
    assert (r * 65536 + g * 256 + b - 1 == picture.ids).all()
    assert json.loads(image.text["Faces"]) == [["büchse", 0], ["ball", 6]]


def test_what_a_picture_shows_is_kept_in_it(picture):
    data = png.picture_png(picture)
    image = decoded(data)
    text = image.text
    assert text["View"] == "front" and text["Projection"] == "orthographic"
    assert text["Software"] == f"hlr {hlr.__version__}"
    assert float(text["Scale"].split()[0]) == pytest.approx(picture.scale)
    assert b"tIME" not in data and b"/" not in data[:200]
    assert np.array_equal(np.asarray(image), picture.pixels[:, :, :3])


def test_files_state_four_pixels_a_millimetre(picture):
    for data in (png.picture_png(picture), png.depth_png(picture), png.ids_png(picture)):
        assert decoded(data).info["dpi"] == pytest.approx((101.6, 101.6))


@pytest.mark.slow
def test_the_same_bytes_every_time_and_with_any_number_of_threads(tmp_path):
    part = cq.Workplane().box(10, 10, 10).edges().fillet(2).faces(">Z").workplane().hole(3)
    options = dict(size=(200, 150), edges=True, shadows=True, occlusion=True, specular=True, depth=True, ids=True)
    made = []
    for n, threads in enumerate((1, 2, 3, 0, 1)):
        shown = hlr.preview(part, threads=threads, **options)
        names = [tmp_path / f"{n}{what}.png" for what in "pdi"]
        shown.save(names[0], depth=names[1], ids=names[2])
        made.append([name.read_bytes() for name in names])
    assert all(files == made[0] for files in made)


def test_saving_needs_maps_that_were_asked_for(tmp_path):
    shown = hlr.preview(box(), size=(40, 30))
    with pytest.raises(hlr.WriteError, match="depth=True"):
        shown.save(tmp_path / "a.png", depth=tmp_path / "b.png")
    with pytest.raises(hlr.WriteError, match="PNG"):
        shown.save(tmp_path / "a.jpg")
    with pytest.raises(hlr.WriteError, match="name each"):
        shown.save(tmp_path / "a.png", depth=tmp_path / "a.png")
    assert list(tmp_path.iterdir()) == []
