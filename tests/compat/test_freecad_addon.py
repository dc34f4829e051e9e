"""The add-on for FreeCAD: its files, the SVG that FreeCAD's Qt reads, and its functions in an installed FreeCAD."""

from __future__ import annotations

import json
import sys
from pathlib import Path
from xml.etree import ElementTree

import pytest

import hlr
from hlr.compat.freecad_addon.__main__ import main
from hlr.compat.freecad_addon.flat import SVG, flat_svg
from support.installed_freecad import needs_freecad, python_of_freecad, run

DATA = Path(__file__).parents[1] / "data"
SUPPORT = Path(__file__).parents[1] / "support"


def test_its_files_and_what_it_says(tmp_path, capsys):
    assert main(["--to", str(tmp_path)]) == 0
    written = [Path(line) for line in capsys.readouterr().out.splitlines()]
    names = ["exact_drawing_paths.py", "InitGui.py", "package.xml", "icon.svg", "ExactDrawing.FCMacro"]
    assert [path.name for path in written] == names
    assert {path.parent for path in written} == {tmp_path / "Mod" / "ExactDrawing", tmp_path / "Macro"}
    for path in written:
        text = path.read_text()
        if path.suffix in (".py", ".FCMacro"):
            compile(text, path, "exec")
        else:
            ElementTree.fromstring(text)
    paths = written[0].read_text()
    assert repr(str(Path(hlr.__file__).parents[1])) in paths


def test_another_version_of_python_is_named(tmp_path, capsys):
    main(["--to", str(tmp_path)])
    file = Path(capsys.readouterr().out.splitlines()[0])
    own = f"({sys.version_info[0]}, {sys.version_info[1]})"
    with pytest.raises(ImportError, match=r"installed for Python 2\.7, and FreeCAD runs 3\."):
        exec(file.read_text().replace(own, "(2, 7)"), {})


def test_a_folder_that_is_missing_is_an_error(tmp_path, capsys):
    assert main(["--to", str(tmp_path / "none")]) == 2
    assert capsys.readouterr().err.startswith("Error: there is no folder ")


def test_what_is_nested_is_moved_and_scaled():
    svg = (
        '<svg xmlns="http://www.w3.org/2000/svg" width="40mm" height="20mm" viewBox="0 -20 40 20" fill="none" '
        'style="background:#fff"><svg x="2" y="3" width="10" height="5" viewBox="1 1 20 20" fill="red"><path/>'
        '<svg width="4" height="2" viewBox="0 0 2 2" preserveAspectRatio="none"/></svg></svg>'
    )
    root = ElementTree.fromstring(flat_svg(svg))
    assert root.attrib == {"width": "40mm", "height": "20mm", "viewBox": "0 0 40 20"}
    (content,) = root
    assert content.attrib == {"fill": "none", "transform": "translate(0 20)"}
    (outer,) = content
    # As large as its height allows, in the middle of its width.
    assert outer.attrib == {"fill": "red", "transform": "translate(4.5 3) scale(0.25 0.25) translate(-1 -1)"}
    assert [each.tag for each in outer] == [f"{SVG}path", f"{SVG}g"]
    assert outer[1].attrib == {"transform": "translate(0 0) scale(2 1) translate(0 0)"}


def test_a_real_page_is_flat():
    (drawing,) = hlr.draw_pages(DATA / "housing_body.FCStd")
    text = flat_svg(drawing.to_svg())
    root = ElementTree.fromstring(text)
    assert [root.get(name) for name in ("width", "height", "viewBox")] == ["420mm", "297mm", "0 0 420 297"]
    assert [each.tag for each in root.iter() if each.tag == f"{SVG}svg"] == [f"{SVG}svg"]
    paths = [sum(1 for _ in each.iter(f"{SVG}path")) for each in (root, ElementTree.fromstring(drawing.to_svg()))]
    assert paths[0] == paths[1] > 50


@needs_freecad
@pytest.mark.slow
def test_exact_drawings_in_a_running_freecad(tmp_path):
    if python_of_freecad(tmp_path) != f"python {sys.version_info[0]} {sys.version_info[1]}":
        pytest.skip("FreeCAD runs another version of Python than this one: packages cannot be shared")
    main(["--to", str(tmp_path)])
    answer = tmp_path / "answer.json"
    document = DATA / "housing_body.FCStd"
    said = run(SUPPORT / "freecad_exact.py", HLR_USER=str(tmp_path), HLR_ANSWER=str(answer), HLR_DOCUMENT=str(document))
    assert answer.exists(), said
    found = json.loads(answer.read_text())
    assert found["labels"] == ["Page, exact", "Page, exact", "Housing, exact"]
    assert found["pages"] == 3  # the second one is the first, made again
    assert found["sizes"] == [[420, 297], [420, 297], [297, 210]]
    assert found["paths"][0] == found["paths"][1] > 50
    assert found["paths"][2] > 10
    assert 'Page "Page": 3 dimensions not drawn.' in said
