"""Only some parts of a source: by name, by pattern, by assembly; in every kind of source and every kind of picture."""

from pathlib import Path

import numpy as np
import pytest
import trimesh

import hlr
from hlr import OptionError, Options
from hlr.request.part_names import matches
from hlr.source import open_source
from hlr.source.selection import open_selected
from support.at_size import AT_SIZE


def mesh_scene():
    scene = trimesh.Scene()
    for i, name in enumerate(("bolt", "nut", "plate")):
        box = trimesh.creation.box((4, 4, 4))
        box.apply_translation((10 * i, 0, 0))
        scene.add_geometry(box, geom_name=name, node_name=name)
    return scene


def assembly():
    cq = pytest.importorskip("cadquery")
    bolt, plate = cq.Workplane().cylinder(4, 1), cq.Workplane().box(30, 30, 1)
    sub = cq.Assembly(name="sub").add(bolt, name="bolt").add(bolt, name="bolt ", loc=cq.Location((5, 0, 0)))
    return cq.Assembly(name="all").add(plate, name="plate").add(sub).add(bolt, name="nut", loc=cq.Location((9, 0, 0)))


@pytest.mark.parametrize(
    ("name", "pattern", "is_meant"),
    [
        ("bolt", "bolt", True),
        ("bolt:2", "bolt", True),
        ("Bolt:12", "bOLT", True),
        ("bolts", "bolt", False),
        ("bolt M6", "bolt*", True),
        ("sub/deep/bolt", "sub", True),
        ("sub/deep/bolt", "sub/deep", True),
        ("sub/deep/bolt", "*bolt", True),
        ("sub/deep/bolt", "bolt", True),
        ("sub/deep/bolt", "deep/bolt", True),
        ("sub/deep/bolt", "deep", True),
        ("sub/deep/bolt:3", "Bolt", True),
        ("sub/deep/bolt", "eep", False),
        ("sub/deep/bolt", "sub/bolt", False),
        ("sub2/bolt", "sub", False),
        ("pin [a]", "pin [a]", True),
        ("pin a", "pin [ab]", True),
    ],
)
def test_what_a_pattern_means(name, pattern, is_meant):
    assert matches(name, pattern) == is_meant


def parts(source, **options):
    return [part.name for part in hlr.draw(source, **AT_SIZE | options).parts]


@pytest.mark.parametrize("kind", ["mesh", "brep"])
def test_only_and_hide(kind):
    source = mesh_scene() if kind == "mesh" else assembly()
    bolts = ["bolt"] if kind == "mesh" else ["sub/bolt", "sub/bolt "]
    assert parts(source, only=("plate",)) == ["plate"]
    assert parts(source, hide=["plate", "nu?"]) == bolts
    assert parts(source, only=["*bolt*", "nut"], hide=["nut"]) == bolts
    if kind == "brep":
        assert parts(source, only=["sub"]) == bolts
        assert parts(source, only=["sub"], hide=["sub/bolt "]) == ["sub/bolt"]


AS1 = Path(__file__).parents[1] / "data/as1-oc-214.stp"


@pytest.mark.parametrize("cached", [False, True])
def test_assemblies_of_a_step_file(cached, tmp_path, monkeypatch):
    """The names of its parts do not say them: they go by the product, or by one place in the assembly above."""
    if cached:
        monkeypatch.setenv("HLR_CACHE", str(tmp_path))
        open_source(AS1)
    assert parts(AS1, only=["rod-assembly"]) == ["nut", "nut:2", "rod"]
    both = parts(AS1, only=["l-bracket-assembly"])
    one, other = (parts(AS1, only=[f"L-bracket-assembly_{number}"]) for number in (1, 2))
    assert len(one) == len(other) == 7 and set(one) & set(other) == set() and set(one) | set(other) == set(both)
    assert parts(AS1, hide=["*-assembly"]) == ["plate"]
    with pytest.raises(OptionError, match='`only` "rod-asembly" matches no part: perhaps "rod-assembly"'):
        parts(AS1, only=["rod-asembly"])


@pytest.mark.parametrize("cached", [False, True])
def test_parts_of_a_step_file_go_by_the_name_of_their_place(cached, tmp_path, monkeypatch):
    """One washer, used twice under two names: both are called by the first."""
    cq = pytest.importorskip("cadquery")
    washer = cq.Workplane().circle(4).circle(2).extrude(1)
    stack = cq.Assembly(name="stack").add(washer, name="lower").add(washer, name="upper", loc=cq.Location((0, 0, 5)))
    path = tmp_path / "stack.step"
    stack.export(str(path))
    if cached:
        monkeypatch.setenv("HLR_CACHE", str(tmp_path / "kept"))
        open_source(path)
    everything = parts(path)
    assert len(everything) == 2
    lower, upper = parts(path, only=["lower"]), parts(path, only=["upper"])
    assert upper == everything[1:] and everything[0] in lower
    assert parts(path, hide=["upper"]) == everything[:1] and parts(path, only=["stack"]) == everything


def test_an_assembly_of_cadquery_in_memory_goes_by_its_name():
    everything = parts(assembly())
    assert parts(assembly(), only=["all"]) == everything
    assert parts(assembly(), only=["all"], hide=["sub"]) == ["plate", "nut"]
    with pytest.raises(OptionError, match='`only` "al" matches no part: perhaps "all"'):
        parts(assembly(), only=["al"])


def test_an_assembly_of_build123d_in_memory_goes_by_its_name():
    bd = pytest.importorskip("build123d")
    case, lid = bd.Box(4, 4, 4), bd.Pos(0, 0, 9) * bd.Box(4, 4, 1)
    case.label, lid.label = "case", "lid"
    whole = bd.Compound(label="gearbox", children=[case, lid])
    assert parts(whole, only=["gearbox"]) == ["case", "lid"] == parts(whole)


@pytest.mark.parametrize("kind", ["mesh", "brep"])
def test_what_is_left_is_drawn_as_if_it_were_alone(kind):
    source = mesh_scene() if kind == "mesh" else assembly()
    alone = open_selected(source, Options(only=("nut",), **AT_SIZE))
    low, high = open_source(source).bounds()
    assert (np.ptp(alone.bounds(), axis=0) < high - low).any()
    (mesh,) = alone.mesh(0.1, 0.3).parts
    assert mesh.name == "nut" and len(mesh.triangles)
    assert list(alone.appearances()) == ["nut"]
    nut = hlr.draw(source, only=("nut",), report=kind == "brep", **AT_SIZE)
    if kind == "brep":
        assert nut.reached is not None
        assert {line.part for line in nut.lines} == {0}
        assert any(line.curve is not None for line in nut.lines)


@pytest.mark.slow
def test_it_holds_for_every_kind_of_picture():
    scene = mesh_scene()
    assert [part.name for part in hlr.preview(scene, size=(20, 20), hide=("nut",)).parts] == ["bolt", "plate"]
    for options in (
        Options(hide=("nut",), within=5.0, **AT_SIZE),
        Options(hide=("nut",), within=5.0, report=True, **AT_SIZE),
    ):
        assert [part.name for part in hlr.draw_views(scene, ["iso"], options)[0].parts] == ["bolt", "plate"]
    (plan,) = hlr.plan_views(scene, ["iso"], Options(only=("nut",), **AT_SIZE))
    crossing = next(d for d in plan.decisions if d.name == "crossing search")
    assert not crossing.on  # a box alone is convex


@pytest.mark.parametrize(
    ("options", "words"),
    [
        ({"only": ["blot"]}, '`only` "blot" matches no part: perhaps "bolt"'),
        ({"hide": ["zzz"]}, '`hide` "zzz" matches no part: there are "bolt", "nut", "plate"'),
        ({"hide": ["*"]}, "no part would be left: hide fewer"),
        (
            {"only": ["nut", "bolt"], "hide": ["nut", "b*"]},
            "no part would be left: `hide` takes all that `only` chooses",
        ),
        ({"only": "bolt"}, "needs a list"),
        ({"hide": [1]}, "needs a list"),
        ({"var": "x"}, "no script"),
        ({"var": 3}, "name of a variable"),
    ],
)
def test_refusals(options, words):
    with pytest.raises(OptionError, match=words):
        hlr.draw(mesh_scene(), **AT_SIZE | options)
