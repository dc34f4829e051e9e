"""Scripts that show nothing and export: what is exported is drawn, not what was made last."""

from __future__ import annotations

import pytest

from hlr.source import open_source

pytest.importorskip("cadquery")

MADE = (
    "import cadquery as cq\nfrom cadquery import exporters\n"
    "part, lid = cq.Workplane().box(30, 20, 10), cq.Workplane().box(30, 20, 2)\n"
    "stock = cq.Workplane().box(90, 90, 90)\nsketch = cq.Workplane().rect(3, 3)\n"
)


@pytest.mark.parametrize(
    ("text", "name", "high"),
    [
        ("exporters.export(part, 'part.stl')", "part", 10),
        ("cq.exporters.export(part, 'part.step')\ncq.exporters.export(lid, 'lid.step')", "lid", 2),
        ("part.export('part.stl')", "part", 10),
        ("file = 'part.stl'\npart.export(file)", "part", 10),
        ("for name in ('a.stl', 'b.stl'):\n    exporters.export(lid, name)", "lid", 2),
        ("def write(shape):\n    exporters.export(shape, 'x.stl')\nwrite(part)", "stock", 90),
        ("exporters.export(part.rotate((0, 0, 0), (1, 0, 0), 90), 'part.stl')", "stock", 90),
        ("exporters.export(sketch, 'sketch.dxf')", "stock", 90),
        ("print(part)", "stock", 90),
    ],
)
def test_the_last_exported_solid_is_drawn(tmp_path, text, name, high):
    script = tmp_path / "made.py"
    script.write_text(MADE + text)
    source = open_source(script)
    low, up = source.bounds()
    assert up[2] - low[2] == pytest.approx(high)
    what = "the last solid" if name == "stock" else "the last exported solid"
    assert source.notes[0].text.startswith(f'made.py: the variable "{name}" is drawn, {what}; show_object(shape)')


def test_what_is_shown_counts_more(tmp_path):
    script = tmp_path / "made.py"
    script.write_text(MADE + "exporters.export(part, 'part.stl')\nresult = lid")
    assert 'the variable "result" is drawn' in open_source(script).notes[0].text
    script.write_text(MADE + "exporters.export(part, 'part.stl')\nshow_object(lid)")
    assert "all that it shows is drawn" in open_source(script).notes[0].text
