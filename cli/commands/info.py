"""`hlr info`: the parts of a model, and its defects."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import click

from hlr.common.columns import columns, left, right
from hlr.common.numbers import typed
from hlr.common.printable import printable
from hlr.request.defaults import CREASE

from ..guard import start
from ..meter import meter
from ..parameters import Number
from ..streams import result_only
from ..telling import tell_notes
from ..verb import Verb
from ..view_options import ANNOTATIONS, HIDDEN_OBJECTS, NO_CACHE, PARAMETERS, TIME_LIMIT

if TYPE_CHECKING:
    from hlr.drawing.model_info import ModelInfo, PartReport

_HEADINGS = ("part", "solids", "faces", "edges", "triangles", "closed", "defects")
_LONGEST_NAME = 40


@click.command(cls=Verb)
@click.argument("source")
@click.option(
    "--crease",
    type=Number(0.0, 180.0),
    metavar="DEG",
    default=CREASE,
    help=f"Meshes: angle between two triangles from which there is an edge. Default: {CREASE:g}.",
)
@click.option("--var", metavar="NAME", help="Scripts: the variable to look at, instead of what the script shows.")
@PARAMETERS
@ANNOTATIONS
@HIDDEN_OBJECTS
@NO_CACHE
@TIME_LIMIT
@click.option("--json", "as_json", is_flag=True, help="Print JSON.")
@click.option("-q", "--quiet", is_flag=True, help="No progress on the terminal.")
def info(source: str, time_limit: float | None, as_json: bool, quiet: bool, **chosen: Any) -> None:
    """List the parts of SOURCE, and their defects.

    closed: every edge has a face on both sides, and all faces are oriented alike.
    """
    start(source, time_limit, coarser="")
    with result_only() as out:
        with meter(quiet) as progress:
            import hlr

            model = hlr.info(source, progress=progress, **chosen)
        if as_json:
            import json

            text = json.dumps(_document(model), indent=2)
        else:
            text = _table(model)
            tell_notes(model.notes, quiet=quiet)
        out.show(text.split("\n"))


def _document(model: ModelInfo) -> dict[str, Any]:
    from hlr.tables.documents import head

    return {
        **head("hlr-info"),
        "source": model.source,
        "kind": model.kind,
        "unit": float(model.unit),
        "bounds": [[float(x) for x in corner] for corner in model.bounds],
        "parts": [
            {
                "name": part.name,
                "color": None if part.color is None else [float(x) for x in part.color],
                "solids": int(part.solids),
                "faces": int(part.faces),
                "edges": int(part.edges),
                "triangles": int(part.triangles),
                "closed": bool(part.closed),
                "oriented": bool(part.oriented),
                "defects": list(part.defects),
            }
            for part in model.parts
        ],
        "notes": [note.as_dict() for note in model.notes],
    }


def _table(model: ModelInfo) -> str:
    low, high = model.bounds
    size = " x ".join(typed((b - a) * model.unit, places=12) for a, b in zip(low, high, strict=True))
    unit = "" if model.unit == 1.0 else f", 1 unit = {typed(model.unit)} mm"
    rows = [_HEADINGS, *(_row(part) for part in model.parts)]
    if len(model.parts) > 1:
        rows.append(_total(model))
    widths = [max(columns(row[i]) for row in rows) for i in range(len(_HEADINGS))]
    lines = [f"{printable(model.source)}: {model.kind}, {size} mm{unit}", ""]
    for row in rows:
        cells = [left(row[0], widths[0])]
        cells += [right(cell, width) for cell, width in zip(row[1:6], widths[1:6], strict=True)]
        lines.append("  ".join([*cells, row[6]]).rstrip())
    return "\n".join(lines)


def _row(part: PartReport) -> tuple[str, ...]:
    name = printable(part.name)
    if len(name) > _LONGEST_NAME:
        name = name[: _LONGEST_NAME - 1] + "…"
    closed = "no" if not part.closed else "yes" if part.oriented else "twisted"
    counts = (str(n) for n in (part.solids, part.faces, part.edges, part.triangles))
    return (name, *counts, closed, printable("; ".join(part.defects)))


def _total(model: ModelInfo) -> tuple[str, ...]:
    parts = model.parts
    sums = (sum(getattr(part, name) for part in parts) for name in _HEADINGS[1:5])
    closed = sum(part.closed and part.oriented for part in parts)
    return (f"{len(parts)} parts", *(str(n) for n in sums), f"{closed}/{len(parts)}", "")
