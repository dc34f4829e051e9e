"""The accuracy asked for and the accuracy reached, as text."""

from __future__ import annotations

from hlr.common.printable import printable
from hlr.drawing.drawing import Drawing
from hlr.drawing.reached import CLASSES

WHAT = {
    "edges": "edges to their true curves",
    "outlines": "outlines to where the surface is edge-on",
    "meshes": "lines of meshes to the mesh's edges",
    "intersections": "intersections to a finer drawing's",
    "changes": "visibility changes along their line",
    "grazing": "  of them ill-conditioned, no promise",
    "lost": "longest stretch lost",
}


def table(drawing: Drawing) -> str:
    """One line per class of error; empty where nothing was measured."""
    reached = drawing.reached
    if reached is None:
        return ""
    asked = drawing.accuracy.asked
    told = "as usual" if asked is None else f"asked {asked:g}"
    verdict = "kept" if reached.kept() else "NOT KEPT"
    drawn = printable(f"{drawing.source}, {drawing.view.name}")
    rows = [
        f"{drawn}: accuracy {reached.accuracy:g} mm ({told}): {verdict}",
        f"  {'error, mm on paper':42} {'worst':>9} {'99 %':>9} {'of':>8}",
    ]
    for name in CLASSES:
        found = getattr(reached, name)
        if found.worst is None:
            rows.append(f"  {WHAT[name]:42} not measured: {found.why}")
            continue
        usual = "" if found.usual is None else f"{found.usual:9.2g}"
        rows.append(f"  {WHAT[name]:42} {found.worst:9.2g} {usual:>9} {found.count:8}".rstrip())
    if reached.bound is not None:
        rows.append(f"  {'  stretch in which less than it decides':42} {reached.bound:9.2g}")
    if reached.short.worst is not None:
        rows.append(f"  {'shortest figure on its own':42} {reached.short.worst:9.2g}")
    labels = reached.labels
    if labels.longest is None:
        rows.append(f"  {'longest stretch mislabelled':42} not measured: {labels.why}")
    else:
        share = f"{100.0 * (labels.share or 0.0):.2g} % of {labels.judged:.0f} mm"
        rows.append(f"  {'longest stretch mislabelled':42} {labels.longest:9.2g} {share}")
    return "\n".join(rows)
