"""hlr and an installed FreeCAD draw the same models: time of both, what differs, and who is right.

    python tests/bench/freecad.py MODEL... [--drawings FOLDER] [--until HH:MM] [--limit S] [-o results.jsonl]

Four views of each model, exact and coarse, at the scale at which hlr puts the view on A4. FreeCAD's time is that of its
recompute, ours that of the drawing with hidden lines, both without reading the file, one after the other. With
--drawings the drawings MODEL_VIEW.svg in a folder are compared instead. A line of JSON for each drawing.
"""

from __future__ import annotations

import argparse
import json
import re
import tempfile
import time
from collections import Counter
from pathlib import Path
from typing import Any

import hlr
from hlr.compare import compare
from hlr.compare.freecad import drawn_by_freecad
from hlr.errors import HlrError
from hlr.source import open_source

LATE = "did not draw"
"""What FreeCAD is said to have done when its time was over."""

VIEWS = ("front", "top", "right", "iso")


def told(found: Any) -> dict[str, Any]:
    """Lengths of a comparison, and of its differences by kind, verdict and reason."""
    classes: Counter[str] = Counter()
    for each in found.differences:
        if not found.looks_same(each):
            reason = re.sub(r"[\d.]+", "#", each.reason)
            seen = {True: "visible", False: "hidden", None: "?"}[each.visible]
            classes[f"{each.kind} ({seen}): {each.verdict or 'not judged'}: {reason}"] += each.length_mm
    largest = [each.as_dict() for each in found.differences if each.verdict in ("first right", "neither right")][:5]
    return {
        "same_mm": found.same_mm,
        "mm": found.lengths_mm,
        "verdicts_mm": found.verdicts_mm,
        "classes": {key: round(length, 3) for key, length in classes.most_common()},
        "against_us": largest,
        "summary": found.summary,
    }


def one(model: Path, view: str, coarse: bool, limit: float) -> dict[str, Any]:
    """A model in a view, drawn by both."""
    row: dict[str, Any] = {"model": model.name, "view": view, "coarse": coarse}
    source = open_source(model)
    ours = hlr.draw(source, view=view, hidden=True)
    row["scale"] = ours.scale
    row["our_s"] = round(ours.timings["total"] - ours.timings["source"], 3)
    try:
        theirs = drawn_by_freecad(model, view, scale=ours.scale, coarse=coarse, time_limit_s=limit)
    except HlrError as error:
        return {**row, "failed": str(error)}
    row["their_s"], row["version"] = round(theirs.seconds, 3), theirs.version
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "FreeCAD.svg"
        path.write_text(theirs.svg)
        return {**row, **told(compare(path, source, view=view, scale=ours.scale))}


def given(drawing: Path, models: list[Path]) -> dict[str, Any] | None:
    """A drawing MODEL_VIEW.svg beside its model."""
    for model in models:
        rest = drawing.stem.removeprefix(f"{model.stem}_")
        view, _, coarse = rest.partition("_")
        if rest != drawing.stem and view in VIEWS:
            row = {"model": model.name, "view": view, "coarse": coarse == "coarse"}
            return {**row, **told(compare(drawing, model, view=view))}
    return None


def main() -> None:
    """Compare, and write a line for each drawing as soon as it is known."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("models", nargs="+", type=Path)
    parser.add_argument("--drawings", type=Path)
    parser.add_argument("--until", default="23:59")
    parser.add_argument("--limit", type=float, default=60.0)
    parser.add_argument("--modes", default="exact,coarse")
    parser.add_argument("-o", "--output", type=Path, default=Path("freecad.jsonl"))
    asked = parser.parse_args()
    with asked.output.open("a") as file:
        for row in _rows(asked):
            file.write(json.dumps(row) + "\n")
            file.flush()
            print(row["model"], row["view"], row.get("summary") or row.get("failed"))


def _rows(asked: argparse.Namespace) -> Any:
    if asked.drawings is not None:
        for drawing in sorted(asked.drawings.glob("*.svg")):
            row = given(drawing, asked.models)
            if row is not None:
                yield row
        return
    for model in asked.models:
        for mode in asked.modes.split(","):
            for view in VIEWS:
                if time.strftime("%H:%M") >= asked.until:
                    return
                row = one(model, view, mode == "coarse", asked.limit)
                yield row
                if LATE in row.get("failed", ""):  # its other views take as long
                    break


if __name__ == "__main__":
    main()
