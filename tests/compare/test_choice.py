"""What is chosen of a model that is compared: parts, a variable of a script, its parameters; as of `hlr.draw`."""

from pathlib import Path

import pytest
import trimesh

import hlr
from hlr.compare import compare
from hlr.compare.reading.choice import Choice
from hlr.errors import OptionError

SCRIPT = """
import cadquery as cq
size = 10
plate = cq.Workplane().box(30, 20, size)
bolt = cq.Workplane().cylinder(24, 4)
result = plate
"""


def scene():
    made = trimesh.Scene()
    for n, name in enumerate(("bolt", "nut", "plate")):
        made.add_geometry(trimesh.creation.box((4 + n, 4, 4)), geom_name=name, node_name=name)
        made.graph.update(name, matrix=trimesh.transformations.translation_matrix((10 * n, 0, 0)))
    return made


@pytest.mark.parametrize("chosen", [{"only": ["nut", "plate"]}, {"hide": ["bolt"]}, {"only": ("nut",), "hide": ()}])
def test_parts(chosen):
    drawn = hlr.draw(scene(), view="front", scale=1, **chosen)
    assert compare(drawn, scene(), view="front", **chosen).same
    assert compare(scene(), drawn, view="front", **chosen).same
    assert not compare(drawn, scene(), view="front").same
    assert compare(scene(), scene(), view="front", **chosen).same_mm < compare(scene(), scene(), view="front").same_mm


@pytest.mark.parametrize(
    "chosen", [{"only": ["screw"]}, {"hide": ["*"]}, {"only": "bolt"}, {"var": "a"}, {"parameters": {"a": 1}}]
)
def test_what_draw_refuses_is_refused_in_the_same_words(chosen):
    drawn = hlr.draw(scene(), view="front", scale=1)
    with pytest.raises(OptionError) as as_draw:
        hlr.draw(scene(), view="front", **chosen)
    with pytest.raises(OptionError) as here:
        compare(drawn, scene(), view="front", **chosen)
    assert str(here.value) == str(as_draw.value)


def test_two_drawings_leave_no_choice():
    drawn = hlr.draw(scene(), view="front", scale=1)
    with pytest.raises(OptionError, match=r"^`only` is for a model, and both sides are drawings: leave it out, or"):
        compare(drawn, drawn, only=["nut"])
    with pytest.raises(OptionError, match=r"^`hide` and `var` are for a model, .*: leave them out"):
        compare(drawn, drawn, hide=["nut"], var="a")
    with pytest.raises(OptionError, match=r"^compare\(\) has no option 'onyl': did you mean only\?"):
        compare(drawn, drawn, onyl=["nut"])


def test_a_page_leaves_no_choice():
    document = Path(__file__).parents[1] / "data" / "housing_body.FCStd"
    with pytest.raises(OptionError, match="a page of a document is drawn as it is: leave out `only`"):
        compare(document, document, page="Page", only=["a"])


def test_of_two_models_a_script_alone_takes_what_is_for_scripts():
    asked = Choice(only=("a",), var="b", parameters={"c": 1})
    assert asked.of("part.step", "part.py") == Choice(only=("a",))
    assert asked.of("part.py", "part.step") == asked.of("part.py", "other.py") == asked.of(object(), object()) == asked


@pytest.mark.slow
def test_scripts(tmp_path):
    pytest.importorskip("cadquery")
    script = tmp_path / "part.py"
    script.write_text(SCRIPT)
    for chosen in ({"parameters": {"size": 14}}, {"var": "bolt"}):
        drawn = hlr.draw(script, view="front", scale=1, **chosen)
        assert compare(drawn, script, view="front", **chosen).same
        assert not compare(drawn, script, view="front").same
