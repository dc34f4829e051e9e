"""Scripts that show meshes: which are drawn, under which names, and what is said beside CAD objects."""

from __future__ import annotations

import subprocess
import sys

import pytest

from hlr.errors import OptionError, SourceError
from hlr.source import open_source

pytest.importorskip("trimesh")


def script_of(tmp_path, text):
    path = tmp_path / "pot.py"
    path.write_text(
        f"import trimesh\nlid, pot = trimesh.creation.box((9, 9, 1)), trimesh.creation.box((5, 5, 5))\n{text}"
    )
    return path


@pytest.mark.parametrize(
    ("text", "wanted"),
    [
        ("result = {'lid': lid, 'seal': None, 'pot': pot}", ["lid", "pot"]),
        ("result = [lid, pot]", ["pot", "pot:2"]),
        ("parts = {'lid': lid, 'under': pot}", ["lid", "under"]),
        ("show_object(lid, 'lid')\nshow_object([pot, pot])", ["lid", "pot", "pot:2"]),
        ("show({'lid': lid}, pot, names=['', 'under'])", ["lid", "under"]),
        ("parts = [lid, pot]\ncorners = lid.vertices\nshow_all()", ["lid", "pot"]),
        ("result = (lid.vertices.tolist(), lid.faces.tolist())", ["pot"]),
        ("def main():\n    show(lid)\nends = [lid.bounds, lid.bounds]\ndel lid, pot\n"
         "if __name__ == '__main__':\n    lid = trimesh.creation.box()\n    main()", ["pot"]),
    ],
)  # fmt: skip
def test_a_script_may_show_meshes(tmp_path, text, wanted):
    source = open_source(script_of(tmp_path, text))
    assert list(source.names()) == wanted
    assert source.kind == "mesh"
    assert source.notes[0].code == "script-shape"


def test_what_a_script_leaves_out_of_meshes_is_said(tmp_path):
    source = open_source(
        script_of(tmp_path, "result = {'lid': lid, 'seal': None}\nshow_object(result)\nshow_object(5)")
    )
    assert [note.text for note in source.notes] == [
        "pot.py: all that it shows is drawn, 2 objects, without what is no shape (int).",
        'Part "seal" is None and was left out.',
    ]


def test_a_variable_of_a_script_with_a_mesh_may_be_chosen(tmp_path):
    path = script_of(tmp_path, "width = 5\nresult = pot")
    assert open_source(path, var="lid").bounds()[1].tolist() == [4.5, 4.5, 0.5]
    with pytest.raises(OptionError, match=r'"width" of pot\.py is no shape: its shapes are lid, pot, result'):
        open_source(path, var="width")


def test_a_script_shows_a_mesh_in_a_colour(tmp_path):
    text = "show_object(lid, 'lid', options={'color': 'red', 'alpha': 0.5})\nshow_object(pot, 'pot')"
    source = open_source(script_of(tmp_path, text))
    assert source.transparent()
    assert {name: look.whole for name, look in source.appearances().items()} == {"lid": (1, 0, 0, 0.5), "pot": None}


@pytest.mark.parametrize(
    ("text", "wanted", "said"),
    [
        ("show_object(box)\nshow_object(lid, 'lid')", ["pot", "lid"], "all that it shows is drawn, 2 objects"),
        ("show_object(lid, 'lid')\nshow_object(box, 'box')", ["box", "lid"], "all that it shows is drawn, 2 objects"),
        ("show_object([box, lid], 'both')", ["both", "both:2"], "all that it shows is drawn"),
        ("show_object([box, (lid.vertices, lid.faces)])", ["pot", "pot:2"], "all that it shows is drawn"),
        ("result = {'box': box, 'of': [lid, pot]}", ["box", "of", "of:2"], 'the variable "result" is drawn'),
        ("parts = [box, lid]\ndel box, lid, pot", ["pot", "pot:2"], 'the variable "parts" is drawn, the last solid'),
        ("", ["pot"], 'the variable "box" is drawn, the last solid'),
    ],
)
def test_a_script_may_show_meshes_beside_cad_objects(tmp_path, text, wanted, said):
    pytest.importorskip("cadquery")
    source = open_source(script_of(tmp_path, f"import cadquery as cq\nbox = cq.Workplane().box(1, 2, 3)\n{text}"))
    assert source.names() == wanted
    assert source.kind == ("mixed" if len(wanted) > 1 else "script")
    (note,) = source.notes
    assert said in note.text


def test_what_a_script_shows_beside_both_is_said(tmp_path):
    pytest.importorskip("cadquery")
    script = script_of(tmp_path, "import cadquery as cq\nshow_object([cq.Workplane().box(1, 2, 3), lid, 5])")
    with pytest.raises(SourceError, match=r"A mesh \(Trimesh\) stands beside what is neither a CAD object nor a mesh"):
        open_source(script)


def test_a_script_with_meshes_never_loads_a_cad_kernel(tmp_path):
    path = script_of(tmp_path, "parts = {'lid': lid, 'pot': [pot, None]}")
    code = (
        "import sys; from hlr.source import open_source; open_source(sys.argv[1]).mesh(1, 1)\n"
        "print(*sorted({m.split('.')[0] for m in sys.modules} & {'OCP', 'cadquery', 'build123d'}))"
    )
    run = subprocess.run([sys.executable, "-P", "-c", code, str(path)], capture_output=True, text=True, check=True)
    assert run.stdout.strip() == ""


def test_a_result_of_meshes_without_triangles_is_told(tmp_path):
    with pytest.raises(SourceError, match="no mesh in it has a triangle"):
        open_source(script_of(tmp_path, "result = [trimesh.Trimesh([[0, 0, 0], [1, 0, 0], [0, 1, 0]])]\ndel lid, pot"))
