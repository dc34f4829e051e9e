"""The Python examples of the README and of the pages that it leads to run, one after another, as a reader runs them."""

import re
import shutil
from pathlib import Path

import pytest

import hlr

ROOT = Path(__file__).resolve().parents[2]
NAMES = ("python", "previews", "drop_ins", "styles", "dxf", "compare", "CONTRIBUTING")
PAGES = ("README.md", *(f"hlr/docs/{name}.md" for name in NAMES))
SCRIPT = """import cadquery as cq

size = 10
show_object(cq.Workplane().box(size, 10, 10), "plate")
show_object(cq.Workplane().cylinder(20, 3), "bolt1")
"""
EXAMPLES = [
    (page, text)
    for page in PAGES
    for text in re.findall(r"^```python\n(.*?)^```$", (ROOT / page).read_text("utf-8"), re.MULTILINE | re.DOTALL)
]


@pytest.mark.slow
def test_the_python_examples_run(tmp_path, monkeypatch):
    cq = pytest.importorskip("cadquery")
    shutil.copy(ROOT / "tests" / "data" / "as1-oc-214.stp", tmp_path / "part.step")
    monkeypatch.chdir(tmp_path)
    Path("part.py").write_text(SCRIPT)
    for name in ("part.dxf", "drawing.svg", "old.svg"):
        hlr.draw("part.step", view="front").save(name)
    solid = cq.Workplane().box(30, 20, 10).faces(">Z").workplane().hole(8).val()
    names = {}
    assert {page for page, _ in EXAMPLES} == set(PAGES)
    for page, text in EXAMPLES:
        for piece in re.split(r"(?=^from )", text, flags=re.MULTILINE):
            names["part"] = solid
            if "build123d" in piece:
                names["part"] = pytest.importorskip("build123d").Box(30, 20, 10)
            exec(compile(piece, page, "exec"), names)
    for name in ("part.pdf", "part.json", "part-front.svg", "part-iso.svg", "part.png", "part-depth.png"):
        assert (tmp_path / name).stat().st_size > 1000
