"""The Python examples of the README and of the pages that it leads to run, one after another, as a reader runs them."""

import re
import shutil
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
PAGES = ("README.md", "hlr/docs/python.md", "hlr/docs/previews.md", "hlr/docs/drop_ins.md")
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
