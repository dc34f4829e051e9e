"""Lists and dicts of objects in memory: a dict gives its parts names, and None is left out with a warning."""

from __future__ import annotations

import pytest

import hlr
from hlr.errors import SourceError
from hlr.source import open_source

cq = pytest.importorskip("cadquery")


def block(x=0.0):
    return cq.Workplane().box(10, 10, 10).translate((x, 0, 0))


def gear(name=None):
    return cq.Assembly(name=name).add(block(), name="hub").add(block(20), name="rim")


def in_itself(things):
    things.append(things)
    return things


def names(thing):
    return list(open_source(thing).names())


def test_keys_are_the_names_of_the_parts():
    assert names({"lid": block(), "pot": block(20).val(), 3: block(40).val().wrapped}) == ["lid", "pot", "3"]


def test_keys_come_before_names_of_assemblies():
    assert names({"drive": gear("gear"), "base": block(40)}) == ["drive/hub", "drive/rim", "base"]
    assert names({"one": cq.Assembly(block(), name="own")}) == ["one"]
    assert names({"nameless": cq.Assembly().add(block())}) == ["nameless"]


def test_parts_under_one_key_are_counted():
    assert names({"bolt": [block(), block(20)], "plates": {"upper": block(40), "lower": block(60)}}) == [
        "bolt", "bolt:2", "plates/upper", "plates/lower",
    ]  # fmt: skip


def test_labels_of_build123d_give_way_to_keys():
    bd = pytest.importorskip("build123d")
    box, rod = bd.Box(1, 2, 3), bd.Pos(5, 0, 0) * bd.Cylinder(1, 2)
    box.label = "box"
    assert names({"lid": box, "rod": rod}) == ["lid", "rod"]
    assert names({"group": bd.Compound(label="own", children=[box, rod])}) == ["group/box", "group"]


def test_parts_of_a_dict_are_chosen_by_their_keys():
    drawing = hlr.draw({"lid": block(), "pot": block(20)}, "front", only=["pot"])
    assert [part.name for part in drawing.parts] == ["pot"]


def test_the_values_of_a_dict_are_a_list():
    assert names({"lid": block(), "pot": block(20)}.values()) == ["part", "part:2"]


@pytest.mark.parametrize(
    ("thing", "wanted"),
    [
        (lambda: [block(), None], ["Item 2 of the list is None and was left out."]),
        (lambda: {"lid": None, "pot": block()}, ['Part "lid" is None and was left out.']),
        (
            lambda: {"pot": block(), "more": {"seal": None, "lid": block(40)}, "bolts": [block(20), None]},
            ['Part "more/seal" is None and was left out.', 'Part "bolts/2" is None and was left out.'],
        ),
        (lambda: {"pot": block(), "bolts": []}, ['Part "bolts" is empty and was left out.']),
        (lambda: [{}, block()], ["Item 1 of the list is empty and was left out."]),
        (lambda: {"pot": block(), "seals": [None]}, ['Part "seals/1" is None and was left out.']),
    ],
)
def test_none_and_what_is_empty_is_left_out_with_a_warning(thing, wanted):
    notes = open_source(thing()).notes
    assert [note.text for note in notes] == wanted
    assert all(note.is_warning for note in notes)


@pytest.mark.parametrize(
    ("thing", "why"),
    [
        (lambda: {block().val()}, "set cannot be drawn: it has no order"),
        (lambda: (each for each in [block()]), "generator cannot be drawn: it can be read only once"),
        (dict, "it holds no shapes"),
        (lambda: {"lid": None}, "it holds no shapes"),
        (list, "it holds no shapes"),
        (lambda: [None, []], "it holds no shapes"),
        (lambda: {"lid": block(), "more": {"width": 3.0}}, "float in it is no CAD object"),
        (lambda: in_itself([block()]), "list in it holds itself"),
        (lambda: [block(), in_itself([])], "list in it holds itself"),
        (lambda: {"lid": block(), "width": 3.0}, "float in it is no CAD object"),
        (lambda: [block(), "pot.step"], "str in it is no CAD object"),
    ],
)
def test_what_is_refused_says_why(thing, why):
    with pytest.raises(SourceError, match=why):
        open_source(thing())


def test_a_script_may_show_a_dict(tmp_path):
    script = tmp_path / "pot.py"
    script.write_text(
        "import cadquery as cq\n"
        "result = {'lid': cq.Workplane().box(9, 9, 1), 'seal': None, 'pot': cq.Workplane().box(5, 5, 5)}\n"
    )
    source = open_source(script)
    assert list(source.names()) == ["lid", "pot"]
    assert [note.text for note in source.notes if note.is_warning] == ['Part "seal" is None and was left out.']


@pytest.mark.parametrize(
    ("parts", "wanted"),
    [
        ("{'lid': lid, 'pot': pot}", ["lid", "pot"]),
        ("[lid, [pot, None]]", ["lid", "pot"]),
        ("{'lid': lid, 'key': cq.Workplane().box(1, 1, 1)}", ["key", "lid", "pot"]),
    ],
)
def test_show_all_shows_what_is_in_a_dict_once(tmp_path, parts, wanted):
    script = tmp_path / "pot.py"
    script.write_text(
        "import cadquery as cq\nfrom ocp_vscode import show_all\n"
        f"lid, pot = cq.Workplane().box(9, 9, 1), cq.Workplane().box(5, 5, 5)\nparts = {parts}\nshow_all()\n"
    )
    assert sorted(open_source(script).names()) == wanted
