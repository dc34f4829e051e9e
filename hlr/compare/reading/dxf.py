"""A DXF file of any program, read by ezdxf: its lines and curves. Texts, dimensions, hatches and the like are counted.

A file of ours says of each line what it is. In others a line is hidden where its linetype is dashed, or its layer is
called so. Lines without dashes are visible where the file has hidden ones; where it has none, nothing is known. Each
layer counts as a part; in a page of FreeCAD's it is a view.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from contextlib import suppress
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from hlr.compare.lines.sketch import About, Sketch, Trait
from hlr.compare.reading.dashes import CENTRE, HIDDEN, UNKNOWN, VISIBLE
from hlr.compare.reading.dxf_curves import CURVES
from hlr.compare.reading.dxf_looks import Looks
from hlr.compare.reading.stated_view import stated_as_text, views_in_text
from hlr.errors import SourceError
from hlr.tables.line_classes import LINE_CLASSES
from hlr.writers.dxf_entities import APPLICATION
from hlr.writers.dxf_layers import MARKS, TEMPLATE

if TYPE_CHECKING:
    from ezdxf.document import Drawing as Document

MOST_BYTES = 1 << 26
"""Of a file; ezdxf takes some thirty times as much memory."""

MOST_ENTITIES = 1_000_000
"""With those of all blocks that are inserted."""

DEEPEST = 50
"""Blocks within blocks."""

_END = b"EOF"

WORDS = {
    "TEXT": "texts",
    "MTEXT": "texts",
    "ATTRIB": "texts",
    "ATTDEF": "texts",
    "DIMENSION": "dimensions",
    "ARC_DIMENSION": "dimensions",
    "LARGE_RADIAL_DIMENSION": "dimensions",
    "TOLERANCE": "dimensions",
    "LEADER": "leaders",
    "MULTILEADER": "leaders",
    "HATCH": "hatches",
    "MPOLYGON": "hatches",
    "SOLID": "filled areas",
    "TRACE": "filled areas",
    "3DFACE": "faces",
    "MESH": "faces",
    "POINT": "points",
    "VIEWPORT": "viewports",
    "IMAGE": "pictures",
    "XLINE": "endless lines",
    "RAY": "endless lines",
    "INSERT": "blocks that are missing",
}
"""What people call entities that are no lines."""


@dataclass(slots=True)
class _Read:
    """What a file has so far. lines: what is known of each, as a trait without its part; then the part, the entity."""

    lines: list[tuple[Trait, str, Any]] = field(default_factory=list)
    left_out: Counter[str] = field(default_factory=Counter)


def read_dxf(path: Path, sketch: Sketch) -> About:
    """Add the lines of a file to a sketch. Returns what else the file says.

    Raises SourceError, in one sentence, for a file that is no DXF, or too large, or too damaged.
    """
    if path.stat().st_size > MOST_BYTES:
        raise SourceError(f"{path.name} has more than {MOST_BYTES >> 20} MiB, too much for a DXF: it is refused")
    try:
        document, damaged = _opened(path)
        about = _read(document, damaged, sketch, path)
    except SourceError:
        raise
    except Exception as error:  # whatever a broken file makes the library raise
        told = " ".join(str(error).split())[:200] or type(error).__name__
        raise SourceError(f"{path.name} cannot be read as DXF: {told}") from None
    if about.foreign and not len(sketch):
        raise SourceError(f"{path.name} has no lines: give the DXF of a drawing")
    return about


def _opened(path: Path) -> tuple[Document, int]:
    """The document, and how many errors were mended to read it."""
    import logging

    import ezdxf
    from ezdxf import recover
    from ezdxf.lldxf.const import DXFError

    logging.getLogger("ezdxf").addHandler(logging.NullHandler())  # what it says there, it says to nobody else
    with path.open("rb") as file:
        file.seek(max(path.stat().st_size - 64, 0))
        if _END not in file.read():
            raise SourceError(f"{path.name} is no DXF, or cut short: export it again")
    with suppress(DXFError, ValueError):
        return ezdxf.readfile(path), 0
    document, auditor = recover.readfile(path)
    return document, max(len(auditor.errors) + len(auditor.fixes), 1)


def _read(document: Document, damaged: int, sketch: Sketch, path: Path) -> About:
    looks, found = Looks(document), _Read()
    if damaged:
        found.left_out["damaged entries"] = damaged
    for entity, layer, linetype in _entities(document, looks, path.name):
        kind = entity.dxftype()
        if layer == TEMPLATE and document.appids.has_entry(APPLICATION):
            continue
        if layer == MARKS and document.appids.has_entry(APPLICATION):
            found.left_out["marks of sections"] += 1
        elif looks.off(layer) or entity.dxf.get("invisible", 0):
            found.left_out["lines that are not shown"] += kind in CURVES
        elif kind not in CURVES:
            found.left_out[WORDS.get(kind, kind)] += 1
        elif looks.seen(layer, linetype) == CENTRE:
            found.left_out["centre lines"] += 1
        else:
            _add(found, entity, layer, looks.seen(layer, linetype))
    names: dict[str, int] = {}
    told = any(trait.visible == HIDDEN for trait, _, _ in found.lines)
    of_freecad = _by_freecad(path)
    for trait, name, entity in found.lines:
        number = names.setdefault(name, len(names))
        part, view = (-1, number) if of_freecad else (number, -1)
        visible = VISIBLE if trait.visible == UNKNOWN and told else trait.visible
        sketch.begin(replace(trait, visible=visible, part=part, view=view))
        CURVES[entity.dxftype()](sketch, entity, looks.millimetres)
    ours = document.appids.has_entry(APPLICATION)
    stated_view = str(document.header.custom_vars.get("View", "")) if ours else ""
    stated, scale = stated_as_text(stated_view)
    return About(
        parts=() if of_freecad else tuple(names),
        views=tuple(names) if of_freecad else (),
        foreign=not ours or any(trait.kind < 0 for trait, _, _ in found.lines),
        left_out={word: count for word, count in sorted(found.left_out.items()) if count},
        scale=scale,
        stated=stated,
        several=views_in_text(stated_view),
    )


def _by_freecad(path: Path) -> bool:
    """Whether FreeCAD wrote the file: it says so in a comment before all else."""
    with path.open("rb") as file:
        return b"FreeCAD" in file.read(100)


def _entities(document: Document, looks: Looks, name: str) -> Iterator[tuple[Any, str, str]]:
    """Each entity with its layer and linetype, blocks taken apart; the model, or the first sheet that has anything."""
    layouts = [document.modelspace(), *document.layouts]
    first = next((layout for layout in layouts if len(layout)), layouts[0])
    waiting: list[tuple[Iterator[Any], str, str]] = [(iter(first), "0", "CONTINUOUS")]
    count = 0
    while waiting:
        entities, layer, linetype = waiting[-1]
        entity = next(entities, None)
        if entity is None:
            waiting.pop()
            continue
        count += 1
        if count > MOST_ENTITIES:
            raise SourceError(f"{name} has more than {MOST_ENTITIES:,} entities: it is refused")
        own, dashes = looks.of(entity, layer, linetype)
        if entity.dxftype() != "INSERT" or entity.block() is None:
            yield entity, own, dashes
        elif len(waiting) > DEEPEST:
            raise SourceError(f"{name} has blocks within blocks, more than {DEEPEST} deep: it is refused")
        elif not (looks.off(own) or entity.dxf.get("invisible", 0)):
            single = entity.multi_insert() if entity.mcount > 1 else [entity]
            inside = (each for insert in single for each in insert.virtual_entities())
            waiting.append((inside, own, dashes))


def _add(found: _Read, entity: Any, layer: str, visible: int) -> None:
    """Add a line, with what the file says of it: ours all, others their layer."""
    own = _own(entity)
    number = LINE_CLASSES[own["class"]].number if own.get("class") in LINE_CLASSES else -1
    if not own:
        seen, _, word = layer.partition("_")
        if seen in ("VISIBLE", "HIDDEN") and word.lower() in LINE_CLASSES:
            number = LINE_CLASSES[word.lower()].number
    visible = {"yes": 1, "no": 0}.get(own.get("visible", ""), visible)
    edge = own.get("edge", "")
    trait = Trait(number, visible, edge=int(edge) if edge.isdecimal() and len(edge) < 10 else -1)
    found.lines.append((trait, own.get("name", layer), entity))


def _own(entity: Any) -> dict[str, str]:
    """What a file of ours says of a line, as `hlr/writers/dxf_entities.py` writes it; empty where it says nothing."""
    if not entity.has_xdata(APPLICATION):
        return {}
    texts = [str(tag.value) for tag in entity.get_xdata(APPLICATION) if tag.code == 1000]
    return {key: value for key, mark, value in (text.partition("=") for text in texts) if mark}
