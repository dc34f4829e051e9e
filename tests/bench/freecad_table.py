"""The rows that `bench/freecad.py` has written, as a table in Markdown.

python tests/bench/freecad_table.py results.jsonl
"""

from __future__ import annotations

import json
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

WORDS = ("same", "hlr right", "FreeCAD right", "both", "neither, undecided", "drawn twice")


def number(value: float) -> str:
    """Millimetres or seconds, two digits where that is less than ten; nothing for nothing."""
    if not value:
        return ""
    return f"{value:.0f}" if value >= 10 else f"{value:.1f}" if value >= 0.95 else f"{value:.2f}"


def table(rows: list[dict[str, Any]]) -> Iterator[str]:
    """The lines of the table. rows: as of the bench, with times or all without."""
    timed = any("our_s" in row for row in rows)
    headings = ["drawing", *(("FreeCAD s", "hlr s") if timed else ()), *WORDS]
    yield f"| {' | '.join(headings)} |"
    yield f"|---|{'--:|' * (len(headings) - 1)}"
    for row in rows:
        name = f"{row['model'].rsplit('.', 1)[0]}, {row['view']}{', coarse' if row['coarse'] else ''}"
        cells = [name, *_cells(row, timed)]
        yield f"| {' | '.join(cells)} |"


def _cells(row: dict[str, Any], timed: bool) -> list[str]:
    if "failed" in row:
        words = {"did not draw": "not in time", "ended without": "fails"}
        told = next((word for said, word in words.items() if said in row["failed"]), "no lines")
        return [told, number(row["our_s"]), *[""] * len(WORDS)]
    by = row.get("verdicts_mm", {})
    lengths = [row["same_mm"], *(by.get(f"{who} right", 0.0) for who in ("second", "first", "both"))]
    lengths += [by.get("neither right", 0.0) + by.get("undecided", 0.0), row["mm"]["doubled"]]
    return [*(f"{row[key]:.2f}" for key in (("their_s", "our_s") if timed else ())), *map(number, lengths)]


if __name__ == "__main__":
    for line in table([json.loads(line) for path in sys.argv[1:] for line in Path(path).read_text().splitlines()]):
        print(line)
