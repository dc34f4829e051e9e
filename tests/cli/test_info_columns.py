"""The columns of a table stay in line where names have wide letters, or accents of their own."""

from hlr.cli.commands.info import _table
from hlr.common.columns import columns, left, right
from hlr.drawing.model_info import ModelInfo, PartReport

NAMES = ("bolt", "螺栓", "ボルト・ナット", "볼트", "Größe", "e\u0301tau")


def test_columns_of_a_table():
    parts = tuple(PartReport(name, None, 1, 6, 12, 12, True, True, ()) for name in NAMES)
    table = _table(ModelInfo("a.step", "step", 1.0, ((0.0, 0.0, 0.0), (1.0, 1.0, 1.0)), parts, ()))
    rows = table.splitlines()[3 : 3 + len(NAMES)]
    assert all(name in row for name, row in zip(NAMES, rows, strict=True))
    assert {columns(row) for row in rows} == {columns(rows[0])}
    assert len({len(row) for row in rows}) > 1


def test_text_is_put_to_either_side():
    assert (left("螺栓", 6), right("螺栓", 6), left("ab", 1)) == ("螺栓  ", "  螺栓", "ab")
