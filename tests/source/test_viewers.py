"""Scripts that import a viewer show to hlr, whether the viewer is installed or not; nothing of it is left behind."""

from __future__ import annotations

import sys
from types import ModuleType

import pytest

from hlr.errors import SourceError
from hlr.source import open_source
from hlr.source.cad.viewers import VIEWERS

pytest.importorskip("cadquery")
CQ = "import cadquery as cq\nbox = cq.Workplane().box(1, 2, 3)\nball = cq.Workplane().sphere(1)\n"


@pytest.fixture
def shown(tmp_path):
    """Names, colours and opacities of the parts that a script shows, and the remark on what is drawn."""

    def of(text):
        (tmp_path / "model.py").write_text(CQ + text)
        source = open_source(tmp_path / "model.py")
        looks = source.appearances()
        (note,) = source.notes
        return {name: looks[name].whole for name in source.names()}, note.text

    return of


@pytest.mark.parametrize("viewer", VIEWERS)
def test_what_an_imported_function_shows_is_drawn(shown, viewer):
    if "show" not in VIEWERS[viewer]:
        assert shown(f"from {viewer}.ui import ui, show_object\nshow_object(ball, 'b')\n")[0] == {"b": None}
        return
    assert shown(f"from {viewer} import show\nshow(ball, box, names=['b'])\n")[0] == {"b": None, "model": None}
    assert shown(f"from {viewer} import *\nshow_object(ball, 'b')\n")[0] == {"b": None}


def test_show_replaces_what_was_shown_and_show_object_adds_to_it(shown):
    text = "from ocp_vscode import *\nshow(box)\nshow(ball, names='a')\nshow_object(box, name='b')\n"
    assert shown(text) == ({"a": None, "b": None}, "model.py: all that it shows is drawn, 2 objects.")
    assert list(shown(text + "reset_show()\npush_object(box, 'c')\nshow_objects()\n")[0]) == ["c"]
    assert list(shown(text + "show_object(ball, 'c', None, None, clear=True)\n")[0]) == ["c"]
    # Without an import as well.
    assert list(shown("show(box)\nshow(ball, names=['a'])\n")[0]) == ["a"]


def test_colours_and_opacities(shown):
    looks, _ = shown(
        "from ocp_vscode import show, show_object, ColorMap\n"
        "show(box, ball, box, names=list('abc'), colors=['red', (0, 0, 255)], alphas=[0.5])\n"
        "show_object(ball, 'd', {'color': 'lime', 'alpha': 0.25})\n"
        "show_object(ball, 'e', color='lime')\n"
    )
    assert looks == {"a": (1, 0, 0, 0.5), "b": (0, 0, 1, 1), "c": None, "d": (0, 1, 0, 0.25), "e": (0, 1, 0, 1)}
    # In CQ-editor, which scripts do not import, it is transparency.
    assert shown("show_object(box, 'a', {'color': 'red', 'alpha': 0.25})\n")[0] == {"a": (1, 0, 0, 0.75)}
    assert shown("from ocp_vscode import *\nshow(box, colors=ColorMap.seeded(42))\n")[0] == {"model": None}


def test_all_else_of_a_viewer_does_nothing(shown):
    looks, _ = shown(
        "import ocp_vscode, ocp_vscode.config\n"
        "from ocp_vscode import Camera, set_port, get_defaults, Animation, whatever\n"
        "set_port(3939)\n"
        "with whatever(1) as w: assert not w and list(w) == []\n"
        "ocp_vscode.set_defaults(reset_camera=Camera.KEEP, states={'/a': get_defaults()['x'].y})\n"
        "Animation(box).add_track('/a', 'rz', [0, 1], [0, 90]).animate(1)\n"
        "assert not hasattr(Camera, '__path__')\n"
        "ocp_vscode.show(ball, names=['b'], reset_camera=Camera.RESET)\n"
    )
    assert looks == {"b": None}
    assert list(shown("from ocp_vscode import *\nsave_screenshot('a.png')\nshow(ball, names=['b'])\n")[0]) == ["b"]


def test_show_all_shows_the_variables_with_solids_each_once(shown):
    text = "flat = cq.Workplane().rect(1, 1)\nsame = box\nshow_all({})\n"
    assert shown(text.format("")) == (
        {"box": None, "ball": None},
        "model.py: all that it shows is drawn, 2 objects.",
    )
    assert list(shown("from ocp_vscode import *\nshow(ball)\n" + text.format(""))[0]) == ["box", "ball"]
    assert list(shown(text.format("exclude=['ball']"))[0]) == ["box"]
    assert list(shown(text.format("include=['ball']"))[0]) == ["ball"]
    # What is assigned later is not shown.
    assert list(shown(text.format("") + "more = cq.Workplane().box(9, 9, 9)\n")[0]) == ["box", "ball"]


def test_names_that_cq_editor_has_without_an_import(tmp_path):
    text = "def made():\n    return cq.Workplane().box(1, 1, 1)\nshow_object(made(), 'a', rand_color(0.5))\n"
    (tmp_path / "model.py").write_text(text)
    assert open_source(tmp_path / "model.py").names() == ["a"]
    (tmp_path / "model.py").write_text("show_object(qc)\n")
    with pytest.raises(SourceError, match="name 'qc' is not defined"):
        open_source(tmp_path / "model.py")


def test_names_that_cqgi_has_without_an_import(tmp_path):
    text = "size = 3\ndescribe_parameter(size, 'edge')\nbuild_object(cadquery.Workplane().box(size, 1, 1))\n"
    (tmp_path / "model.py").write_text(text)
    low, high = open_source(tmp_path / "model.py", parameters={"size": 4}).bounds()
    assert round(float(high[0] - low[0]), 3) == 4


def test_cadquery_opens_no_window(shown):
    assert shown("from cadquery.vis import show, style\nshow(style(box, color='red'), width=800)\n")[0] == {
        "model": None
    }
    assert shown("import cadquery.vis\ncq.vis.show(box)\n")[0] == {"model": None}


def test_what_is_no_shape_is_left_out(shown):
    looks, why = shown("from ocp_vscode import show\nshow(box, cq.Plane.XY(), 5, names=['a'])\n")
    assert looks == {"a": None} and "without what is no shape (Plane, int)" in why
    with pytest.raises(SourceError, match=r"model\.py shows something that is no shape: An object of type int cannot"):
        shown("from ocp_vscode import show\nshow(5)\n")


@pytest.mark.parametrize("fails", [False, True])
def test_nothing_is_left_behind_and_a_viewer_that_is_loaded_is_not_touched(shown, monkeypatch, fails):
    import cadquery

    own = ModuleType("ocp_vscode")
    monkeypatch.setitem(sys.modules, "ocp_vscode", own)
    own.show = None
    monkeypatch.delitem(sys.modules, "cadquery.vis", raising=False)
    monkeypatch.delattr(cadquery, "vis", raising=False)
    finders = list(sys.meta_path)
    text = "import ocp_vscode, jupyter_cadquery.viewer, cadquery.vis\nocp_vscode.show(box)\n"
    if fails:
        with pytest.raises(SourceError, match="ZeroDivisionError"):
            shown(text + "1 / 0\n")
    else:
        assert shown(text)[0] == {"model": None}
    assert sys.modules["ocp_vscode"] is own and own.show is None
    assert sys.meta_path == finders
    assert not {"jupyter_cadquery", "jupyter_cadquery.viewer", "cadquery.vis"} & sys.modules.keys()
    assert not hasattr(cadquery, "vis")


def test_options_may_be_a_text_in_json(shown):
    half = """'{"color": "red", "alpha": 0.5}'"""
    red = (1.0, 0.0, 0.0, 0.5)
    for start in ("", "from ocp_vscode import show_object\n"):
        assert shown(start + f"show_object(ball, 'b', options={half})\n")[0] == {"b": red}
    assert shown("show_object(ball, 'b', options='{red')\n")[0] == {"b": None}


def test_the_last_shapes_that_a_cell_of_a_notebook_displays_are_drawn(shown):
    looks, _ = shown("# %%\ndisplay(ball)\n# %%\ndisplay(box, ball)\ndisplay('done')\n")
    assert len(looks) == 2
