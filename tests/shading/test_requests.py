"""What may be asked, what is refused, and what is loaded for it."""

import subprocess
import sys

import numpy as np
import pytest
from shading.shapes import box

import hlr
from hlr.request.picture_effects import PreviewOptions, decide_effects


@pytest.mark.parametrize("size", [(0, 10), (10, -1), (20000, 10), (16000, 16000), (10.5, 10), "big", (10,), (True, 5)])
def test_sizes_that_cannot_be(size):
    with pytest.raises(hlr.OptionError, match=r"size|pixels"):
        hlr.preview(box(), size=size)


@pytest.mark.parametrize("color", ["blurple", "#12", "", 7, "rgb(0,256,0)", "hsv(0,0%,150%)"])
def test_colours_that_are_none(color):
    with pytest.raises(hlr.OptionError, match="colour"):
        hlr.preview(box(), background=color)


def test_options_that_do_not_exist():
    with pytest.raises(hlr.OptionError, match="shiny"):
        hlr.preview(box(), shiny=True)
    with pytest.raises(hlr.OptionError, match="edges is yes or no"):
        hlr.preview(box(), edges="some")
    with pytest.raises(hlr.ViewError):
        hlr.preview(box(), view="underneath")


def test_one_pixel_is_a_picture_too():
    assert hlr.preview(box(), size=(1, 1)).pixels.shape == (1, 1, 4)


def test_the_model_fits_whatever_the_shape_of_the_picture():
    for size in ((300, 60), (60, 300), (200, 200)):
        seen = hlr.preview(box(), size=size, background="transparent").pixels[:, :, 3] > 0
        rows, columns = np.nonzero(seen)
        margins = (rows.min(), size[1] - 1 - rows.max(), columns.min(), size[0] - 1 - columns.max())
        assert min(margins) in range(1, 11)
        assert abs(margins[0] - margins[1]) <= 1 and abs(margins[2] - margins[3]) <= 1


def test_several_views_are_meshed_once():
    front, top = hlr.preview_views(box(), ["front", "top"], PreviewOptions(size=(50, 40)))
    assert (front.view.name, top.view.name) == ("front", "top")


def test_effects_are_on_only_where_asked_or_needed():
    plain = decide_effects(PreviewOptions(), 1.0)
    assert (plain.lines, plain.shadows, plain.occlusion, plain.specular, plain.glass) == (False, 0, 0.0, 0.0, False)
    assert decide_effects(PreviewOptions(), 0.5).glass
    asked = decide_effects(PreviewOptions(edges=True, shadows=True, occlusion=True, specular=True), 1.0)
    assert asked.lines and asked.shadows and asked.occlusion and asked.specular


COMMAND = "from hlr.cli import main; main()"


def command(*arguments, cwd):
    line = [sys.executable, "-P", "-c", COMMAND, "preview", *arguments]
    return subprocess.run(line, capture_output=True, text=True, cwd=cwd, check=False)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["--size", "0x5"], "not a size in pixels"),
        (["--size", "20000x5"], "cannot be made"),
        (["--size", "many"], "not a size in pixels"),
        (["--background", "blurple"], "no colour"),
        (["-o", "nowhere/a.png"], "does not exist"),
        (["-o", "a.gif"], "ends in .png"),
        (["-o", "a.png", "--depth", "a.png"], "name of its own"),
        (["--depth", "-"], "standard output"),
    ],
)
def test_the_command_refuses_in_one_sentence(tmp_path, arguments, words):
    (tmp_path / "a.off").write_text("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n")
    done = command("a.off", *arguments, cwd=tmp_path)
    assert done.returncode == 2 and done.stdout == ""
    assert words in done.stderr and done.stderr.count("\n") == 1
    assert [path.name for path in tmp_path.iterdir()] == ["a.off"]


@pytest.mark.slow
def test_the_command_writes_all_that_was_asked(tmp_path):
    (tmp_path / "a.off").write_text("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n")
    done = command(
        "a.off", "-o", "{stem}-{view}.png", "--view", "top", "--view", "iso", "--depth", "d-{view}.png",
        "--size", "40x30", "--edges", "--no-antialias", cwd=tmp_path,
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    names = sorted(path.name for path in tmp_path.glob("*.png"))
    assert names == ["a-iso.png", "a-top.png", "d-iso.png", "d-top.png"]


def loaded(code):
    program = f"import atexit, sys; atexit.register(lambda: print(*sys.modules, file=sys.stderr)); {code}"
    done = subprocess.run([sys.executable, "-P", "-c", program], capture_output=True, text=True, check=True)
    return {name.partition(".")[0] for name in done.stderr.split()}


MESH = "[(0.,0.,0.),(1.,0.,0.),(0.,1.,0.)]), np.array([(0,1,2)])"


@pytest.mark.slow
def test_a_drawing_does_not_load_what_pictures_need():
    names = loaded(f"import numpy as np, hlr; hlr.draw((np.array({MESH}), view='top')")
    assert "numpy" in names and not names & {"PIL", "OCP"}


@pytest.mark.slow
def test_a_picture_of_a_mesh_does_not_load_opencascade():
    names = loaded(f"import numpy as np, hlr; hlr.preview((np.array({MESH}), view='top', size=(20, 20))")
    assert "PIL" in names and "OCP" not in names
