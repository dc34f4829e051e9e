"""A B-rep source from the leaves of an assembly, a file or a caller's objects."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Literal

from hlr.drawing.notes import Note, NoteCode
from hlr.errors import SourceError, counted
from hlr.source.cad.brep_source import BrepSource
from hlr.source.cad.kernel_shapes import KernelShape, KernelShapes
from hlr.source.cad.part_shapes import LiveShapes, OcctShapes, PartShapes
from hlr.source.cad.parts import Leaf, Part, PartCollector
from hlr.source.cad.prototypes import Prototypes
from hlr.source.model import Appearance


def build_source(
    name: str, kind: str, leaves: Sequence[Leaf], notes: Sequence[Note] = (), *, wires_too: bool = False
) -> BrepSource:
    """Split leaves into parts and make a source of them.

    A caller's shapes are not copied; those of a file are released. Edges without faces are parts as well where a
    caller gives them, or where there are no faces at all, as of a sketch or a path. Those of a file, beside faces, are
    parts only with wires_too: they are its construction lines, axes or sketches.

    Raises:
        SourceError: there are no shapes, or they have neither faces nor edges.
    """
    of_file = kind not in ("object", "script")
    collector = PartCollector(_shapes_of(leaves, of_file), leaves)
    prototypes = collector.prototypes
    if not collector.parts:
        raise SourceError(f"{name} holds no shapes: there is nothing to draw.")
    holds = _contents(prototypes)
    if "faces" not in holds and "edges" not in holds:
        raise SourceError(f"{name} holds no faces and no edges: there is nothing to draw.")
    wires_too = wires_too or not of_file or "faces" not in holds
    wanted = ("faces", "edges") if wires_too else ("faces",)
    parts = [part for part in collector.parts if holds[part.prototype] in wanted]
    wires = [] if wires_too else [part for part in collector.parts if holds[part.prototype] == "edges"]
    empty = [part for part in collector.parts if holds[part.prototype] == "nothing"]
    # Where a part of the same name is drawn, leaving its wires out is worth a remark. Wires with a name of their own
    # may be wanted: a warning.
    drawn = {part.product for part in parts}
    all_notes = [
        *notes,
        *collector.notes,
        *(Note("part-left-out", f'Part "{part.name}" is empty and was left out.') for part in empty),
        *_left_out("free-edges-left-out", [part for part in wires if part.product in drawn], prototypes),
        *_left_out("wires-left-out", [part for part in wires if part.product not in drawn], prototypes),
    ]
    if of_file:
        return BrepSource(
            name,
            kind,
            [with_appearance(part, part.appearance()) for part in parts],
            prototypes.without_shapes(),
            all_notes,
        )
    return BrepSource(name, kind, parts, prototypes, all_notes)


def _contents(prototypes: Prototypes) -> list[Literal["faces", "edges", "nothing"]]:
    """(r,) what each prototype holds: faces, edges alone, or neither."""
    if all(prototypes.has_faces):  # the rule, for which shapes in memory need not be counted
        return ["faces"] * len(prototypes.has_faces)
    return ["faces" if faces else "edges" if edges else "nothing" for faces, edges, _ in prototypes.counts.tolist()]


def _shapes_of(leaves: Sequence[Leaf], of_file: bool) -> PartShapes:
    """What knows the shapes of these leaves."""
    if any(isinstance(leaf.shape, KernelShape) for leaf in leaves):
        return KernelShapes()
    # Colours of faces are told by OpenCASCADE's shapes, and the dump of a file's is kept in the cache.
    return OcctShapes() if of_file or any(leaf.colors for leaf in leaves) else LiveShapes()


def with_appearance(part: Part, appearance: Appearance) -> Part:
    """The part with an appearance that is known already."""
    return replace(part, appearance=lambda: appearance)


def _left_out(code: NoteCode, wires: list[Part], prototypes: Prototypes) -> list[Note]:
    if not wires:
        return []
    names = sorted({part.product for part in wires})
    some = f'Part "{wires[0].name}"' if len(wires) == 1 else f"{len(wires)} parts"
    beside = f' beside "{names[0]}"' if code == "free-edges-left-out" and len(names) == 1 else ""
    return [Note(code, f"{some} without faces ({_edges(wires, prototypes)}){beside} left out.")]


def _edges(wires: list[Part], prototypes: Prototypes) -> str:
    return counted(int(sum(prototypes.counts[part.prototype, 1] for part in wires)), "edge")
