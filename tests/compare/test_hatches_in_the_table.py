"""A hatch that one drawing lacks is one row of the table, so that its lines do not crowd out other differences."""

import numpy as np

from hlr.compare import compare
from hlr.compare.overlay.table import rows
from hlr.linework.hatching import Pattern, hatched
from support.drawings import drawing, line, part

PLATE = np.array([(0, 0), (40, 0), (40, 30), (0, 30)], float)
PIN = PLATE + (60, 0)


def section(*hatched_parts, far=True):
    """Two rectangles, some of them hatched, and a line."""
    lines = [line([a, b]) for face in (PLATE, PIN) for a, b in zip(face, np.roll(face, -1, axis=0), strict=True)]
    lines += [line([(0, 50), (5, 50)])] if far else []
    for number in hatched_parts:
        strokes = hatched([(PLATE, PIN)[number]], Pattern(45.0, 2.0), 0.05)
        lines += [line(ends, "hatch", part=number) for ends in strokes]
    return drawing(lines, parts=[part("plate"), part("pin")])


def test_one_row_for_the_hatch_of_a_part():
    found = compare(section(0, 1), section(far=False))
    hatches = [each for each in found.differences if each.line_class == "hatch"]
    assert len(hatches) > 40
    table = rows(found, 20)
    assert len(table) == 1 + 1 + 3 + 1, "a heading, and three rows between empty lines"
    for name, row in zip(("pin", "plate"), sorted(table[2:4], key=lambda row: row.split()[-1]), strict=True):
        own = [each for each in hatches if each.part == name]
        assert row.startswith("gone") and row.endswith(name) and f"visible hatch, {len(own)} lines " in row
        assert float(row.split()[1]) == round(sum(each.length_mm for each in own), 1)
    assert table[4].split()[:2] == ["gone", "5"] and "more" not in "".join(table)
    assert len(found.to_dict()["differences"]) == len(found.differences), "the file has all of them"


def test_a_hatch_of_one_line_is_told_as_it_is():
    one = drawing([line([(0, 0), (9, 9)], "hatch"), line([(0, 0), (9, 0)])], parts=[part("plate")])
    other = drawing([line([(0, 0), (9, 0)])], parts=[part("plate")])
    assert "lines" not in "".join(rows(compare(one, other), 20))
