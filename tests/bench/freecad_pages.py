"""Pages of FreeCAD documents: ours beside FreeCAD's own exports of them, view by view.

    cd tests && python -m bench.freecad_pages FOLDER [--overlays OUT] [--json out.json]

FOLDER holds a folder for each document: NAME.FCStd, and of each page NAME[.PAGE].svg, .pdf or .dxf, of each view
NAME[.PAGE].VIEW.frag.svg (`TechDraw.viewPartAsSvg`), and NAME.json with the seconds that FreeCAD took for each page.
A fragment tells visible lines from hidden ones, so a view is compared with that where there is one. Millimetres on
paper; lines that FreeCAD draws twice are left out of the table.
"""

from __future__ import annotations

import argparse
import json
import time
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

from bench.table import Table

from hlr.compare import Comparison, compare
from hlr.compare.reading.document import one_view, page_of
from hlr.compare.reading.sides import DrawnPage
from hlr.errors import HlrError
from hlr.public.pages import page_names

KINDS = ("gone", "new", "moved", "visibility changed", "polyline")
HEADINGS = ["page", "view", "file", "same", "FreeCAD only", "ours only", "displaced", "visibility", "straight pieces"]
VERDICTS = {"first right": "FreeCAD right", "second right": "ours right", "neither right": "neither right"}
"""Columns for verdicts by rays on the model."""
EXPORTS = ("svg", "dxf", "pdf")
TOLERANCE_MM, EXPLAINED_MM = 0.1, 0.1
"""A view with less is the same."""


def exports(folder: Path, page: str, view: str = "") -> Iterator[Path]:
    """The files that FreeCAD has written of a page, or of a view of it; a document of one page does not name it."""
    several = any(folder.glob(f"{folder.name}.{page}.*"))
    for stem in [f"{folder.name}.{page}" if several else folder.name]:
        names = [f"{stem}.{view}.frag.svg"] if view else [f"{stem}.{ending}" for ending in EXPORTS]
        yield from (folder / name for name in names if (folder / name).exists())


def compared(folder: Path, page: str, shown: DrawnPage, overlays: Path | None) -> Iterator[dict[str, Any]]:
    """A row for each export of a page, and one for each view."""
    for path in exports(folder, page):
        yield row(page, "", path, compare(path, shown), overlays)
    for view in shown.drawing.sheet.views:
        for path in exports(folder, page, view.name):
            yield row(page, view.name, path, compare(path, one_view(shown, view.name)), overlays)


def row(page: str, view: str, path: Path, found: Comparison, overlays: Path | None) -> dict[str, Any]:
    if overlays is not None:
        found.save(overlays / f"{path.name}.html")
    return {
        "page": f"{path.parent.name}, {page}",
        "view": view,
        "file": path.name,
        "same_mm": found.same_mm,
        **{kind: found.lengths_mm[kind] for kind in KINDS},
        "elsewhere": [each.name for each in found.views if each.displaced],
        "alone": [each.name for each in found.views if each.before != each.after],
        "verdicts_mm": found.verdicts_mm,
        "summary": found.summary,
    }


def documents(folder: Path, overlays: Path | None) -> Iterator[dict[str, Any]]:
    for path in sorted(folder.glob("*/*.FCStd")):
        told = json.loads(path.with_suffix(".json").read_text("utf-8"))
        theirs = {page["label"]: page.get("recompute_page_s") for page in told["pages"]}
        for name, label in page_names(path):
            start = time.perf_counter()
            try:
                shown = page_of(path, name, TOLERANCE_MM)
            except HlrError as error:
                yield {"page": f"{path.stem}, {label}", "error": str(error)}
                continue
            seconds = time.perf_counter() - start
            rows = list(compared(path.parent, name, shown, overlays)) if shown.drawing.lines else []
            notes = [str(note) for note in shown.drawing.notes]
            yield {"page": f"{path.stem}, {label}", "s": seconds, "freecad_s": theirs.get(label), "notes": notes}
            yield from rows


def cells(found: dict[str, Any]) -> list[str]:
    kinds = [f"{found[kind]:.1f}" if found[kind] >= 0.05 else "" for kind in KINDS]
    right = [
        f"{found['verdicts_mm'][each]:.1f}" if found["verdicts_mm"].get(each, 0.0) >= 0.05 else "" for each in VERDICTS
    ]
    return [found["page"], found["view"], found["file"].split(".", 1)[1], f"{found['same_mm']:.1f}", *kinds, *right]


def main(arguments: Sequence[str] | None = None) -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=Path)
    parser.add_argument("--overlays", type=Path, metavar="OUT", help="a folder for the overlays")
    parser.add_argument("--json", type=Path, metavar="FILE", help="all that was measured")
    given = parser.parse_args(arguments)
    if given.overlays is not None:
        given.overlays.mkdir(parents=True, exist_ok=True)
    found = []
    for each in documents(given.folder, given.overlays):
        found.append(each)
        print(each.get("page"), each.get("file", ""), each.get("summary", each.get("error", "")), flush=True)
    if given.json is not None:
        given.json.write_text(json.dumps(found, indent=1))
    rows = [each for each in found if "file" in each]
    same = [each for each in rows if sum(each[kind] for kind in KINDS) < EXPLAINED_MM]
    pages = [each for each in found if "s" in each]
    remarks = [f"{len(same)} of {len(rows)} are the same within {EXPLAINED_MM} mm of lines."]
    remarks += [f"{each['page']}: {each['s']:.1f} s, FreeCAD {each['freecad_s']} s" for each in pages]
    print(Table([*HEADINGS, *VERDICTS.values()], [cells(each) for each in rows if each not in same], found, remarks))
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
