"""From the leaves of an assembly, a file or a caller to a source."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from hlr.drawing.notes import Note, NoteCode
from hlr.errors import SourceError, counted
from hlr.source.cad.brep_source import BrepSource
from hlr.source.cad.parts import Leaf, Part, PartCollector
from hlr.source.cad.prototypes import LivePrototypes
from hlr.source.model import Appearance


def build_source(name: str, kind: str, leaves: Sequence[Leaf], notes: Sequence[Note] = ()) -> BrepSource:
    """Leaves as a source, split into parts; the shapes of a caller are not copied, those of a file are let go.

    Raises:
        SourceError: nothing to draw: no shapes, or none with faces.
    """
    found = PartCollector()
    for leaf in leaves:
        found.add(leaf)
    roots = LivePrototypes(found.roots)
    faced = roots.faced
    parts = [part for part in found.parts if faced[part.root]]
    wires = [part for part in found.parts if not faced[part.root]]
    if not found.parts:
        raise SourceError(f"{name} holds no shapes: there is nothing to draw.")
    if not parts:
        raise SourceError(
            f"{name} holds {_edges(wires, roots)} but no faces: a hidden-line drawing needs surfaces "
            "(export solids or shells instead of wires)."
        )
    # In a file, wires under the name of a part that is drawn are its construction lines, axes or sketches. Few
    # drawings miss them: a remark. Wires under a name of their own, and those that a caller put there, may be
    # something that the reader of the drawing looks for: a warning.
    of_file = kind not in ("object", "script")
    drawn = {part.product for part in parts if of_file}
    said = [
        *notes,
        *found.notes,
        *_left_out("free-edges-left-out", [part for part in wires if part.product in drawn], roots),
        *_left_out("wires-left-out", [part for part in wires if part.product not in drawn], roots),
    ]
    if of_file:
        return BrepSource(name, kind, [with_appearance(part, part.look()) for part in parts], roots.alone(), said)
    return BrepSource(name, kind, parts, roots, said)


def with_appearance(part: Part, look: Appearance) -> Part:
    """The part with a look that is known."""
    return replace(part, look=lambda: look)


def _left_out(code: NoteCode, wires: list[Part], roots: LivePrototypes) -> list[Note]:
    if not wires:
        return []
    names = sorted({part.product for part in wires})
    some = f'Part "{wires[0].name}"' if len(wires) == 1 else f"{len(wires)} parts"
    beside = f' beside "{names[0]}"' if code == "free-edges-left-out" and len(names) == 1 else ""
    return [Note(code, f"{some} without faces ({_edges(wires, roots)}){beside} left out.")]


def _edges(wires: list[Part], roots: LivePrototypes) -> str:
    return counted(int(sum(roots.counts[part.root, 1] for part in wires)), "edge")
